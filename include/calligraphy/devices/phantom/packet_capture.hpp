// Captures raw packets of a device, for writing a wire profile.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <vector>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy {

/// Ends of a capture; the first one reached applies.
struct CaptureOptions {
  std::size_t transfers = 1000;          ///< ends after this many transfers
  double seconds = 10.0;                 ///< or after this time [s]
  std::function<bool()> stop = nullptr;  ///< or when this returns true; polled ten times a second
};

/// One transfer from the device: a bus packet of a serial device, a report of a HID.
struct CapturedTransfer {
  double time = 0.0;             ///< since the device was opened [s]
  std::vector<std::byte> bytes;  ///< as received; with numbered reports of a HID, the number comes first
};

/// The transfers received from a device.
struct PacketCapture {
  PluggedDevice device;                     ///< source of the transfers
  std::vector<CapturedTransfer> transfers;  ///< in the order of their arrival
};

/// Opens the device and listens without sending packets. @throws DeviceError when it cannot be opened, ValueError when
/// a limit is not above 0
PacketCapture capture_packets(const PluggedDevice& device, const CaptureOptions& options = {});

/// Writes the capture as text: lines beginning with # describe the device; then one line per transfer with its time [s]
/// to six decimals and its bytes in hexadecimal, separated by spaces; "-" stands for a transfer without any bytes.
void write_packet_capture(std::ostream& out, const PacketCapture& capture);

}  // namespace calligraphy
