// A USB device plugged into a test bed: the bus as a driver sees it, with injected faults.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "test_bed.hpp"
#include "usb_identity.hpp"

namespace calligraphy_test {

class HidrawNode;
class UsbfsNode;

/// Order in which a host learns that a device is gone. Both occur with real hosts.
enum class UnplugOrder {
  error_first,  ///< the transfers under way end in an error, and only the next one says that there is no device
  gone_first    ///< the transfers under way say that there is no device
};

/// How the device responds to packets from the host.
enum class Taking { at_once, never, stalls };

/// State of the device as set by the host.
struct HostActions {
  int control_line = 0;       ///< bit 0: DTR
  Octets line_coding;         ///< as sent
  std::set<int> claimed;      ///< interfaces that a program has
  std::set<int> with_driver;  ///< interfaces that the system's own driver has
  int cleared_halts = 0;
  int flying = 0;      ///< pending transfers from the device
  int held = 0;        ///< transfers to the device that it has not accepted
  int open_nodes = 0;  ///< programs that have the hidraw node open
  int identified = 0;  ///< questions to the hidraw node for its ids
  int described = 0;   ///< the same for its descriptor: hidapi-hidraw opens the node
};

/// Behind the nodes stands one queue each way. A packet that finds no transfer waits for the next one, as it would in
/// the device's buffer; of those that wait the newest sixteen are kept.
class EmulatedDevice {
 public:
  EmulatedDevice(TestBed& bed, UsbIdentity identity);
  ~EmulatedDevice();
  EmulatedDevice(const EmulatedDevice&) = delete;
  EmulatedDevice& operator=(const EmulatedDevice&) = delete;

  const UsbIdentity& identity() const { return identity_; }

  /// Its nodes get new numbers each time, as they do on a real bus.
  void plug_in(int bus, const std::string& port);
  void unplug(UnplugOrder order);
  /// As an unplug begins: the hidraw node answers no more, while the bus and the system still list it.
  void let_go();
  bool plugged() const { return !system_paths_.empty(); }

  /// Called with each packet from the host, in the test bed's thread.
  void on_packet(std::function<void(std::span<const std::byte>)> listener);

  /// A packet to the host; an empty one is a transfer without a byte.
  void push(const Octets& packet);

  /// Ends the next transfer from the device with an error of the system: EPROTO, EOVERFLOW, EILSEQ. With EPIPE the
  /// endpoint stays halted until the host clears it.
  void fail_next(int error);

  void set_taking(Taking taking);

  HostActions host() const;
  std::uint64_t packets_taken() const;

  /// Waits at most ten seconds; false if the condition was not met.
  bool wait(const std::function<bool(const HostActions&)>& reached) const;
  bool wait_for_packets(std::uint64_t count) const;

  /// Real paths of its nodes, to change who may open them.
  std::vector<std::string> node_files() const;

 private:
  friend class UsbfsNode;
  friend class HidrawNode;

  struct Waiting {
    Octets bytes;
    int error = 0;
  };
  void took(std::span<const std::byte> packet);
  void queue(Waiting packet);
  void retire_closed();

  TestBed& bed_;
  const UsbIdentity identity_;
  std::vector<std::string> system_paths_;  ///< children first
  std::string usb_node_, hid_node_;

  mutable std::mutex mutex_;
  mutable std::condition_variable happened_;
  std::function<void(std::span<const std::byte>)> listener_;
  std::deque<Waiting> waiting_;  ///< to the host
  bool in_halted_ = false;
  bool out_halted_ = false;
  Taking taking_ = Taking::at_once;
  HostActions host_;
  std::uint64_t taken_ = 0;

  std::unique_ptr<UsbfsNode> usbfs_;
  std::unique_ptr<HidrawNode> hidraw_;
  std::vector<std::unique_ptr<UsbfsNode>> retired_usbfs_;  ///< of earlier plugs, until no program has them open
  std::vector<std::unique_ptr<HidrawNode>> retired_hidraw_;
};

}  // namespace calligraphy_test
