// Layouts: USB 2.0, sec. 9.6; the serial device: Communications Devices 1.2, sec. 5.2.3; the HID: HID 1.11, sec. 6.2.
#include "usb_identity.hpp"

namespace calligraphy_test {
namespace {

std::uint8_t low(unsigned word) { return static_cast<std::uint8_t>(word & 0xffu); }
std::uint8_t high(unsigned word) { return static_cast<std::uint8_t>(word >> 8); }

}  // namespace

UsbIdentity serial_touch(const std::string& serial) { return {0x2988, 0x0302, calligraphy::LinkKind::usb, serial}; }
UsbIdentity swapped_touch(const std::string& serial) { return {0x0301, 0x2988, calligraphy::LinkKind::usb, serial}; }
UsbIdentity hid_touch(const std::string& serial) { return {0x2988, 0x0304, calligraphy::LinkKind::hid, serial}; }

Octets device_descriptor(const UsbIdentity& identity) {
  const bool serial = identity.link == calligraphy::LinkKind::usb;
  return {18,
          1,
          0x00,
          0x02,
          static_cast<std::uint8_t>(serial ? 2 : 0),
          0,
          0,
          64,
          low(identity.vendor),
          high(identity.vendor),
          low(identity.product),
          high(identity.product),
          0x00,
          0x01,
          1,
          2,
          static_cast<std::uint8_t>(identity.serial.empty() ? 0 : 3),
          1};
}

Octets configuration_descriptor(const UsbIdentity& identity) {
  // clang-format off
  if (identity.link == calligraphy::LinkKind::usb) {
    return {9, 2, 67, 0, 2, 1, 0, 0xc0, 50,
            9, 4, 0, 0, 1, 2, 2, 1, 0,                       // communications, abstract control model
            5, 0x24, 0, 0x10, 0x01,                          // header
            5, 0x24, 1, 0, 1,                                // call management
            4, 0x24, 2, 2,                                   // abstract control: line coding and state
            5, 0x24, 6, 0, 1,                                // union
            7, 5, notification_endpoint, 3, 8, 0, 16,
            9, 4, 1, 0, 2, 10, 0, 0, 0,                      // data
            7, 5, in_endpoint, 2, 64, 0, 0,
            7, 5, out_endpoint, 2, 64, 0, 0};
  }
  return {9, 2, 41, 0, 1, 1, 0, 0xc0, 50,
          9, 4, 0, 0, 2, 3, 0, 0, 0,
          9, 0x21, 0x11, 0x01, 0, 1, 0x22, low(static_cast<unsigned>(report_descriptor().size())), 0,
          7, 5, in_endpoint, 3, report_size, 0, 1,
          7, 5, out_endpoint, 3, report_size, 0, 1};
  // clang-format on
}

Octets report_descriptor() {
  // clang-format off
  return {0x06, 0x00, 0xff,        // usage page: the vendor's own
          0x09, 0x01,              // usage 1
          0xa1, 0x01,              // collection: application
          0x15, 0x00,              //   logical minimum 0
          0x26, 0xff, 0x00,        //   logical maximum 255
          0x75, 0x08,              //   report size 8 bits
          0x95, report_size,       //   report count
          0x09, 0x02, 0x81, 0x02,  //   usage 2, input: data, variable, absolute
          0x95, command_size,      //   report count
          0x09, 0x03, 0x91, 0x02,  //   usage 3, output: the same
          0xc0};
  // clang-format on
}

Octets string_descriptor(const UsbIdentity& identity, int index) {
  if (index == 0) return {4, 3, 0x09, 0x04};
  const std::string text = index == 1 ? "calligraphy" : index == 2 ? "emulated Phantom" : identity.serial;
  Octets descriptor{static_cast<std::uint8_t>(2 + 2 * text.size()), 3};
  for (const char c : text) {
    descriptor.push_back(static_cast<std::uint8_t>(c));
    descriptor.push_back(0);
  }
  return descriptor;
}

std::string packed_hexadecimal(const Octets& bytes) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

}  // namespace calligraphy_test
