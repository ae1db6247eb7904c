// A device controlled by a test; it records every force and detects concurrent access.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy_test {

class WatchedDevice final : public calligraphy::HapticDevice {
 public:
  explicit WatchedDevice(double peak_force = 0.0) {
    forces.reserve(1'000'000);
    capabilities_.peak_force = peak_force;
  }

  const calligraphy::Capabilities& capabilities() const noexcept override { return capabilities_; }
  calligraphy::DeviceState read() noexcept override {
    enter();
    ++reads;
    if (while_reading) while_reading();
    const calligraphy::DeviceState result = state;
    inside_.store(false);
    return result;
  }
  void write(const Eigen::Vector3d& force) noexcept override {
    enter();
    if (while_writing) while_writing();
    if (forces.size() < forces.capacity()) forces.push_back(force);
    inside_.store(false);
  }
  void close() noexcept override {}

  /// NaN if no force has been written since the forces were cleared.
  double last() const { return forces.empty() ? std::numeric_limits<double>::quiet_NaN() : forces.back().x(); }

  calligraphy::DeviceState state;  ///< the next sample
  std::function<void()> while_reading = nullptr;
  std::function<void()> while_writing = nullptr;
  std::vector<Eigen::Vector3d> forces;
  long reads = 0;
  std::atomic<bool> touched_by_two = false;

 private:
  void enter() {
    if (inside_.exchange(true)) touched_by_two = true;
  }

  calligraphy::Capabilities capabilities_;
  std::atomic<bool> inside_ = false;
};

}  // namespace calligraphy_test
