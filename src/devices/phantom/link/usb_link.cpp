// libusb callbacks only record events; opening, closing, waiting and notifying happen between two rounds of events.
#include "usb_link.hpp"

#if defined(__linux__)
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#endif

#include <algorithm>
#include <memory>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/servo_thread.hpp>

#include "base/monotonic_clock.hpp"

namespace calligraphy::phantom {
namespace {

constexpr double pause_after_error = 0.01;       // while a device is being unplugged, transfers fail immediately [s]
constexpr double oldest_repeated_packet = 0.02;  // an older force is outdated [s]
constexpr double max_cancel = 1.0;               // [s]
constexpr double max_flush = 0.1;                // [s]

unsigned milliseconds(double seconds) { return static_cast<unsigned>(std::max(1.0, seconds * 1e3)); }

const char* to_string(libusb_transfer_status status) {
  switch (status) {
    case LIBUSB_TRANSFER_TIMED_OUT:
      return "the device did not accept it in time";
    case LIBUSB_TRANSFER_STALL:
      return "the endpoint is stalled";
    case LIBUSB_TRANSFER_NO_DEVICE:
      return "the device was unplugged";
    default:
      return "the transfer failed";
  }
}

}  // namespace

UsbLink::UsbLink(const PluggedDevice& device, const LinkOptions& options) : ThreadedLink(device, options) {
  for (Inward& inward : inward_) inward.link = this;
}

UsbLink::~UsbLink() { join(); }

void UsbLink::command(std::span<const std::byte> packet) {
  check_command(packet);
  if (std::this_thread::get_id() == thread_id_) {
    transmit(packet);
    return;
  }
  const std::lock_guard<std::mutex> alone(command_mutex_);
  if (!thread_.joinable()) refuse(wanted_, "the command was not sent: the link is not open");
  Request request;
  request.packet.assign(packet);
  std::future<void> done = request.done.get_future();
  request_.store(&request, std::memory_order_release);
  events_.ring();
  done.get();
}

void UsbLink::run(std::promise<void> opened) noexcept {
  thread_id_ = std::this_thread::get_id();
  warnings_ = set_real_time_priority(options_.priority);
  libusb_hotplug_callback_handle hotplug = 0;
  const bool has_hotplug =
      libusb_hotplug_register_callback(
          events_.context(), LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT, 0,
          wanted_.vendor_id, wanted_.product_id, LIBUSB_HOTPLUG_MATCH_ANY, plugged, this, &hotplug) == LIBUSB_SUCCESS;
  try {
    connect();
    opened.set_value();
    while (!stopping_) {
      serve();
      events_.wait(max_wait());
    }
    flush();
  } catch (...) {
    opened.set_exception(std::current_exception());
  }
  disconnect();
  if (has_hotplug) libusb_hotplug_deregister_callback(events_.context(), hotplug);
}

void UsbLink::serve() noexcept {
  if (gone_) {
    disconnect();
    notify_listener(DeviceFault::unplugged);
  }
  if (device_.handle() == nullptr && monotonic_seconds() >= search_again_) {
    search_again_ = monotonic_seconds() + options_.search;
    try {
      connect();
    } catch (const std::exception&) {
      // Not connected, or the system has not set its permissions yet: search again later.
      disconnect();
    }
  }
  if (device_.handle() != nullptr && !gone_) {
    recover();
    notify_of_state();
  }
  run_request();
  send_newest();
}

double UsbLink::max_wait() const noexcept {
  if (gone_ || in_stalled_ || out_stalled_) return 0.0;
  if (device_.handle() == nullptr) return 0.05;
  return in_fault_ != DeviceFault::none || out_fault_ != DeviceFault::none ? 0.005 : 0.1;
}

void UsbLink::connect() {
  device_.open(events_.context(), wanted_);
  gone_ = holding_ = in_stalled_ = out_stalled_ = in_resumed_ = false;
  in_fault_ = out_fault_ = notified_ = DeviceFault::none;
  retry_in_ = retry_out_ = 0.0;
  kept_count_ = 0;
  for (Inward& inward : inward_) {
    inward.transfer = libusb_alloc_transfer(0);
    if (inward.transfer == nullptr) throw std::bad_alloc();
    // One packet per transfer: a longer transfer would not complete before a short packet ends it.
    libusb_fill_bulk_transfer(inward.transfer, device_.handle(), device_.in_endpoint(), inward.buffer.data(),
                              std::min(device_.packet_size(), static_cast<int>(inward.buffer.size())), inward_done,
                              &inward, milliseconds(options_.silence));
  }
  outward_.transfer = libusb_alloc_transfer(0);
  if (outward_.transfer == nullptr) throw std::bad_alloc();
  raw_endpoint_ = device_.out_endpoint();
  raw_node_ = events_.device_descriptor();
  found_at(device_.place());
  notifying_ = true;
  listener_->changed(DeviceFault::none);
  notifying_ = false;
  last_received_ = monotonic_seconds();
  for (Inward& inward : inward_) submit(inward);
}

void UsbLink::disconnect() noexcept {
  if (device_.handle() == nullptr) return;
  raw_node_ = -1;
  cancel_inward();
  if (outward_.pending) libusb_cancel_transfer(outward_.transfer);
  pump_until(&UsbLink::outward_idle, max_cancel);
  device_.close(!gone_);
  // Closing the device has removed any transfer that has not completed from libusb's list.
  for (Inward& inward : inward_) {
    libusb_free_transfer(inward.transfer);
    inward.transfer = nullptr;
    inward.pending = inward.kept = false;
  }
  libusb_free_transfer(outward_.transfer);
  outward_ = {};
  gone_ = false;
  search_again_ = 0.0;
}

void UsbLink::recover() noexcept {
  if (in_stalled_) {
    // The system requires that no transfers are queued on an endpoint when its halt is cleared.
    cancel_inward();
    holding_ = false;
    clear_halt(device_.in_endpoint());
    if (in_fault_ == DeviceFault::stalled) retry_in_ = monotonic_seconds() + pause_after_error;
    in_stalled_ = false;
    in_fault_ = DeviceFault::stalled;
    in_resumed_ = false;
  }
  if (out_stalled_) {
    clear_halt(device_.out_endpoint());
    if (out_fault_ == DeviceFault::stalled) retry_out_ = monotonic_seconds() + pause_after_error;
    out_stalled_ = false;
    out_fault_ = DeviceFault::stalled;
  }
  if (gone_ || monotonic_seconds() < retry_in_) return;
  for (Inward& inward : inward_) {
    if (!inward.pending && !inward.kept) submit(inward);
  }
}

void UsbLink::clear_halt(unsigned char endpoint) noexcept {
  if (libusb_clear_halt(device_.handle(), endpoint) == LIBUSB_ERROR_NO_DEVICE) gone_ = true;
}

/// Notifies the listener of a fault even if packets are arriving again, and delivers those packets only afterwards.
void UsbLink::notify_of_state() noexcept {
  if (gone_) return;
  notify_listener(in_fault_ != DeviceFault::none ? in_fault_ : out_fault_);
  if (in_fault_ != DeviceFault::none && in_resumed_) {
    in_fault_ = DeviceFault::none;
    in_resumed_ = false;
    notify_listener(out_fault_);
  }
  if (in_fault_ != DeviceFault::none) return;
  for (std::size_t i = 0; i < kept_count_; ++i) {
    kept_[i]->kept = false;
    deliver(*kept_[i]);
    submit(*kept_[i]);
  }
  kept_count_ = 0;
}

void UsbLink::notify_listener(DeviceFault fault) noexcept {
  notifying_ = true;
  notify(fault);
  notifying_ = false;
}

// ---- from the device

void UsbLink::deliver(const Inward& inward) noexcept {
  received_.fetch_add(1, std::memory_order_relaxed);
  listener_->received(std::as_bytes(
      std::span<const unsigned char>(inward.buffer.data(), static_cast<std::size_t>(inward.transfer->actual_length))));
}

void UsbLink::submit(Inward& inward) noexcept {
  if (holding_ || gone_) return;
  const int result = libusb_submit_transfer(inward.transfer);
  inward.pending = result == LIBUSB_SUCCESS;
  if (result == LIBUSB_ERROR_NO_DEVICE) {
    gone_ = true;
  } else if (result != LIBUSB_SUCCESS) {
    failed_.fetch_add(1, std::memory_order_relaxed);
    inward_failed(DeviceFault::link_error);
    retry_in_ = monotonic_seconds() + pause_after_error;
  }
}

void UsbLink::inward_failed(DeviceFault fault) noexcept {
  in_fault_ = fault;
  in_resumed_ = false;
}

void UsbLink::inward_done(libusb_transfer* transfer) noexcept {
  Inward& inward = *static_cast<Inward*>(transfer->user_data);
  UsbLink& link = *inward.link;
  inward.pending = false;
  if (transfer->status != LIBUSB_TRANSFER_COMPLETED && transfer->status != LIBUSB_TRANSFER_CANCELLED) {
    link.failed_.fetch_add(1, std::memory_order_relaxed);
  }
  switch (transfer->status) {
    case LIBUSB_TRANSFER_COMPLETED:
      link.last_received_ = monotonic_seconds();
      link.in_resumed_ = link.in_fault_ != DeviceFault::none;
      if (link.notifying_ || link.in_fault_ != DeviceFault::none || link.in_stalled_ || link.kept_count_ > 0) {
        inward.kept = true;
        link.kept_[link.kept_count_++] = &inward;
        return;
      }
      link.deliver(inward);
      link.submit(inward);
      return;
    case LIBUSB_TRANSFER_CANCELLED:
      return;
    case LIBUSB_TRANSFER_NO_DEVICE:
      link.gone_ = true;
      return;
    case LIBUSB_TRANSFER_STALL:
      link.in_stalled_ = true;
      return;
    case LIBUSB_TRANSFER_TIMED_OUT:
      // If packets are rare, a transfer may time out although another one has received a packet.
      if (monotonic_seconds() - link.last_received_ >= link.options_.silence) {
        link.inward_failed(DeviceFault::timed_out);
      }
      link.submit(inward);
      return;
    case LIBUSB_TRANSFER_OVERFLOW:
      link.inward_failed(DeviceFault::overlong_frame);
      link.submit(inward);
      return;
    default:
      break;
  }
  // Such an error is often the first sign of an unplugged device: the next transfer shows which of the two it is.
  const bool again = link.in_fault_ == DeviceFault::link_error;
  link.inward_failed(DeviceFault::link_error);
  link.retry_in_ = monotonic_seconds() + pause_after_error;
  if (!again) link.submit(inward);
}

void UsbLink::cancel_inward() noexcept {
  holding_ = true;
  for (Inward& inward : inward_) {
    if (inward.pending) libusb_cancel_transfer(inward.transfer);
  }
  pump_until(&UsbLink::inward_idle, max_cancel);
}

bool UsbLink::inward_idle() const noexcept {
  return std::none_of(inward_.begin(), inward_.end(), [](const Inward& inward) { return inward.pending; });
}

// ---- to the device

void UsbLink::send_newest() noexcept {
  if (device_.handle() == nullptr || gone_ || outward_.pending || out_stalled_ || monotonic_seconds() < retry_out_)
    return;
  if (const Packet* packet = next_packet()) {
    std::copy_n(reinterpret_cast<const unsigned char*>(packet->bytes.data()), packet->size, outward_.buffer.data());
    outward_.packet = packet;
    outward_.size = packet->size;
    outward_.filled = monotonic_seconds();
    submit_outward();
  } else if (outward_.refused && monotonic_seconds() - outward_.filled < oldest_repeated_packet) {
    submit_outward();
  } else {
    outward_.refused = false;
  }
}

void UsbLink::submit_outward() noexcept {
  libusb_fill_bulk_transfer(outward_.transfer, device_.handle(), device_.out_endpoint(), outward_.buffer.data(),
                            static_cast<int>(outward_.size), outward_done, this, milliseconds(options_.answer));
  const int result = libusb_submit_transfer(outward_.transfer);
  outward_.pending = result == LIBUSB_SUCCESS;
  outward_.refused = true;
  if (result == LIBUSB_ERROR_NO_DEVICE) {
    outward_.ended = LIBUSB_TRANSFER_NO_DEVICE;
    gone_ = true;
  } else if (result != LIBUSB_SUCCESS) {
    failed_.fetch_add(1, std::memory_order_relaxed);
    outward_.ended = LIBUSB_TRANSFER_ERROR;
    out_fault_ = DeviceFault::link_error;
    retry_out_ = monotonic_seconds() + pause_after_error;
  }
}

void UsbLink::outward_done(libusb_transfer* transfer) noexcept {
  UsbLink& link = *static_cast<UsbLink*>(transfer->user_data);
  link.outward_.pending = false;
  link.outward_.ended = transfer->status;
  if (transfer->status == LIBUSB_TRANSFER_COMPLETED) {
    link.sent_.fetch_add(1, std::memory_order_relaxed);
    link.outward_.refused = false;
    link.out_fault_ = DeviceFault::none;
    if (link.outward_.packet != nullptr) link.packet_written(*link.outward_.packet);
    return;
  }
  if (transfer->status == LIBUSB_TRANSFER_CANCELLED) return;
  link.failed_.fetch_add(1, std::memory_order_relaxed);
  if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE) {
    link.gone_ = true;
  } else if (transfer->status == LIBUSB_TRANSFER_STALL) {
    link.out_stalled_ = true;
  } else {
    const bool late = transfer->status == LIBUSB_TRANSFER_TIMED_OUT;
    link.out_fault_ = late ? DeviceFault::timed_out : DeviceFault::link_error;
    link.retry_out_ = monotonic_seconds() + pause_after_error;
  }
}

void UsbLink::run_request() noexcept {
  Request* const request = request_.exchange(nullptr, std::memory_order_acquire);
  if (request == nullptr) return;
  try {
    transmit(request->packet.content());
    request->done.set_value();
  } catch (...) {
    request->done.set_exception(std::current_exception());
  }
}

void UsbLink::transmit(std::span<const std::byte> packet) {
  pump_until(&UsbLink::outward_idle, options_.answer);
  if (device_.handle() == nullptr || gone_) refuse(wanted_, "the command was not sent: it is not plugged in");
  if (outward_.pending)
    refuse(device_.place(), "the command was not sent: the device has not accepted the previous packet");
  std::copy_n(reinterpret_cast<const unsigned char*>(packet.data()), packet.size(), outward_.buffer.data());
  outward_.packet = nullptr;
  outward_.size = packet.size();
  submit_outward();
  pump_until(&UsbLink::outward_idle, 2.0 * options_.answer);
  outward_.refused = false;  // repeating a command is up to the caller
  if (outward_.pending || outward_.ended != LIBUSB_TRANSFER_COMPLETED) {
    refuse(device_.place(),
           std::string("the command was not accepted: ") +
               (outward_.pending ? "the device did not accept it in time" : to_string(outward_.ended)));
  }
}

/// The packet is sent after any pending transfer.
void UsbLink::write_directly(std::span<const std::byte> packet) noexcept {
  const int node = raw_node_;
  if (node < 0) return;
#if defined(__linux__)
  usbdevfs_bulktransfer transfer{};
  transfer.ep = raw_endpoint_;
  transfer.len = static_cast<unsigned>(packet.size());
  transfer.timeout = 20;  // [ms]
  transfer.data = const_cast<std::byte*>(packet.data());
  ioctl(node, USBDEVFS_BULK, &transfer);
#else
  static_cast<void>(packet);
#endif
}

/// Sends the last packet of a servo loop, which sets the force to zero.
void UsbLink::flush() noexcept {
  const auto end = monotonic_seconds() + max_flush;
  while ((packet_waits() || outward_.pending) && device_.handle() != nullptr && !gone_ && monotonic_seconds() < end) {
    send_newest();
    events_.wait(0.005);
  }
}

void UsbLink::pump_until(bool (UsbLink::*reached)() const noexcept, double seconds) noexcept {
  const auto end = monotonic_seconds() + seconds;
  while (!(this->*reached)() && monotonic_seconds() < end) events_.wait(0.005);
}

int UsbLink::plugged(libusb_context*, libusb_device* device, libusb_hotplug_event event, void* self) noexcept {
  UsbLink& link = *static_cast<UsbLink*>(self);
  if (event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED) {
    link.search_again_ = 0.0;
  } else if (link.device_.handle() != nullptr && libusb_get_device(link.device_.handle()) == device) {
    link.gone_ = true;
  }
  return 0;
}

}  // namespace calligraphy::phantom
