// A serial device on USB, opened and ready for bulk transfers.
#pragma once

#include <string>
#include <vector>

#include <libusb.h>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy::phantom {

/// @throws DeviceError naming the device
[[noreturn]] void refuse(const PluggedDevice& device, const std::string& reason);

/// Remedy for a node that this user may not open; names the udev rule.
std::string permission_advice(const std::string& node);

/// Bus, port and nodes come from libusb, the serial number from the system or, failing that, from the device.
PluggedDevice identify(libusb_device* device);

/// All Phantoms, sorted by bus and port, without checking whether they may be opened.
/// @throws DeviceError when the bus cannot be read
std::vector<PluggedDevice> devices_on_bus(libusb_context* context);

/// Owns the handle and the claimed interfaces. Closing returns them to the system's driver (cdc_acm).
///
/// It never selects an alternate setting: libusb 1.0.26 may abort there if the device is gone (libusb issue 1199).
class UsbDevice {
 public:
  UsbDevice() = default;
  ~UsbDevice() { close(true); }
  UsbDevice(const UsbDevice&) = delete;
  UsbDevice& operator=(const UsbDevice&) = delete;

  /// Finds the device with these ids and, unless empty, this serial number, at any port; claims its interfaces, sets
  /// 115200 baud, 8 data bits, no parity, 1 stop bit and raises DTR. Blocks for a few control transfers; must not be
  /// called from a libusb callback.
  /// @throws DeviceError when it is not connected, may not be opened, or is not a serial device
  void open(libusb_context* context, const PluggedDevice& wanted);

  /// Lowers DTR, which ends the servo mode of a Touch, and releases the interfaces. If the device is gone, only the
  /// handle is closed.
  void close(bool still_there) noexcept;

  libusb_device_handle* handle() const noexcept { return handle_; }
  unsigned char in_endpoint() const noexcept { return in_; }
  unsigned char out_endpoint() const noexcept { return out_; }
  /// Maximum packet size from the device [bytes].
  int packet_size() const noexcept { return packet_size_; }
  /// The device as it was found.
  const PluggedDevice& place() const noexcept { return place_; }

 private:
  void find_endpoints();
  void claim_interfaces();
  void set_line();
  bool control(unsigned char request, unsigned value, unsigned char* data, int size);

  libusb_device_handle* handle_ = nullptr;
  PluggedDevice place_;
  std::vector<int> claimed_;
  int communications_ = -1;  ///< interface for control requests of the serial line; -1: none
  int data_ = -1;
  unsigned char in_ = 0;
  unsigned char out_ = 0;
  int packet_size_ = 0;
};

}  // namespace calligraphy::phantom
