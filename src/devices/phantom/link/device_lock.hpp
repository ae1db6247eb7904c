// Keeps two programs from one device where its driver does not.
#pragma once

#include <vector>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy::phantom {

/// An advisory lock on every node of a device that this user may open: the one on the bus, which both forms of hidapi
/// have in common, and those of hidraw. The system takes it back when the process ends, however it ends; a device that
/// is plugged in anew has new nodes, and no lock from before. It holds between users, and in a container as far as that
/// shares the nodes; a node that a container made for itself is another one.
class DeviceLock {
 public:
  DeviceLock() = default;
  ~DeviceLock() { release(); }
  DeviceLock(const DeviceLock&) = delete;
  DeviceLock& operator=(const DeviceLock&) = delete;

  /// Lets go of what it had. @throws DeviceError naming the device when somebody else has it, and holds nothing then
  void take(const PluggedDevice& device);
  void release() noexcept;

 private:
  std::vector<int> descriptors_;
};

}  // namespace calligraphy::phantom
