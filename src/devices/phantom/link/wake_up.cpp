// Linux: eventfd().
#include "wake_up.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include <calligraphy/base/error.hpp>

namespace calligraphy::phantom {

WakeUp::WakeUp() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (descriptor_ < 0) throw DeviceError(std::string("no event descriptor for a link's thread: ") + strerror(errno));
}

WakeUp::~WakeUp() { close(descriptor_); }

void WakeUp::ring() noexcept {
  const std::uint64_t one = 1;
  // It fails only if the counter is full, that is, already rung.
  [[maybe_unused]] const ssize_t written = write(descriptor_, &one, sizeof one);
}

void WakeUp::wait(double seconds) noexcept {
  pollfd waiting{descriptor_, POLLIN, 0};
  poll(&waiting, 1, static_cast<int>(std::ceil(seconds * 1e3)));
  clear();
}

void WakeUp::clear() noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t got = read(descriptor_, &count, sizeof count);
}

}  // namespace calligraphy::phantom
