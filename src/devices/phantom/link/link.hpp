// The bytes between the host and a device: what a codec stands on, whatever the bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy::phantom {

/// Who is told what a link sees. Called from one thread of the link's own; may neither block nor throw.
class LinkListener {
 public:
  virtual ~LinkListener() = default;

  /// One transfer as it came, an empty one too: a packet, or the next part of a stream. Valid during the call alone.
  virtual void received(std::span<const std::byte> bytes) noexcept = 0;

  /// The link is up for the first time or again, perhaps in another place: `none`; or what has gone wrong with it.
  /// `timed_out` is told again and again as long as it lasts, a second or so apart.
  virtual void changed(DeviceFault fault) noexcept = 0;
};

/// Transfers since the link was opened.
struct LinkCounts {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t replaced = 0;  ///< packets to send that a newer one overtook
  std::uint64_t failed = 0;    ///< transfers that ended in an error
  std::uint64_t opened = 0;    ///< times that the device was found, the first included
};

/// A device on a bus, served by one thread of its own. It goes on when the device is unplugged, finds it by its serial
/// number wherever it is plugged in again, and tells its listener of both.
class Link {
 public:
  /// Stops the thread; the listener hears nothing afterwards.
  virtual ~Link() = default;

  /// The listener must outlive the link. @throws DeviceError naming device, reason and what can be done
  virtual void open(LinkListener& listener) = 0;

  /// Sends a packet as soon as the bus takes one; one that still waits is replaced: the newest wins. Copies the bytes;
  /// neither blocks nor allocates. False, and nothing is sent, when the packet is longer than the link can hold.
  virtual bool send(std::span<const std::byte> packet) noexcept = 0;

  /// Sends a packet that no later one may overtake (enabling the servo, asking for a serial number), and waits for its
  /// end; from set-up or the listener's `changed`, never from the servo loop. @throws DeviceError
  virtual void command(std::span<const std::byte> packet) = 0;

  virtual LinkCounts counts() const noexcept = 0;

  /// What the system did not permit to the link's threads, each with what to do; once it is open.
  virtual const std::vector<std::string>& warnings() const noexcept = 0;

  /// "2988:0302 on bus 1, port 2, serial 540-12345": for messages.
  virtual const std::string& description() const noexcept = 0;
  virtual const std::string& serial() const noexcept = 0;
};

}  // namespace calligraphy::phantom
