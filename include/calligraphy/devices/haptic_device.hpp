// Interface of all haptic devices.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

class ServoClock;

/// A force-feedback device. Its capabilities state which axes it senses and drives. Several devices may be open at
/// once.
///
/// The constructor opens the device and throws DeviceError; the destructor closes it. The servo loop calls read() and
/// write(): they neither allocate, lock, throw nor log, and report errors in DeviceState::status.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  /// Its axes, limits and properties, constant while it is open.
  virtual const Capabilities& capabilities() const noexcept = 0;

  /// The newest sample.
  virtual DeviceState read() noexcept = 0;

  /// Commands a force in device axes [N], held until the next call. A non-finite force counts as zero.
  virtual void write(const Eigen::Vector3d& force) noexcept = 0;

  /// Sets the force to zero and releases the device; later reads return `disconnected`.
  virtual void close() noexcept = 0;

  /// Sets the force to zero in an emergency stop. Called from a signal handler, in any thread, possibly while another
  /// function of the device runs in this or another thread. Must be async-signal-safe (a write() of a prepared packet,
  /// an atomic flag; no allocation, lock or library that may use them) and return within 0.1 s. Called only for a
  /// device with an EmergencyStopEntry. Without one, the servo loop's next tick writes zero, if its thread still runs.
  virtual void cut_force() noexcept {}

  /// The device's own scheduler, if the servo loop must be clocked by it; null: any clock will do.
  virtual ServoClock* clock() noexcept { return nullptr; }

  /// Privileges that the system refused to the device's own threads, each with a remedy. Also warns if the device is
  /// not known to have a watchdog, which alone removes the force when the program is killed (SIGKILL) or the computer
  /// fails. ServoLoop::start() returns them.
  virtual std::vector<std::string> warnings() const { return {}; }

  /// What the user has to do now, such as "needs calibration: put the pen into the inkwell"; empty if nothing.
  /// Thread-safe.
  virtual std::string advice() const { return {}; }
};

}  // namespace calligraphy
