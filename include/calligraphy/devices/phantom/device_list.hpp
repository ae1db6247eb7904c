// Which Phantoms are plugged in, and what to do when one may not be opened.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace calligraphy {

/// How a Phantom speaks on the bus.
enum class LinkKind : std::uint8_t {
  usb,  ///< a serial line over bulk transfers (CDC-ACM), served by libusb
  hid   ///< human interface device, served by hidapi
};

/// "usb", "hid".
const char* link_name(LinkKind link) noexcept;

/// A device on the bus, open or not. Known by its ids alone: what it answers is asked when it is opened.
struct PluggedDevice {
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::string model;  ///< what these ids stand for, in words
  LinkKind link = LinkKind::usb;
  int bus = 0;
  std::string port;                ///< from the root of the bus, "2" or "1.4"
  std::vector<std::string> nodes;  ///< /dev/bus/usb/001/002, /dev/hidraw0
  std::string serial;              ///< empty: it has none, or it cannot be read
  bool may_open = false;           ///< the node that this library would open lets this user read and write
  std::string advice;              ///< what to do when it may not be opened; empty when it may
};

/// "2988:0302 on bus 1, port 2, serial 540-12345".
std::string describe(const PluggedDevice& device);

/// Every device whose ids are those of a Phantom, by bus and port. Opens none of them where the system tells the serial
/// number otherwise, as Linux does. @throws DeviceError when the bus cannot be read at all
std::vector<PluggedDevice> plugged_devices();

/// What the device says of itself: device, configuration, interface and endpoint descriptors, and for a HID its report
/// descriptor, each as hexadecimal bytes and in words. Needs no permission to open it.
std::string dump_descriptors(const PluggedDevice& device);

}  // namespace calligraphy
