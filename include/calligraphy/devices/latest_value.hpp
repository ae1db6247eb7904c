// Passes the newest value from one thread to another, wait-free. Values not read in time are overwritten.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace calligraphy {

/// One thread publishes (a servo loop), one takes (a display). Neither ever waits for the other, and a value is never
/// torn. The newest wins: a reader that needs every value uses a SampleQueue. Neither call allocates.
template <class Value>
class LatestValue {
  static_assert(std::is_copy_assignable_v<Value> && std::is_trivially_destructible_v<Value>,
                "values are copied within the servo loop: use plain structs that own no resources");

 public:
  /// Replaces the value. Writing thread only.
  void publish(const Value& value) noexcept {
    slots_[written_] = value;
    written_ = waiting_.exchange(written_ | is_new, std::memory_order_acq_rel) & slot;
  }

  /// Takes the newest value. Returns false, leaving `value` untouched, if nothing was published since the last call.
  /// Reading thread only.
  bool take(Value& value) noexcept {
    if ((waiting_.load(std::memory_order_relaxed) & is_new) == 0) return false;
    read_ = waiting_.exchange(read_, std::memory_order_acq_rel) & slot;
    value = slots_[read_];
    return true;
  }

 private:
  static constexpr std::uint32_t slot = 3, is_new = 4;

  // Three slots: one being written, one being read, and one waiting in between.
  std::array<Value, 3> slots_{};
  std::uint32_t written_ = 0;                ///< slot of the writing thread
  std::uint32_t read_ = 1;                   ///< slot of the reading thread
  std::atomic<std::uint32_t> waiting_ = 2u;  ///< contains is_new once a value was published
};

}  // namespace calligraphy
