// Runs a device against a force law, in real time, with a watchdog.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/servo_thread.hpp>

namespace calligraphy {

struct ServoLoopOptions {
  ServoOptions servo;
  /// Of the loop's own thread; its rate is that of the servo. Not used by a device that brings its own clock.
  ServoThreadOptions thread;
};

/// A servo, its clock and its watchdog. The clock is the device's own where it has one (`HapticDevice::clock()`), else
/// a ServoThread. Several loops may run at once, each with its own device. Use start() and stop() from one thread,
/// stop() also from within the force law.
class ServoLoop {
 public:
  /// The device must outlive the loop. @throws ValueError naming the value when an option is out of its domain
  ServoLoop(HapticDevice& device, ForceLaw law, const ServoLoopOptions& options = {});
  /// Stops.
  ~ServoLoop();

  /// Begins with no force, which rises. Returns what the system did not permit, each with what to do.
  /// @throws DeviceError when the clock cannot be started, ValueError when the loop runs already
  std::vector<std::string> start();

  /// From within the force law, even before start() has returned, it lets the force fall and returns; the loop ends
  /// when stop() is called from outside. Otherwise: lets the force fall, stops the clock and leaves the force at zero.
  /// Waits for a force law that has not returned; the force does not wait for it.
  void stop() noexcept;

  /// These from any thread, at any time; running() is true from the first tick until stop() from outside.
  bool running() const noexcept { return running_; }
  ServoStatus status() const noexcept { return servo_.status(); }
  ServoStatistics statistics() const noexcept { return servo_.statistics(); }

 private:
  HapticDevice& device_;
  Servo servo_;
  ServoThread thread_;
  ServoThread watchdog_;
  ServoClock* clock_ = nullptr;  ///< while it runs
  std::atomic<bool> running_ = false;
};

}  // namespace calligraphy
