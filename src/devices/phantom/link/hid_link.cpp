// hidapi keeps an error text for each device without a lock. Reading and writing at once is sound all the same as long
// as neither goes on after it has failed, so each stops then until the reader has opened the device anew.
#include "hid_link.hpp"

#include <hidapi.h>

#include <algorithm>
#include <array>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/servo_thread.hpp>

#include "report_descriptor.hpp"
#include "sysfs.hpp"
#include "usb_device.hpp"

namespace calligraphy::phantom {
namespace {

constexpr int longest_read = 5;        // [ms]; after it the reader looks whether a write has failed
constexpr double writer_pause = 0.05;  // [s]
// From one opening to the next: a device that opens and fails at once must not take the processor, at the priority that
// this thread may have.
constexpr std::chrono::milliseconds shortest_stay(10);

/// hidapi's list of devices, its start and its opening are not for several threads at once.
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

PluggedDevice found(libusb_context* context, const PluggedDevice& wanted) {
  for (PluggedDevice& device : devices_on_bus(context)) {
    const bool same_ids = device.vendor_id == wanted.vendor_id && device.product_id == wanted.product_id;
    if (same_ids && (wanted.serial.empty() || device.serial == wanted.serial)) return std::move(device);
  }
  refuse(wanted, "it is not plugged in");
}

}  // namespace

HidLink::HidLink(const PluggedDevice& device, const LinkOptions& options) : wanted_(device), options_(options) {
  descriptions_.push_back(describe(device));
  description_ = &descriptions_.back();
}

HidLink::~HidLink() {
  writer_stops_ = true;
  bell_.ring();
  if (writer_.joinable()) writer_.join();
  stopping_ = true;
  if (reader_.joinable()) reader_.join();
}

void HidLink::open(LinkListener& listener) {
  if (reader_.joinable()) throw DeviceError(description() + ": this link is open already");
  listener_ = &listener;
  std::promise<void> first;
  std::future<void> outcome = first.get_future();
  reader_ = std::thread(&HidLink::read_and_tell, this, std::move(first));
  try {
    outcome.get();
  } catch (...) {
    reader_.join();
    throw;
  }
  writer_ = std::thread(&HidLink::write_packets, this);
}

bool HidLink::send(std::span<const std::byte> packet) noexcept {
  if (packet.size() > longest_packet) return false;
  if (newest_.put(packet)) replaced_.fetch_add(1, std::memory_order_relaxed);
  bell_.ring();
  return true;
}

void HidLink::command(std::span<const std::byte> packet) {
  if (packet.size() > longest_packet) refuse(wanted_, "a command of " + std::to_string(packet.size()) + " bytes");
  const std::lock_guard<std::mutex> alone(device_mutex_);
  if (device_ == nullptr) refuse(wanted_, "the command was not sent: it is not plugged in");
  if (write_failed_ || !write_report(packet)) refuse(wanted_, "the command was not taken: the transfer failed");
}

LinkCounts HidLink::counts() const noexcept { return {received_, sent_, replaced_, failed_, opened_}; }

void HidLink::connect() {
  bus_.wait(0.0);  // what came and went is dealt with
  const PluggedDevice place = found(bus_.context(), wanted_);
  // Before it is opened: hidapi-libusb takes the device from the system, and its report descriptor with it.
  const bool numbered = has_numbered_reports(report_descriptor_at(usb_place(place.bus, place.port)));
  // hidapi-hidraw 0.13.1 may crash when it lists a device that is being unplugged: it is asked once, when the device is
  // opened for the first time, and afterwards the system is.
  const std::string path = through_hidraw_ ? (place.nodes.size() > 1 ? place.nodes[1] : "") : hid_path(wanted_);
  if (!path.empty()) through_hidraw_ = path.rfind("/dev/", 0) == 0;
  const std::string node = through_hidraw_ ? path : place.nodes.front();
  if (!may_open(node)) refuse(place, permission_advice(node));
  if (path.empty()) refuse(place, "hidapi does not see it: unplug it and plug it in again");
  lock_.take(place);
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
  }
  const std::string text = describe(place);
  auto known = std::find(descriptions_.begin(), descriptions_.end(), text);
  if (known == descriptions_.end()) known = descriptions_.insert(known, text);
  description_ = &*known;
  opened_at_ = Clock::now();
  opened_.fetch_add(1, std::memory_order_relaxed);
}

void HidLink::start() noexcept {
  last_received_ = Clock::now();
  told_ = DeviceFault::none;
  listener_->changed(DeviceFault::none);
}

void HidLink::disconnect() noexcept {
  const std::lock_guard<std::mutex> alone(device_mutex_);
  if (device_ != nullptr) hid_close(device_);
  device_ = nullptr;
  lock_.release();
}

void HidLink::tell(DeviceFault fault) noexcept {
  const Clock::time_point now = Clock::now();
  const bool again =
      fault == DeviceFault::timed_out && now - told_at_ >= std::chrono::duration<double>(options_.silence);
  if (fault == told_ && !again) return;
  told_ = fault;
  told_at_ = now;
  listener_->changed(fault);
}

// ---- the reader

void HidLink::read_and_tell(std::promise<void> opened) noexcept {
  warnings_ = set_real_time_priority(options_.priority);  // hidapi-libusb's own thread is started from this one
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

/// Until the device fails or the link is closed.
void HidLink::read_reports() noexcept {
  std::array<unsigned char, longest_packet> report{};
  while (!stopping_) {
    const int size = hid_read_timeout(device_, report.data(), report.size(), longest_read);
    if (size < 0 || write_failed_) {
      failed_.fetch_add(size < 0 ? 1 : 0, std::memory_order_relaxed);
      break;
    }
    if (size > 0) {
      last_received_ = Clock::now();
      tell(DeviceFault::none);
      received_.fetch_add(1, std::memory_order_relaxed);
      listener_->received(std::as_bytes(std::span<const unsigned char>(report.data(), static_cast<std::size_t>(size))));
    } else if (Clock::now() - last_received_ >= std::chrono::duration<double>(options_.silence)) {
      tell(DeviceFault::timed_out);
    }
  }
  if (stopping_) return;
  disconnect();
}

void HidLink::reopen() noexcept {
  std::this_thread::sleep_until(opened_at_ + shortest_stay);
  try {
    connect();
    // hidapi does not say why a transfer failed: a device that opens again at once had an error, any other is gone.
    if (told_ != DeviceFault::unplugged) tell(DeviceFault::link_error);
    start();
  } catch (const std::exception&) {
    tell(DeviceFault::unplugged);
    for (const auto end = Clock::now() + std::chrono::duration<double>(options_.search);
         Clock::now() < end && !stopping_;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(longest_read));
    }
  }
}

// ---- the writer

void HidLink::write_packets() noexcept {
  set_real_time_priority(options_.priority);  // what is not permitted, the reader has told
  while (true) {
    const bool last = writer_stops_;
    if (const Packet* packet = newest_.take()) {
      const std::lock_guard<std::mutex> alone(device_mutex_);
      if (device_ != nullptr && !write_failed_) write_report(packet->content());
    }
    if (last) return;
    if (!newest_.waiting()) bell_.wait(writer_pause);
  }
}

/// The device's mutex is held. hidapi wants the number of a report in front, and 0 when there is none.
bool HidLink::write_report(std::span<const std::byte> packet) noexcept {
  std::array<unsigned char, longest_packet + 1> report{};
  const std::size_t start = numbered_ ? 0 : 1;
  std::copy_n(reinterpret_cast<const unsigned char*>(packet.data()), packet.size(), report.data() + start);
  if (hid_write(device_, report.data(), packet.size() + start) < 0) {
    failed_.fetch_add(1, std::memory_order_relaxed);
    write_failed_ = true;
    return false;
  }
  sent_.fetch_add(1, std::memory_order_relaxed);
  return true;
}

}  // namespace calligraphy::phantom
