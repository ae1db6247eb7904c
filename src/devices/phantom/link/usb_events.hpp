// libusb's events and a bell of one's own, waited for together.
#pragma once

#include <atomic>
#include <vector>

#include <libusb.h>
#include <poll.h>

#include "wake_up.hpp"

namespace calligraphy::phantom {

/// A libusb context served by one thread. libusb's own way to interrupt that thread takes a lock, which a servo loop
/// must not: here both are polled for instead.
class UsbEvents {
 public:
  /// @throws DeviceError when libusb cannot start
  UsbEvents();
  ~UsbEvents();
  UsbEvents(const UsbEvents&) = delete;
  UsbEvents& operator=(const UsbEvents&) = delete;

  libusb_context* context() const noexcept { return context_; }

  /// Runs the callbacks that are due, waiting for the first one, the bell or the end of the time [s].
  void wait(double seconds) noexcept;

  /// From any thread; neither blocks nor allocates.
  void ring() noexcept { bell_.ring(); }

 private:
  void list_descriptors() noexcept;

  libusb_context* context_ = nullptr;
  WakeUp bell_;
  std::vector<pollfd> polled_;
  std::atomic<bool> descriptors_changed_{true};
};

}  // namespace calligraphy::phantom
