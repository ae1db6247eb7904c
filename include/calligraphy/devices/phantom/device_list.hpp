// Lists the connected Phantoms, with a remedy for those that this user may not open.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace calligraphy {

/// How a Phantom communicates on the bus.
enum class LinkKind : std::uint8_t {
  usb,  ///< a serial line over bulk transfers (CDC-ACM), through libusb
  hid   ///< a human interface device, through hidapi
};

/// "usb", "hid".
const char* to_string(LinkKind link) noexcept;

/// A device on the bus, open or not. Identified by its ids only; communication begins when it is opened.
struct PluggedDevice {
  std::uint16_t vendor_id = 0;     ///< USB vendor id
  std::uint16_t product_id = 0;    ///< USB product id
  std::string model;               ///< display name for these ids
  LinkKind link = LinkKind::usb;   ///< how it communicates
  int bus = 0;                     ///< number of the USB bus
  std::string port;                ///< path from the root of the bus, "2" or "1.4"
  std::vector<std::string> nodes;  ///< paths of its device nodes: /dev/bus/usb/001/002, /dev/hidraw0
  std::string serial;              ///< serial number; empty: none, or not readable
  bool may_open = false;           ///< this user may read and write the node that this library would open
  std::string advice;              ///< what to do if it may not be opened; otherwise empty
};

/// For example "2988:0302 on bus 1, port 2, serial 540-12345".
std::string describe_device(const PluggedDevice& device);

/// All devices with the ids of a Phantom, sorted by bus and port. Does not open them if the system provides serial
/// numbers without opening, as Linux does. @throws DeviceError when the bus cannot be read
std::vector<PluggedDevice> plugged_devices();

/// Device, configuration, interface and endpoint descriptors, and the report descriptor of a HID, each as hexadecimal
/// bytes and decoded. Needs no permission to open the device.
std::string dump_descriptors(const PluggedDevice& device);

}  // namespace calligraphy
