// hidapi stores an error text per device without a lock. Concurrent reading and writing is nevertheless safe as long as
// neither continues after a failure, so both stop until the reader has reopened the device or completed another read
// alone.
#include "hid_link.hpp"

#include <hidapi.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/servo_thread.hpp>

#include "base/monotonic_clock.hpp"
#include "report_descriptor.hpp"
#include "sysfs.hpp"
#include "usb_device.hpp"

namespace calligraphy::phantom {
namespace {

constexpr int max_read = 5;            // then the reader checks whether a write has failed [ms]
constexpr double writer_pause = 0.05;  // [s]
// Minimum time between two openings: a device that opens and fails immediately must not occupy the processor, at the
// real-time priority that this thread may have.
constexpr double min_stay = 0.01;  // [s]

/// hidapi's initialisation, enumeration and opening are not thread-safe.
std::mutex& hidapi_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::string narrow(const wchar_t* text) {
  std::string narrowed;
  for (; text != nullptr && *text != 0; ++text) narrowed += *text < 128 ? static_cast<char>(*text) : '?';
  return narrowed;
}

}  // namespace

std::string hid_path(const PluggedDevice& device) {
  const std::lock_guard<std::mutex> alone(hidapi_mutex());
  if (hid_init() != 0) return {};
  hid_device_info* const list = hid_enumerate(device.vendor_id, device.product_id);
  std::string path;
  for (const hid_device_info* entry = list; entry != nullptr && path.empty(); entry = entry->next) {
    if (device.serial.empty() || narrow(entry->serial_number) == device.serial) path = entry->path;
  }
  hid_free_enumeration(list);
  return path;
}

namespace {

hid_device* opened(const std::string& path) {
  const std::lock_guard<std::mutex> alone(hidapi_mutex());
  return hid_open_path(path.c_str());
}

/// Whether the descriptor belongs to a hidraw node of a device with these ids; false for -1, and once the device is
/// being unplugged. The system answers without asking the device.
bool hidraw_answers(int descriptor, const PluggedDevice& device) noexcept {
  hidraw_devinfo info = {};
  return descriptor >= 0 && ioctl(descriptor, HIDIOCGRAWINFO, &info) >= 0 &&
         static_cast<std::uint16_t>(info.vendor) == device.vendor_id &&
         static_cast<std::uint16_t>(info.product) == device.product_id;
}

/// A report as hidapi and hidraw expect it: the report number first, 0 if there is none.
struct NumberedReport {
  NumberedReport(std::span<const std::byte> packet, bool numbered) noexcept : size(packet.size() + (numbered ? 0 : 1)) {
    std::copy_n(reinterpret_cast<const unsigned char*>(packet.data()), packet.size(),
                bytes.data() + size - packet.size());
  }
  std::array<unsigned char, max_packet_bytes + 1> bytes{};
  std::size_t size;
};

PluggedDevice found(libusb_context* context, const PluggedDevice& wanted) {
  for (PluggedDevice& device : devices_on_bus(context)) {
    const bool same_ids = device.vendor_id == wanted.vendor_id && device.product_id == wanted.product_id;
    if (same_ids && (wanted.serial.empty() || device.serial == wanted.serial)) return std::move(device);
  }
  refuse(wanted, "it is not plugged in");
}

}  // namespace

HidLink::HidLink(const PluggedDevice& device, const LinkOptions& options) : ThreadedLink(device, options) {}

HidLink::~HidLink() {
  writer_stops_ = true;
  wake();
  if (writer_.joinable()) writer_.join();
  join();
}

void HidLink::open(LinkListener& listener) {
  ThreadedLink::open(listener);
  writer_ = std::thread(&HidLink::write_packets, this);
}

void HidLink::command(std::span<const std::byte> packet) {
  check_command(packet);
  const std::lock_guard<std::mutex> alone(device_mutex_);
  if (device_ == nullptr) refuse(wanted_, "the command was not sent: it is not plugged in");
  if (write_failed_ || !write_report(packet)) refuse(wanted_, "the command was not accepted: the transfer failed");
}

/// Whether the locked hidraw node answers, and keeps answering for this long [s].
bool HidLink::answers(const std::string& node, double seconds) noexcept {
  for (const double end = monotonic_seconds() + seconds;;) {
    if (stopping_ || !hidraw_answers(lock_.descriptor_of(node), wanted_)) return false;
    if (monotonic_seconds() >= end) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(max_read));
  }
}

void HidLink::connect() {
  bus_.wait(0.0);  // processes pending hot-plug events
  const PluggedDevice place = found(bus_.context(), wanted_);
  // Before opening: hidapi-libusb detaches the system's driver, and with it the report descriptor.
  const bool numbered = has_numbered_reports(report_descriptor_at(usb_place(place.bus, place.port)));
  // hidapi-hidraw 0.13.1 may crash if it lists devices while one is being unplugged: it lists them only once, when the
  // device is first opened; afterwards the node comes from the system.
  const std::string path = through_hidraw_ ? (place.nodes.size() > 1 ? place.nodes[1] : "") : hid_path(wanted_);
  if (!path.empty()) through_hidraw_ = path.rfind("/dev/", 0) == 0;
  const std::string node = through_hidraw_ ? path : place.nodes.front();
  if (!may_open(node)) refuse(place, permission_advice(node));
  if (path.empty()) refuse(place, "hidapi does not find it: unplug it and plug it in again");
  lock_.take(place);
  // hidapi-hidraw 0.13.1 frees a wild pointer if the device vanishes while it opens the node: a plug not pushed all the
  // way in may be unplugged again at once.
  if (through_hidraw_ && !answers(path, opened_at_ > 0.0 ? options_.settle : 0.0)) {
    lock_.release();
    refuse(place, path + " does not answer: it is being unplugged");
  }
  hid_device* const device = opened(path);
  if (device == nullptr) {
    lock_.release();
    refuse(place, path + " cannot be opened: close the other program that has it open, or plug it in again");
  }
  {
    const std::lock_guard<std::mutex> alone(device_mutex_);
    device_ = device;
    numbered_ = numbered;
    write_failed_ = false;
    if (through_hidraw_) raw_node_ = lock_.descriptor_of(path);
  }
  found_at(place);
  opened_at_ = monotonic_seconds();
}

void HidLink::start() noexcept {
  last_received_ = monotonic_seconds();
  notified_ = DeviceFault::none;
  listener_->changed(DeviceFault::none);
}

void HidLink::disconnect() noexcept {
  const std::lock_guard<std::mutex> alone(device_mutex_);
  if (device_ != nullptr) hid_close(device_);
  device_ = nullptr;
  raw_node_ = -1;
  lock_.release();
}

// ---- the reader

void HidLink::run(std::promise<void> opened) noexcept {
  warnings_ = set_real_time_priority(options_.priority);  // inherited by hidapi-libusb's own thread
  try {
    connect();
  } catch (...) {
    opened.set_exception(std::current_exception());
    return;
  }
  start();
  opened.set_value();
  while (!stopping_) {
    if (device_ != nullptr) {
      read_reports();
    } else {
      reopen();
    }
  }
  disconnect();
}

/// Runs until the device has to be reopened or the link is closed. After a failed write a hidraw node that answers stays
/// open: hidapi may not survive opening it, since the failure may be the beginning of an unplug.
void HidLink::read_reports() noexcept {
  std::array<unsigned char, max_packet_bytes> report{};
  while (!stopping_) {
    const bool resumes = write_failed_ && monotonic_seconds() >= opened_at_ + min_stay;
    const int size = hid_read_timeout(device_, report.data(), report.size(), max_read);
    if (size < 0 || (write_failed_ && !hidraw_answers(raw_node_, wanted_))) {
      failed_.fetch_add(size < 0 ? 1 : 0, std::memory_order_relaxed);
      break;
    }
    if (write_failed_) notify(DeviceFault::link_error);
    if (resumes) {
      opened_at_ = monotonic_seconds();
      write_failed_ = false;
      start();
    }
    if (size > 0) {
      last_received_ = monotonic_seconds();
      notify(DeviceFault::none);
      received_.fetch_add(1, std::memory_order_relaxed);
      listener_->received(std::as_bytes(std::span<const unsigned char>(report.data(), static_cast<std::size_t>(size))));
    } else if (monotonic_seconds() - last_received_ >= options_.silence) {
      notify(DeviceFault::timed_out);
    }
  }
  if (stopping_) return;
  disconnect();
}

void HidLink::reopen() noexcept {
  std::this_thread::sleep_for(std::chrono::duration<double>(opened_at_ + min_stay - monotonic_seconds()));
  try {
    connect();
    // hidapi does not report why a transfer failed: a device that reopens immediately had an error, any other is gone.
    if (notified_ != DeviceFault::unplugged) notify(DeviceFault::link_error);
    start();
  } catch (const std::exception&) {
    if (!stopping_) notify(DeviceFault::unplugged);
    for (const double end = monotonic_seconds() + options_.search; monotonic_seconds() < end && !stopping_;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(max_read));
    }
  }
}

// ---- writer

void HidLink::write_packets() noexcept {
  set_real_time_priority(options_.priority);  // the reader reports a refusal
  while (true) {
    const bool last = writer_stops_;
    if (const Packet* packet = next_packet()) {
      const std::lock_guard<std::mutex> alone(device_mutex_);
      if (device_ != nullptr && !write_failed_ && write_report(packet->content())) packet_written(*packet);
    }
    if (last) return;
    if (!packet_waits()) bell_.wait(writer_pause);
  }
}

/// Requires device_mutex_.
bool HidLink::write_report(std::span<const std::byte> packet) noexcept {
  const NumberedReport report(packet, numbered_);
  if (hid_write(device_, report.bytes.data(), report.size) < 0) {
    failed_.fetch_add(1, std::memory_order_relaxed);
    write_failed_ = true;
    return false;
  }
  sent_.fetch_add(1, std::memory_order_relaxed);
  return true;
}

/// A write() to a hidraw node returns when the device has accepted the report, after 5 s at the latest.
void HidLink::write_directly(std::span<const std::byte> packet) noexcept {
  const int node = raw_node_;
  if (node < 0) return;
  const NumberedReport report(packet, numbered_);
  [[maybe_unused]] const ssize_t written = write(node, report.bytes.data(), report.size);
}

}  // namespace calligraphy::phantom
