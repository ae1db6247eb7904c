// Requests and classes: USB Class Definitions for Communications Devices 1.2, PSTN subclass 1.2, sec. 6.3.10 to 6.3.12.
#include "usb_device.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include <calligraphy/base/error.hpp>

#include "known_models.hpp"
#include "sysfs.hpp"

namespace calligraphy::phantom {
namespace {

constexpr std::uint8_t class_request_to_interface = 0x21;  // USB 2.0, sec. 9.3.1
constexpr unsigned char set_line_coding = 0x20;
constexpr unsigned char set_control_line_state = 0x22;
constexpr unsigned terminal_ready = 0x1;
constexpr unsigned request_to_send = 0x2;
constexpr unsigned control_timeout = 500;  // [ms]

std::string port_of(libusb_device* device) {
  std::array<std::uint8_t, 7> ports{};  // the maximum depth of a USB tree
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string text;
  for (int i = 0; i < depth; ++i) {
    text += (i == 0 ? "" : ".") + std::to_string(ports[static_cast<std::size_t>(i)]);
  }
  return text;
}

std::string asked_serial(libusb_device* device, std::uint8_t index) {
  libusb_device_handle* handle = nullptr;
  if (index == 0 || libusb_open(device, &handle) != LIBUSB_SUCCESS) return {};
  std::array<unsigned char, 128> text{};
  const int size = libusb_get_string_descriptor_ascii(handle, index, text.data(), static_cast<int>(text.size()));
  libusb_close(handle);
  return size > 0 ? std::string(text.begin(), text.begin() + size) : std::string();
}

std::string words(int result) { return libusb_strerror(static_cast<libusb_error>(result)); }

/// Holds a reference, so that the device outlives the list in which it was found.
using FoundDevice = std::unique_ptr<libusb_device, void (*)(libusb_device*)>;

FoundDevice find(libusb_context* context, const PluggedDevice& wanted, PluggedDevice& place) {
  FoundDevice found(nullptr, libusb_unref_device);
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context, &list);
  for (ssize_t i = 0; i < count && !found; ++i) {
    libusb_device_descriptor descriptor{};
    libusb_get_device_descriptor(list[i], &descriptor);
    if (descriptor.idVendor != wanted.vendor_id || descriptor.idProduct != wanted.product_id) continue;
    PluggedDevice here = identify(list[i]);
    if (!wanted.serial.empty() && here.serial != wanted.serial) continue;
    place = std::move(here);
    found.reset(libusb_ref_device(list[i]));
  }
  if (count >= 0) libusb_free_device_list(list, 1);
  return found;
}

}  // namespace

std::string permission_advice(const std::string& node) {
  return "no permission to open " + node +
         ": install the udev rule 60-calligraphy.rules (sudo cp lib/udev/rules.d/60-calligraphy.rules "
         "/etc/udev/rules.d/), run \"sudo udevadm control --reload && sudo udevadm trigger\" and plug the device in "
         "again";
}

void refuse(const PluggedDevice& device, const std::string& reason) {
  throw DeviceError(describe_device(device) + ": " + reason);
}

PluggedDevice identify(libusb_device* device) {
  libusb_device_descriptor descriptor{};
  libusb_get_device_descriptor(device, &descriptor);
  PluggedDevice found;
  found.vendor_id = descriptor.idVendor;
  found.product_id = descriptor.idProduct;
  if (const KnownModel* model = known_model(found.vendor_id, found.product_id)) {
    found.model = model->name;
    found.link = model->link;
  }
  found.bus = libusb_get_bus_number(device);
  found.port = port_of(device);
  std::array<char, 32> node{};
  std::snprintf(node.data(), node.size(), "/dev/bus/usb/%03d/%03d", found.bus, libusb_get_device_address(device));
  found.nodes = {node.data()};
  found.serial = serial_at(usb_place(found.bus, found.port));
  if (found.serial.empty()) found.serial = asked_serial(device, descriptor.iSerialNumber);
  return found;
}

void UsbDevice::open(libusb_context* context, const PluggedDevice& wanted) {
  close(false);
  const FoundDevice device = find(context, wanted, place_);
  if (!device) refuse(wanted, "it is not plugged in");
  const int result = libusb_open(device.get(), &handle_);
  if (result != LIBUSB_SUCCESS) {
    handle_ = nullptr;
    refuse(place_, result == LIBUSB_ERROR_ACCESS ? permission_advice(place_.nodes.front())
                                                 : "it cannot be opened: " + words(result));
  }
  try {
    find_endpoints();
    claim_interfaces();
    set_line();
  } catch (...) {
    close(true);
    throw;
  }
}

/// Finds the data interface of a serial device: the first interface with bulk endpoints in both directions.
void UsbDevice::find_endpoints() {
  libusb_config_descriptor* configuration = nullptr;
  const int result = libusb_get_active_config_descriptor(libusb_get_device(handle_), &configuration);
  if (result != LIBUSB_SUCCESS) refuse(place_, "its configuration cannot be read: " + words(result));
  communications_ = data_ = -1;
  for (int i = 0; i < configuration->bNumInterfaces; ++i) {
    if (configuration->interface[i].num_altsetting < 1) continue;
    const libusb_interface_descriptor& interface = configuration->interface[i].altsetting[0];
    if (interface.bInterfaceClass == LIBUSB_CLASS_COMM && communications_ < 0) {
      communications_ = interface.bInterfaceNumber;
    }
    unsigned char in = 0, out = 0;
    int packet_size = 0;
    for (int e = 0; e < interface.bNumEndpoints; ++e) {
      const libusb_endpoint_descriptor& endpoint = interface.endpoint[e];
      if ((endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) != LIBUSB_TRANSFER_TYPE_BULK) continue;
      const bool inward = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0;
      (inward ? in : out) = endpoint.bEndpointAddress;
      if (inward) packet_size = std::max<int>(1, endpoint.wMaxPacketSize);
    }
    if (in == 0 || out == 0 || data_ >= 0) continue;
    data_ = interface.bInterfaceNumber;
    in_ = in;
    out_ = out;
    packet_size_ = packet_size;
  }
  libusb_free_config_descriptor(configuration);
  if (data_ < 0) refuse(place_, "it is not a serial device: no interface has bulk endpoints in both directions");
}

void UsbDevice::claim_interfaces() {
  libusb_set_auto_detach_kernel_driver(handle_, 1);  // not supported everywhere; claiming then fails
  for (const int interface : {communications_, data_}) {
    if (interface < 0 || std::find(claimed_.begin(), claimed_.end(), interface) != claimed_.end()) continue;
    const int result = libusb_claim_interface(handle_, interface);
    if (result == LIBUSB_ERROR_BUSY) {
      refuse(place_, "interface " + std::to_string(interface) + " is in use: close the other program that has it open");
    }
    if (result != LIBUSB_SUCCESS) {
      refuse(place_, "interface " + std::to_string(interface) + " cannot be claimed: " + words(result));
    }
    claimed_.push_back(interface);
  }
}

/// Accepts a stall: a device without a serial line to configure rejects the request.
bool UsbDevice::control(unsigned char request, unsigned value, unsigned char* data, int size) {
  const int result = libusb_control_transfer(
      handle_, class_request_to_interface, request, static_cast<std::uint16_t>(value),
      static_cast<std::uint16_t>(communications_), data, static_cast<std::uint16_t>(size), control_timeout);
  return result == size || result == LIBUSB_ERROR_PIPE;
}

void UsbDevice::set_line() {
  if (communications_ < 0) return;
  std::array<unsigned char, 7> coding{0x00, 0xc2, 0x01, 0x00, 0, 0, 8};  // 115200 baud, 1 stop bit, no parity, 8 bits
  if (!control(set_line_coding, 0, coding.data(), static_cast<int>(coding.size())) ||
      !control(set_control_line_state, terminal_ready | request_to_send, nullptr, 0)) {
    refuse(place_, "its serial line cannot be set up: unplug it and plug it in again");
  }
}

void UsbDevice::close(bool still_there) noexcept {
  if (handle_ == nullptr) return;
  if (still_there) {
    if (communications_ >= 0 && !claimed_.empty()) control(set_control_line_state, 0, nullptr, 0);
    for (const int interface : claimed_) libusb_release_interface(handle_, interface);
  }
  claimed_.clear();
  libusb_close(handle_);
  handle_ = nullptr;
}

}  // namespace calligraphy::phantom
