// libusb's descriptors change only when a device is opened or closed; only then are they listed again.
#include "usb_events.hpp"

#include <cmath>
#include <string>

#include <calligraphy/base/error.hpp>

namespace calligraphy::phantom {

UsbEvents::UsbEvents() {
  const int result = libusb_init(&context_);
  if (result != LIBUSB_SUCCESS) {
    throw DeviceError(std::string("cannot initialise libusb: ") + libusb_strerror(static_cast<libusb_error>(result)));
  }
  libusb_set_pollfd_notifiers(
      context_, [](int, short, void* self) { static_cast<UsbEvents*>(self)->descriptors_changed_ = true; },
      [](int, void* self) { static_cast<UsbEvents*>(self)->descriptors_changed_ = true; }, this);
}

UsbEvents::~UsbEvents() {
  libusb_set_pollfd_notifiers(context_, nullptr, nullptr, nullptr);
  libusb_exit(context_);
}

void UsbEvents::list_descriptors() noexcept {
  polled_.assign(1, {bell_.descriptor(), POLLIN, 0});
  const libusb_pollfd** const list = libusb_get_pollfds(context_);
  if (list == nullptr) return;
  for (const libusb_pollfd** entry = list; *entry != nullptr; ++entry) {
    polled_.push_back({(*entry)->fd, (*entry)->events, 0});
  }
  libusb_free_pollfds(list);
}

/// libusb polls the descriptor of a device for output, all others for input.
int UsbEvents::device_descriptor() const noexcept {
  int found = -1;
  const libusb_pollfd** const list = libusb_get_pollfds(context_);
  if (list == nullptr) return found;
  for (const libusb_pollfd** entry = list; *entry != nullptr; ++entry) {
    if (((*entry)->events & POLLOUT) != 0) found = (*entry)->fd;
  }
  libusb_free_pollfds(list);
  return found;
}

void UsbEvents::wait(double seconds) noexcept {
  if (descriptors_changed_.exchange(false)) list_descriptors();
  timeval next{};
  if (libusb_get_next_timeout(context_, &next) == 1) {
    seconds = std::min(seconds, static_cast<double>(next.tv_sec) + 1e-6 * static_cast<double>(next.tv_usec));
  }
  poll(polled_.data(), polled_.size(), static_cast<int>(std::ceil(seconds * 1e3)));
  if ((polled_.front().revents & POLLIN) != 0) bell_.clear();
  timeval now{};
  libusb_handle_events_timeout_completed(context_, &now, nullptr);
}

}  // namespace calligraphy::phantom
