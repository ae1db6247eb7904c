// Runs a force law on a device in real time, with a watchdog.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/servo_thread.hpp>

namespace calligraphy {

/// Options of a real-time loop.
struct ServoLoopOptions {
  ServoOptions servo;         ///< rate and safety limits
  ServoThreadOptions thread;  ///< options of the loop's own thread; unused if the device has its own clock
};

/// A servo, its clock and its watchdog. The clock is the device's own if it has one (`HapticDevice::clock()`),
/// otherwise a ServoThread. Several loops may run at once, each with its own device. Call start() and stop() from one
/// thread; stop() may also be called from within the force law.
class ServoLoop {
 public:
  /// The device must outlive the loop. @throws ValueError naming the value when an option is out of range or the force
  /// law is empty
  ServoLoop(HapticDevice& device, ForceLaw law, const ServoLoopOptions& options = {});
  /// Calls stop().
  ~ServoLoop();

  /// Starts with zero force and ramps it up. Returns the privileges that the system refused, each with a remedy, and
  /// the device's own warnings. `tell`, if given, is called with them before the first tick reads the device, so that
  /// the user knows them before feeling a force; if it throws, the loop does not start.
  /// @throws DeviceError when the clock cannot be started or after an emergency stop, ValueError when the loop is
  /// already running
  std::vector<std::string> start(const std::function<void(const std::vector<std::string>& warnings)>& tell = nullptr);

  /// Ramps the force down to zero, stops the clock and leaves the force at zero. Waits for a force law that has not
  /// returned, but the ramp does not. From within the force law, even before start() has returned, it begins the
  /// ramp-down and returns; the loop ends when stop() is called from outside.
  void stop() noexcept;

  /// True from the first tick until stop() is called from outside the force law. Thread-safe.
  bool running() const noexcept { return running_; }
  /// Current phase, fault and gain. Thread-safe.
  ServoStatus status() const noexcept { return servo_.status(); }
  /// Statistics of all runs of this loop. Thread-safe.
  ServoStatistics statistics() const noexcept { return servo_.statistics(); }

 private:
  HapticDevice& device_;
  Servo servo_;
  ServoThread thread_;
  ServoThread watchdog_;
  ServoClock* clock_ = nullptr;  ///< null while stopped
  std::atomic<bool> running_ = false;
  std::atomic<bool> warned_ = false;  ///< `tell` has returned; until then, ticks of the loop's own thread do nothing
  std::optional<EmergencyStopEntry> entry_;  ///< while the clock runs
};

}  // namespace calligraphy
