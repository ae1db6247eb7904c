// The newest value of one thread for another: the writer overwrites what the reader did not take in time.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace calligraphy::phantom {

/// Three slots: one is written, one is read, one waits between them. Neither side ever waits for the other.
template <class Value>
class LatestValue {
 public:
  /// Writing thread.
  void publish(const Value& value) noexcept {
    slots_[written_] = value;
    written_ = waiting_.exchange(written_ | is_new, std::memory_order_acq_rel) & slot;
  }

  /// False, and `value` untouched, when nothing was published since the last call. Reading thread.
  bool take(Value& value) noexcept {
    if ((waiting_.load(std::memory_order_relaxed) & is_new) == 0) return false;
    read_ = waiting_.exchange(read_, std::memory_order_acq_rel) & slot;
    value = slots_[read_];
    return true;
  }

 private:
  static constexpr std::uint32_t slot = 3, is_new = 4;

  std::array<Value, 3> slots_{};
  std::uint32_t written_ = 0;
  std::uint32_t read_ = 1;
  std::atomic<std::uint32_t> waiting_ = 2;
};

}  // namespace calligraphy::phantom
