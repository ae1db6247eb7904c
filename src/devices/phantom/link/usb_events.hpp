// Waits for libusb events and for its own wake-up signal at the same time.
#pragma once

#include <atomic>
#include <vector>

#include <libusb.h>
#include <poll.h>

#include "wake_up.hpp"

namespace calligraphy::phantom {

/// A libusb context served by one thread. libusb's own way of interrupting that thread takes a lock, which a servo loop
/// must not do; here both are polled instead.
class UsbEvents {
 public:
  /// @throws DeviceError when libusb cannot be initialised
  UsbEvents();
  ~UsbEvents();
  UsbEvents(const UsbEvents&) = delete;
  UsbEvents& operator=(const UsbEvents&) = delete;

  libusb_context* context() const noexcept { return context_; }

  /// Waits for the first event, ring() or the time [s], then runs the callbacks that are due.
  void wait(double seconds) noexcept;

  /// The descriptor of the one open device, -1 if the system has none. Call it from the thread that serves the context.
  int device_descriptor() const noexcept;

  /// Callable from any thread; neither blocks nor allocates.
  void ring() noexcept { bell_.ring(); }

 private:
  void list_descriptors() noexcept;

  libusb_context* context_ = nullptr;
  WakeUp bell_;
  std::vector<pollfd> polled_;
  std::atomic<bool> descriptors_changed_{true};
};

}  // namespace calligraphy::phantom
