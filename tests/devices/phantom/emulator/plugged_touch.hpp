// A link to an emulated device on a test bed, and the events that it reports.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <hidapi.h>

#include "catch.hpp"
#include "devices/phantom/link/make_link.hpp"
#include "emulated_device.hpp"
#include "recording_listener.hpp"

namespace calligraphy_test {

using Faults = std::vector<calligraphy::DeviceFault>;

/// hidapi-libusb keeps listening to the test bed in which it was started, so it is shut down with it.
class FreshBed : public TestBed {
 public:
  ~FreshBed() { hid_exit(); }
};

/// Whether a program has pending transfers or the hidraw node open.
inline bool listens(const HostActions& host) { return host.flying + host.open_nodes > 0; }

/// Time-outs long enough to avoid false faults on a busy machine; a device that comes back is opened immediately.
constexpr calligraphy::phantom::LinkOptions patient{60.0, 60.0, 0.005, 0.005};

inline std::span<const std::byte> as_packet(const Octets& bytes) { return std::as_bytes(std::span(bytes)); }

inline Octets numbered(std::uint8_t number, std::size_t size = 44) {
  Octets packet(size, 0x5a);
  packet.front() = number;
  return packet;
}

struct PluggedTouch {
  explicit PluggedTouch(const UsbIdentity& identity = serial_touch(),
                        const calligraphy::phantom::LinkOptions& options = patient)
      : device(bed, identity) {
    device.plug_in(1, "2");
    link = calligraphy::phantom::make_link(std::string(), options);
  }

  void open() {
    link->open(listener);
    REQUIRE(device.wait(listens));
  }

  /// Pushes one packet and waits until the link has delivered it.
  void exchange(const Octets& packet) {
    const std::size_t before = listener.packets().size();
    device.push(packet);
    REQUIRE(listener.wait_for_packets(before + 1));
  }

  FreshBed bed;
  EmulatedDevice device;
  RecordingListener listener;
  std::unique_ptr<calligraphy::phantom::Link> link;
};

}  // namespace calligraphy_test
