// Prevents two programs from driving one device where its driver does not.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy::phantom {

/// An advisory lock on every node of a device that this user may open: the bus node, which both variants of hidapi
/// share, and the hidraw nodes. The system releases it when the process ends for any reason, and a replugged device has
/// new, unlocked nodes. The lock works across users, and across containers that share the nodes; a node created by a
/// container itself is a different one.
class DeviceLock {
 public:
  DeviceLock() = default;
  ~DeviceLock() { release(); }
  DeviceLock(const DeviceLock&) = delete;
  DeviceLock& operator=(const DeviceLock&) = delete;

  /// Releases any previous lock first. @throws DeviceError naming the device when it is locked elsewhere; nothing is
  /// locked then
  void take(const PluggedDevice& device);
  void release() noexcept;

  /// The open descriptor of a locked node, for writing to it if this user may; -1 if it is not locked.
  int descriptor_of(const std::string& node) const noexcept;

 private:
  struct LockedNode {
    std::string node;
    int descriptor;
  };
  std::vector<LockedNode> nodes_;
};

}  // namespace calligraphy::phantom
