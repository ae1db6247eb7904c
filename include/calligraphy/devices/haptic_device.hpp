// The interface of every haptic device.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

class ServoClock;

/// A force-feedback device; its capabilities say which axes it senses and drives. Several may be open at once.
///
/// Opening is what a constructor does; it throws DeviceError. read() and write() belong to the servo loop: they neither
/// allocate, lock, throw nor log, and report by DeviceState::status.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;

  virtual const Capabilities& capabilities() const noexcept = 0;

  /// The newest sample.
  virtual DeviceState read() noexcept = 0;

  /// Commands a force in device axes [N], held until the next call. A non-finite force counts as zero.
  virtual void write(const Eigen::Vector3d& force) noexcept = 0;

  /// Sets the force to zero and lets the device go; later reads say `disconnected`.
  virtual void close() noexcept = 0;

  /// The device's own scheduler where that must be the clock of the servo loop; null: any clock will do.
  virtual ServoClock* clock() noexcept { return nullptr; }

  /// What the system did not permit to threads of the device's own, each with what to do; ServoLoop::start() tells it.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace calligraphy
