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
  descriptors_.reserve(device.nodes.size());
  for (const std::string& node : device.nodes) {
    const int descriptor = open(node.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) continue;  // a user who may not read it cannot drive the device through it either
    descriptors_.push_back(descriptor);
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
  for (const int descriptor : descriptors_) {
    flock(descriptor, LOCK_UN);  // a forked process may hold the descriptor too
    close(descriptor);
  }
  descriptors_.clear();
}

}  // namespace calligraphy::phantom
