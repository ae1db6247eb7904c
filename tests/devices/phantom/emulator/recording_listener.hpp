// Records the events of a link, for a test to wait for.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "devices/phantom/link/link.hpp"
#include "usb_identity.hpp"

namespace calligraphy_test {

class RecordingListener final : public calligraphy::phantom::LinkListener {
 public:
  using Fault = calligraphy::DeviceFault;

  std::span<const std::byte> stop_packet() const noexcept override { return std::as_bytes(std::span(to_stop)); }

  void received(std::span<const std::byte> bytes) noexcept override {
    if (on_packet) on_packet();
    const std::lock_guard<std::mutex> alone(mutex_);
    packets_.emplace_back();
    for (const std::byte byte : bytes) packets_.back().push_back(std::to_integer<std::uint8_t>(byte));
    happened_.notify_all();
  }

  void changed(Fault fault) noexcept override {
    if (on_change) on_change(fault);
    const std::lock_guard<std::mutex> alone(mutex_);
    changes_.push_back(fault);
    happened_.notify_all();
  }

  /// Waits at most a minute; false if they did not arrive.
  bool wait_for_packets(std::size_t count) const {
    return wait([&] { return packets_.size() >= count; });
  }
  bool wait_for_changes(std::size_t count) const {
    return wait([&] { return changes_.size() >= count; });
  }
  bool wait_for(Fault fault) const {
    return wait([&] { return std::find(changes_.begin(), changes_.end(), fault) != changes_.end(); });
  }
  /// Among the changes from that one on.
  bool wait_for_none_after(std::size_t first) const {
    return wait(
        [&] { return std::count(changes_.begin() + static_cast<long>(first), changes_.end(), Fault::none) > 0; });
  }

  std::vector<Octets> packets() const {
    const std::lock_guard<std::mutex> alone(mutex_);
    return packets_;
  }
  std::vector<Fault> changes() const {
    const std::lock_guard<std::mutex> alone(mutex_);
    return changes_;
  }

  std::function<void(Fault)> on_change;  ///< set before the link is opened, as are the following
  std::function<void()> on_packet;
  Octets to_stop;  ///< the stop packet

 private:
  bool wait(const std::function<bool()>& reached) const {
    std::unique_lock<std::mutex> lock(mutex_);
    return happened_.wait_for(lock, std::chrono::seconds(60), reached);
  }

  mutable std::mutex mutex_;
  mutable std::condition_variable happened_;
  std::vector<Octets> packets_;
  std::vector<Fault> changes_;
};

}  // namespace calligraphy_test
