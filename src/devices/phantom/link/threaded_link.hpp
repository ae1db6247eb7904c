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
  NewestPacket newest_;
  DeviceFault told_ = DeviceFault::none;
  double last_received_ = 0.0;  ///< by monotonic_seconds()
  std::atomic<std::uint64_t> received_{0}, sent_{0}, replaced_{0}, failed_{0}, opened_{0};

 private:
  double told_at_ = 0.0;                 ///< by monotonic_seconds()
  std::list<std::string> descriptions_;  ///< of every place it was found at, kept for those who hold one
  std::atomic<const std::string*> description_{nullptr};
};

}  // namespace calligraphy::phantom
