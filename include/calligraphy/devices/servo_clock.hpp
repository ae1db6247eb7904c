// What calls the servo loop, tick by tick.
#pragma once

#include <functional>

namespace calligraphy {

/// Calls a function once a tick until it is stopped: the servo thread of this library, or the scheduler of a vendor.
class ServoClock {
 public:
  virtual ~ServoClock() = default;

  /// From now on calls `tick` with the time [s] of a clock that never runs back, one call at a time, from one thread.
  /// @throws DeviceError when the clock cannot be started, ValueError when it runs already
  virtual void start(std::function<void(double now)> tick) = 0;

  /// No call runs any more once this has returned. Not to be called from within a tick.
  virtual void stop() noexcept = 0;

  virtual bool running() const noexcept = 0;
};

}  // namespace calligraphy
