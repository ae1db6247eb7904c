// Linux: flock() on descriptors opened for this purpose only.
#include "device_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "usb_device.hpp"

namespace calligraphy::phantom {

void DeviceLock::take(const PluggedDevice& device) {
  release();
  nodes_.reserve(device.nodes.size());
  for (const std::string& node : device.nodes) {
    int descriptor = open(node.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) descriptor = open(node.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) continue;  // a user who may not read the node cannot drive the device through it either
    nodes_.push_back({node, descriptor});
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) continue;
    const int error = errno;
    release();
    if (error == EWOULDBLOCK) {
      refuse(device, "it is in use (" + node +
                         " is locked): close the other program, or the other part of this program, "
                         "that has it open");
    }
    refuse(device, node + " cannot be locked: " + std::strerror(error));
  }
}

void DeviceLock::release() noexcept {
  for (const LockedNode& locked : nodes_) {
    flock(locked.descriptor, LOCK_UN);  // a forked process may hold the descriptor too
    close(locked.descriptor);
  }
  nodes_.clear();
}

int DeviceLock::descriptor_of(const std::string& node) const noexcept {
  for (const LockedNode& locked : nodes_) {
    if (locked.node == node) return locked.descriptor;
  }
  return -1;
}

}  // namespace calligraphy::phantom
