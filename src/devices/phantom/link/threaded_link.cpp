#include "threaded_link.hpp"

#include <algorithm>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/emergency_stop.hpp>

#include "base/monotonic_clock.hpp"
#include "devices/ending_signals.hpp"
#include "usb_device.hpp"

namespace calligraphy::phantom {

ThreadedLink::ThreadedLink(const PluggedDevice& device, const LinkOptions& options)
    : wanted_(device), options_(options) {
  descriptions_.push_back(describe_device(device));
  description_ = &descriptions_.back();
}

void ThreadedLink::open(LinkListener& listener) {
  if (thread_.joinable()) throw DeviceError(description() + ": this link is open already");
  listener_ = &listener;
  std::promise<void> opened;
  std::future<void> outcome = opened.get_future();
  thread_ = std::thread(&ThreadedLink::run, this, std::move(opened));
  try {
    outcome.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

bool ThreadedLink::send(std::span<const std::byte> packet) noexcept {
  if (packet.size() > max_packet_bytes) return false;
  if (newest_.put(packet)) replaced_.fetch_add(1, std::memory_order_relaxed);
  wake();
  return true;
}

/// If the link's own thread writes the stop packet, it comes after any packet that the thread was writing.
void ThreadedLink::cut_force() noexcept {
  if (listener_ == nullptr || listener_->stop_packet().empty()) return;
  const std::uint32_t before = cuts_.load();
  cut_wanted_.store(true);
  wake();
  constexpr int patience = 20, max_wait = 100;  // [ms]
  for (int i = 0; i < max_wait && cuts_.load() == before; ++i) {
    if (i == patience) write_directly(listener_->stop_packet());
    pause_in_signal_handler();
  }
}

const Packet* ThreadedLink::next_packet() noexcept {
  const bool cut = cut_wanted_.exchange(false);
  const Packet* const packet = newest_.take();
  if (!emergency_stopped()) return packet;
  if (packet == nullptr && !cut) return nullptr;
  stop_packet_.assign(listener_->stop_packet());
  return stop_packet_.size > 0 ? &stop_packet_ : nullptr;
}

void ThreadedLink::packet_written(const Packet& packet) noexcept {
  if (&packet == &stop_packet_) cuts_.fetch_add(1);
}

void ThreadedLink::join() {
  stopping_ = true;
  wake();
  if (thread_.joinable()) thread_.join();
}

void ThreadedLink::found_at(const PluggedDevice& place) {
  const std::string text = describe_device(place);
  auto known = std::find(descriptions_.begin(), descriptions_.end(), text);
  if (known == descriptions_.end()) known = descriptions_.insert(known, text);
  description_ = &*known;
  opened_.fetch_add(1, std::memory_order_relaxed);
}

void ThreadedLink::notify(DeviceFault fault) noexcept {
  const double now = monotonic_seconds();
  const bool again = fault == DeviceFault::timed_out && now - notified_at_ >= options_.silence;
  if (fault == notified_ && !again) return;
  notified_ = fault;
  notified_at_ = now;
  listener_->changed(fault);
}

void ThreadedLink::check_command(std::span<const std::byte> packet) const {
  if (packet.size() > max_packet_bytes) refuse(wanted_, "a command of " + std::to_string(packet.size()) + " bytes");
}

}  // namespace calligraphy::phantom
