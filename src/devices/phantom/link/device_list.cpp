// libusb lists all devices on the bus without opening them; the hidraw nodes of a HID come from the system.
#include <calligraphy/devices/phantom/device_list.hpp>

#include <algorithm>
#include <cstdio>
#include <tuple>

#include <libusb.h>

#include <calligraphy/base/error.hpp>

#include "devices/phantom/wire/hexadecimal.hpp"
#include "hid_link.hpp"
#include "known_models.hpp"
#include "report_descriptor.hpp"
#include "sysfs.hpp"
#include "usb_device.hpp"
#include "usb_events.hpp"

namespace calligraphy {

using namespace phantom;

namespace {

class Fields {
 public:
  explicit Fields(std::span<const std::byte> bytes) : bytes_(bytes) {}
  unsigned byte(std::size_t at) const { return at < bytes_.size() ? std::to_integer<unsigned>(bytes_[at]) : 0u; }
  unsigned word(std::size_t at) const { return byte(at) | byte(at + 1) << 8; }

 private:
  std::span<const std::byte> bytes_;
};

std::string hex(unsigned value, int digits) {
  char text[12];
  std::snprintf(text, sizeof text, "%0*x", digits, value);
  return text;
}

std::string decimal_version(unsigned version) { return hex(version >> 8, 1) + "." + hex(version & 0xffu, 2); }

std::string endpoint(const Fields& at) {
  constexpr const char* types[] = {"control", "isochronous", "bulk", "interrupt"};
  return "endpoint " + std::to_string(at.byte(2) & 0x0fu) +
         ((at.byte(2) & 0x80u) != 0 ? " to the host, " : " to the device, ") + types[at.byte(3) & 3u] +
         ", packets of " + std::to_string(at.word(4) & 0x7ffu) + " bytes, interval " + std::to_string(at.byte(6));
}

std::string words(const Fields& at) {
  switch (at.byte(1)) {
    case 1:
      return "device " + hex(at.word(8), 4) + ":" + hex(at.word(10), 4) + ", USB " + decimal_version(at.word(2)) +
             ", release " + decimal_version(at.word(12)) + ", class " + hex(at.byte(4), 2) + ", " +
             std::to_string(at.byte(17)) + " configuration(s)";
    case 2:
      return "configuration " + std::to_string(at.byte(5)) + ", " + std::to_string(at.byte(4)) + " interface(s), " +
             std::to_string(at.word(2)) + " bytes in total, " + std::to_string(2 * at.byte(8)) + " mA";
    case 4:
      return "interface " + std::to_string(at.byte(2)) + ", setting " + std::to_string(at.byte(3)) + ", class " +
             hex(at.byte(5), 2) + ", subclass " + hex(at.byte(6), 2) + ", protocol " + hex(at.byte(7), 2) + ", " +
             std::to_string(at.byte(4)) + " endpoint(s)";
    case 5:
      return endpoint(at);
    case 0x21:
      return "HID " + decimal_version(at.word(2)) + ", report descriptor of " + std::to_string(at.word(7)) + " bytes";
    case 0x24:
      return "class-specific interface descriptor";
    default:
      return "type " + hex(at.byte(1), 2);
  }
}

/// One paragraph per descriptor: its decoded fields, then its bytes in hexadecimal. A descriptor of an unknown class is
/// shown as bytes only; a truncated one or an impossible length ends the text with a note. Layouts: Universal Serial
/// Bus Specification 2.0, sec. 9.6; the HID descriptor: HID 1.11, sec. 6.2.1.
std::string descriptor_text(std::span<const std::byte> descriptors) {
  std::string text;
  while (!descriptors.empty()) {
    const auto length = std::to_integer<std::size_t>(descriptors[0]);
    if (length < 2 || length > descriptors.size()) {
      return text + "truncated: " + hexadecimal(descriptors) + "\n";
    }
    const std::span<const std::byte> descriptor = descriptors.first(length);
    text += words(Fields(descriptor)) + "\n  " + hexadecimal(descriptor) + "\n";
    descriptors = descriptors.subspan(length);
  }
  return text;
}

}  // namespace

const char* to_string(LinkKind link) noexcept { return link == LinkKind::hid ? "hid" : "usb"; }

std::string describe_device(const PluggedDevice& device) {
  char ids[10];
  std::snprintf(ids, sizeof ids, "%04x:%04x", device.vendor_id, device.product_id);
  std::string text = ids;
  if (!device.port.empty()) text += " on bus " + std::to_string(device.bus) + ", port " + device.port;
  return text + (device.serial.empty() ? ", no serial number" : ", serial " + device.serial);
}

std::vector<PluggedDevice> phantom::devices_on_bus(libusb_context* context) {
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context, &list);
  if (count < 0) {
    throw DeviceError(std::string("cannot list the USB devices: ") + libusb_strerror(static_cast<libusb_error>(count)));
  }
  std::vector<PluggedDevice> devices;
  for (ssize_t i = 0; i < count; ++i) {
    libusb_device_descriptor descriptor{};
    libusb_get_device_descriptor(list[i], &descriptor);
    if (known_model(descriptor.idVendor, descriptor.idProduct) == nullptr) continue;
    PluggedDevice device = identify(list[i]);
    if (device.link == LinkKind::hid) {
      for (const std::string& node : hidraw_nodes_at(usb_place(device.bus, device.port))) {
        device.nodes.push_back(node);
      }
    }
    devices.push_back(std::move(device));
  }
  libusb_free_device_list(list, 1);
  std::sort(devices.begin(), devices.end(), [](const PluggedDevice& a, const PluggedDevice& b) {
    return std::tie(a.bus, a.port) < std::tie(b.bus, b.port);
  });
  return devices;
}

std::vector<PluggedDevice> plugged_devices() {
  const UsbEvents bus;
  std::vector<PluggedDevice> devices = devices_on_bus(bus.context());
  for (PluggedDevice& device : devices) {
    std::string opened = device.nodes.front();
    if (device.link == LinkKind::hid) {
      const std::string path = hid_path(device);  // hidapi-libusb returns a bus address, not a node
      if (path.rfind("/dev/", 0) == 0) opened = path;
    }
    device.may_open = may_open(opened);
    if (!device.may_open) device.advice = permission_advice(opened);
  }
  return devices;
}

std::string dump_descriptors(const PluggedDevice& device) {
  const std::string place = usb_place(device.bus, device.port);
  const std::vector<std::byte> descriptors = descriptors_at(place);
  std::string text = describe_device(device) + "\n";
  if (descriptors.empty()) return text + "descriptors: not provided by the system\n";
  text += descriptor_text(descriptors);
  if (device.link != LinkKind::hid) return text;
  const std::vector<std::byte> report = report_descriptor_at(place);
  if (report.empty()) return text + "report descriptor: not available while a program has the device open\n";
  return text + "report descriptor, " + std::to_string(report.size()) + " bytes\n" + report_descriptor_text(report);
}

}  // namespace calligraphy
