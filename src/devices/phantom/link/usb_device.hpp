// A serial device on the USB, opened and ready for bulk transfers.
#pragma once

#include <string>
#include <vector>

#include <libusb.h>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy::phantom {

/// @throws DeviceError naming the device
[[noreturn]] void refuse(const PluggedDevice& device, const std::string& reason);

/// What to do about a node that this user may not open: names the udev rule.
std::string permission_advice(const std::string& node);

/// Bus, port and nodes as libusb tells them; the serial number from the system, or else asked of the device.
PluggedDevice identify(libusb_device* device);

/// Every Phantom on the bus by place, without saying whether it may be opened.
/// @throws DeviceError when the bus cannot be read
std::vector<PluggedDevice> devices_on_bus(libusb_context* context);

/// Owns the handle and the claimed interfaces. Closing gives them back to the system's own driver (cdc_acm).
///
/// No alternate setting is ever chosen: libusb 1.0.26 may abort there once the device is gone (libusb issue 1199).
class UsbDevice {
 public:
  UsbDevice() = default;
  ~UsbDevice() { close(true); }
  UsbDevice(const UsbDevice&) = delete;
  UsbDevice& operator=(const UsbDevice&) = delete;

  /// Finds the device of these ids and, unless it is empty, this serial number, wherever it is plugged in; claims its
  /// interfaces, sets 115200 baud, 8 data bits, no parity, 1 stop bit and raises DTR. Blocks for a few control
  /// transfers; not to be called from a callback of libusb.
  /// @throws DeviceError when it is not there, may not be opened, or is no serial device
  void open(libusb_context* context, const PluggedDevice& wanted);

  /// Lowers DTR, which ends the servo mode of a Touch, and gives the interfaces back; a device that is gone can only be
  /// let go.
  void close(bool still_there) noexcept;

  libusb_device_handle* handle() const noexcept { return handle_; }
  unsigned char in_endpoint() const noexcept { return in_; }
  unsigned char out_endpoint() const noexcept { return out_; }
  /// Largest packet from the device [bytes].
  int packet_size() const noexcept { return packet_size_; }
  /// Where it was found.
  const PluggedDevice& place() const noexcept { return place_; }

 private:
  void find_endpoints();
  void claim_interfaces();
  void set_line();
  bool control(unsigned char request, unsigned value, unsigned char* data, int size);

  libusb_device_handle* handle_ = nullptr;
  PluggedDevice place_;
  std::vector<int> claimed_;
  int communications_ = -1;  ///< interface of the line's control requests; -1: it has none
  int data_ = -1;
  unsigned char in_ = 0;
  unsigned char out_ = 0;
  int packet_size_ = 0;
};

}  // namespace calligraphy::phantom
