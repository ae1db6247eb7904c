// What a device sends, as it came: the raw material of a wire profile.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <vector>

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy {

struct CaptureOptions {
  std::size_t transfers = 1000;          ///< ends after so many
  double seconds = 10.0;                 ///< and after this time whatever has come [s]
  std::function<bool()> stop = nullptr;  ///< and when this says so; asked ten times a second
};

/// One transfer from the device: for a serial device a packet of the bus, for a HID a report.
struct CapturedTransfer {
  double time = 0.0;  ///< since the device was opened [s]
  std::vector<std::byte> bytes;
};

struct Capture {
  PluggedDevice device;
  std::vector<CapturedTransfer> transfers;
};

/// Opens the device, sends it nothing and listens. @throws DeviceError when it cannot be opened, ValueError when a
/// limit is not above 0
Capture capture(const PluggedDevice& device, const CaptureOptions& options = {});

/// The capture as text: lines that begin with # tell of the device; then a line for each transfer, its time [s] with
/// six decimals, a blank, and its bytes in hexadecimal with blanks between them; "-" is a transfer without a byte.
void write_capture(std::ostream& out, const Capture& capture);

}  // namespace calligraphy
