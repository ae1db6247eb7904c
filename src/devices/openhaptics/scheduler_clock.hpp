// The vendor's scheduler as the clock of a servo loop: one frame of one device per tick.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include <calligraphy/devices/servo_clock.hpp>

#include "runtime.hpp"

namespace calligraphy::hdapi {

class SchedulerClock final : public ServoClock {
 public:
  SchedulerClock(std::shared_ptr<Runtime> runtime, Handle device, double (*time)() noexcept);
  ~SchedulerClock() override;

  void start(std::function<void(double now)> tick) override;
  void stop() noexcept override;
  bool running() const noexcept override { return running_; }

  /// Whether the caller is within a tick of this clock, the only place where a frame is open.
  bool within_tick() const noexcept;

  bool output_on() const noexcept { return output_on_; }
  /// Switches the force output off from outside a tick; the next frame that sets a force switches it on again.
  void cut_force() noexcept;
  /// Call within a tick only.
  void set_force(const double (&force)[3]) noexcept;

 private:
  static CallbackCode call(void* clock) noexcept;
  CallbackCode frame() noexcept;

  std::shared_ptr<Runtime> runtime_;
  Handle device_;
  double (*time_)() noexcept;
  std::function<void(double now)> tick_;
  SchedulerHandle callback_ = 0;
  bool running_ = false;

  std::atomic<bool> output_on_ = false;  ///< the device's force output
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> inside_ = false;    ///< a frame is open
  std::atomic<bool> finished_ = false;  ///< the last frame is done; the callback will not be called again
};

}  // namespace calligraphy::hdapi
