// Base of links over any bus: the thread that serves the device, the faults notified, and the counts.
#pragma once

#include <atomic>
#include <cstdint>
#include <future>
#include <list>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/devices/phantom/device_list.hpp>

#include "link.hpp"
#include "newest_packet.hpp"

namespace calligraphy::phantom {

/// Derived classes must join the thread in their destructor, while everything that the thread uses still exists.
class ThreadedLink : public Link {
 public:
  ThreadedLink(const PluggedDevice& device, const LinkOptions& options);

  void open(LinkListener& listener) override;
  bool send(std::span<const std::byte> packet) noexcept override;
  void cut_force() noexcept override;
  LinkCounts counts() const noexcept override { return {received_, sent_, replaced_, failed_, opened_}; }
  const std::vector<std::string>& warnings() const noexcept override { return warnings_; }
  const std::string& description() const noexcept override { return *description_.load(); }
  const std::string& serial() const noexcept override { return wanted_.serial; }

 protected:
  /// Body of the thread: runs until `stopping_`. Reports through `opened` whether the device could be opened the first
  /// time, and returns if not; the listener has been notified by then.
  virtual void run(std::promise<void> opened) noexcept = 0;

  /// Wakes the thread because a packet is waiting. Callable from any thread; neither blocks nor allocates.
  virtual void wake() noexcept = 0;

  /// Writes the packet by the lowest-level system call, if the bus permits it, in case the link's thread does not
  /// answer because it is the one that crashed. Async-signal-safe.
  virtual void write_directly(std::span<const std::byte> packet) noexcept = 0;

  /// The packet to write next: the newest, or the stop packet in an emergency stop; null if there is none. Call from
  /// the writing thread only.
  const Packet* next_packet() noexcept;
  bool packet_waits() const noexcept { return newest_.waiting() || cut_wanted_.load(std::memory_order_relaxed); }
  /// Call when the packet from next_packet() has been written.
  void packet_written(const Packet& packet) noexcept;

  void join();

  /// Records where the device was opened.
  void found_at(const PluggedDevice& place);

  /// Notifies the listener of a change, once; of `timed_out` again after another silence.
  void notify(DeviceFault fault) noexcept;

  /// @throws DeviceError for a command that is longer than a link can hold
  void check_command(std::span<const std::byte> packet) const;

  const PluggedDevice wanted_;
  const LinkOptions options_;
  LinkListener* listener_ = nullptr;
  std::vector<std::string> warnings_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  DeviceFault notified_ = DeviceFault::none;
  double last_received_ = 0.0;  ///< by monotonic_seconds()
  std::atomic<std::uint64_t> received_{0}, sent_{0}, replaced_{0}, failed_{0}, opened_{0};

 private:
  NewestPacket newest_;
  Packet stop_packet_;  ///< used by the writing thread
  std::atomic<bool> cut_wanted_{false};
  std::atomic<std::uint32_t> cuts_{0};   ///< stop packets written
  double notified_at_ = 0.0;             ///< by monotonic_seconds()
  std::list<std::string> descriptions_;  ///< one per place where it was found, kept because callers hold references
  std::atomic<const std::string*> description_{nullptr};
};

}  // namespace calligraphy::phantom
