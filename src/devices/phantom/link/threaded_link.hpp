// What links over any bus share: the thread that serves the device, what was told of it, and its counts.
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
#include "link_options.hpp"
#include "newest_packet.hpp"

namespace calligraphy::phantom {

/// A link joins its thread in its own destructor, while all that the thread uses is still there.
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
  /// The thread, until `stopping_`. Says by `opened` whether the device could be opened the first time, and ends when
  /// it could not; the listener has heard of it by then.
  virtual void run(std::promise<void> opened) noexcept = 0;

  /// A packet waits. From any thread; neither blocks nor allocates.
  virtual void wake() noexcept = 0;

  /// Writes the packet by the lowest call of the system, if the bus permits it: for a link whose thread does not
  /// answer, because it is the one that crashed. Async-signal-safe.
  virtual void write_directly(std::span<const std::byte> packet) noexcept = 0;

  /// The packet to be written next: the newest, or the stop packet in an emergency stop; null if there is none. For the
  /// thread that writes.
  const Packet* next_packet() noexcept;
  bool packet_waits() const noexcept { return newest_.waiting() || cut_wanted_.load(std::memory_order_relaxed); }
  /// That thread has written what next_packet() returned.
  void packet_written(const Packet& packet) noexcept;

  void join();

  /// The device was opened, here.
  void found_at(const PluggedDevice& place);

  /// What has changed, once; `timed_out` again after another silence.
  void tell(DeviceFault fault) noexcept;

  /// @throws DeviceError for a command that is longer than a link can hold
  void check_command(std::span<const std::byte> packet) const;

  const PluggedDevice wanted_;
  const LinkOptions options_;
  LinkListener* listener_ = nullptr;
  std::vector<std::string> warnings_;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
  DeviceFault told_ = DeviceFault::none;
  double last_received_ = 0.0;  ///< by monotonic_seconds()
  std::atomic<std::uint64_t> received_{0}, sent_{0}, replaced_{0}, failed_{0}, opened_{0};

 private:
  NewestPacket newest_;
  Packet stop_packet_;  ///< used by the thread that writes
  std::atomic<bool> cut_wanted_{false};
  std::atomic<std::uint32_t> cuts_{0};   ///< stop packets written
  double told_at_ = 0.0;                 ///< by monotonic_seconds()
  std::list<std::string> descriptions_;  ///< of every place it was found at, kept for those who hold one
  std::atomic<const std::string*> description_{nullptr};
};

}  // namespace calligraphy::phantom
