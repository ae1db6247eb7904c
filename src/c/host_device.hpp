// A device implemented by the program, which supplies its samples and sends it the ticks' forces.
#pragma once

#include <utility>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy::c {

class HostDevice final : public HapticDevice {
 public:
  explicit HostDevice(Capabilities capabilities) : capabilities_(std::move(capabilities)) {
    sample_.status = DeviceStatus::stale;
  }

  const Capabilities& capabilities() const noexcept override { return capabilities_; }
  /// The last sample supplied: fresh once, then stale. A status that says there is none persists.
  DeviceState read() noexcept override {
    const DeviceState sample = sample_;
    const bool is_fresh = sample.status == DeviceStatus::ok || sample.status == DeviceStatus::warm_motors;
    if (is_fresh) sample_.status = DeviceStatus::stale;
    return sample;
  }
  void write(const Eigen::Vector3d& force) noexcept override { force_ = output_force(capabilities_, force); }
  void close() noexcept override {}

  void supply(const DeviceState& sample) noexcept { sample_ = sample; }
  /// The force that was written last, as the device can output it [N].
  const Eigen::Vector3d& force() const noexcept { return force_; }

 private:
  Capabilities capabilities_;
  DeviceState sample_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace calligraphy::c
