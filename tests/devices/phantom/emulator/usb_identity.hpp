// Descriptors of an emulated device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy_test {

using Octets = std::vector<std::uint8_t>;

struct UsbIdentity {
  std::uint16_t vendor = 0x2988;
  std::uint16_t product = 0x0302;
  calligraphy::LinkKind link = calligraphy::LinkKind::usb;
  std::string serial = "540-00001";
};

UsbIdentity serial_touch(const std::string& serial = "540-00001");
UsbIdentity swapped_touch(const std::string& serial = "540-00001");
UsbIdentity hid_touch(const std::string& serial = "540-00001");

/// Bytes of a report to the host and to the device: those of the `simulated` wire profile, without a number in front.
/// No layout of a real HID is public.
constexpr int report_size = 44;
constexpr int command_size = 16;

constexpr std::uint8_t in_endpoint = 0x81;
constexpr std::uint8_t out_endpoint = 0x02;
constexpr std::uint8_t notification_endpoint = 0x83;

Octets device_descriptor(const UsbIdentity& identity);
/// 67 bytes for the two interfaces of a serial device, 41 for the one of a HID.
Octets configuration_descriptor(const UsbIdentity& identity);
Octets report_descriptor();
/// Index 0 is the table of languages; 1 maker, 2 product, 3 serial number.
Octets string_descriptor(const UsbIdentity& identity, int index);

/// Upper-case hexadecimal without blanks, as umockdev reads it.
std::string packed_hexadecimal(const Octets& bytes);

}  // namespace calligraphy_test
