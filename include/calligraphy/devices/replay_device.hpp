// A device that plays back recorded samples.
#pragma once

#include <cstddef>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy {

/// Returns the recorded samples in order, then `disconnected` at the last position forever. A velocity that was not
/// recorded (NaN) is estimated from the positions. Forces are stored and have no effect. close() ends playback.
class ReplayDevice final : public HapticDevice {
 public:
  /// Plays back the samples as a device with these capabilities.
  /// @throws ValueError when there are no samples, their times do not increase, or the velocity cut-off is not above 0
  ReplayDevice(std::vector<DeviceState> samples, Capabilities capabilities);

  const Capabilities& capabilities() const noexcept override { return capabilities_; }
  DeviceState read() noexcept override;
  void write(const Eigen::Vector3d& force) noexcept override;
  void close() noexcept override;

  /// Whether no sample is left, or the device is closed.
  bool finished() const noexcept { return !open_ || next_ >= samples_.size(); }
  /// The force last written [N].
  const Eigen::Vector3d& last_force() const noexcept { return force_; }

 private:
  std::vector<DeviceState> samples_;
  Capabilities capabilities_;
  std::size_t next_ = 0;
  bool open_ = true;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace calligraphy
