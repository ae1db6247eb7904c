// Interface for transferring bytes between the host and a device, independent of the bus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy::phantom {

/// Receives the events of a link. Called from one of the link's own threads; must neither block nor throw.
class LinkListener {
 public:
  virtual ~LinkListener() = default;

  /// One transfer, possibly empty: a packet, or the next part of a stream. Valid only during the call.
  virtual void received(std::span<const std::byte> bytes) noexcept = 0;

  /// `none`: the link has come up, for the first time or again, possibly at another port. Otherwise the cause of a
  /// failure; `timed_out` is repeated about once a second while it persists.
  virtual void changed(DeviceFault fault) noexcept = 0;

  /// The packet that sets the motors' force to zero, sent by Link::cut_force(); constant while the link is open, empty
  /// if there is none. Also called from signal handlers.
  virtual std::span<const std::byte> stop_packet() const noexcept { return {}; }
};

/// Times by the wall clock, far above the few milliseconds after which a servo loop reports a device as silent, so that
/// a link reports a time-out only if the bus is at fault.
struct LinkOptions {
  double silence = 1.0;  ///< time without a transfer from the device until `timed_out` is reported, or repeated [s]
  double answer = 0.25;  ///< time for the device to accept a packet, until `timed_out` [s]
  double search = 0.1;   ///< interval of searches for a missing device if the system reports no hot-plug events [s]
  double settle = 0.3;   ///< time for which the node of a HID must answer before it is opened again [s]
  int priority = 0;      ///< real-time priority of its threads, 1 to 99; 0: normal threads
};

/// Transfers since the link was opened.
struct LinkCounts {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t replaced = 0;  ///< outgoing packets superseded by a newer one
  std::uint64_t failed = 0;    ///< transfers that ended in an error
  std::uint64_t opened = 0;    ///< number of times the device was found, including the first
};

/// Connection to a device on a bus, served by its own thread. It survives unplugging, finds the device by its serial
/// number at any port, and reports both to its listener.
class Link {
 public:
  /// Stops the thread; the listener is not called afterwards.
  virtual ~Link() = default;

  /// The listener must outlive the link. @throws DeviceError naming device, cause and remedy
  virtual void open(LinkListener& listener) = 0;

  /// Sends a packet as soon as the bus accepts one; it replaces a packet that is still pending. Copies the bytes and
  /// neither blocks nor allocates. Returns false and sends nothing if the packet is too long for the link.
  virtual bool send(std::span<const std::byte> packet) noexcept = 0;

  /// Sends a packet that no later one may overtake (such as enabling the servo or requesting a serial number) and waits
  /// for its completion. Call it during set-up or from the listener's `changed`, never from the servo loop.
  /// @throws DeviceError
  virtual void command(std::span<const std::byte> packet) = 0;

  /// Sends the listener's stop packet in an emergency stop and waits until it is transferred, for 0.1 s at most; while
  /// emergency_stopped() no other packet of send() follows. Async-signal-safe.
  virtual void cut_force() noexcept = 0;

  virtual LinkCounts counts() const noexcept = 0;

  /// Privileges that the system refused to the link's threads, each with a remedy; valid once the link is open.
  virtual const std::vector<std::string>& warnings() const noexcept = 0;

  /// For messages: "2988:0302 on bus 1, port 2, serial 540-12345".
  virtual const std::string& description() const noexcept = 0;
  virtual const std::string& serial() const noexcept = 0;
};

}  // namespace calligraphy::phantom
