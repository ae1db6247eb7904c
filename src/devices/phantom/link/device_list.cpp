// libusb lists all devices on the bus without opening them; the hidraw nodes of a HID come from the system.
#include <calligraphy/devices/phantom/device_list.hpp>

#include <algorithm>
#include <cstdio>
#include <tuple>

#include <libusb.h>

#include <calligraphy/base/error.hpp>

#include "descriptor_text.hpp"
#include "devices/phantom/wire/hexadecimal.hpp"
#include "hid_link.hpp"
#include "known_models.hpp"
#include "report_descriptor.hpp"
#include "sysfs.hpp"
#include "usb_device.hpp"
#include "usb_events.hpp"

namespace calligraphy {

using namespace phantom;

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
