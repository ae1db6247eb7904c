// A wait-free queue from one thread to another that drops what does not fit and counts it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

#include <calligraphy/base/error.hpp>

namespace calligraphy {

/// One thread pushes (a servo loop), one pops (a display, a recorder). Neither ever waits for the other; when the queue
/// is full the new value is dropped, so that what has been queued stays in order and whole.
template <class Sample>
class SampleQueue {
  static_assert(std::is_copy_assignable_v<Sample> && std::is_trivially_destructible_v<Sample>,
                "values are copied within the servo loop: plain structs, which own nothing");

 public:
  /// Holds at least `capacity` values: the next power of two. Takes all its memory here.
  /// @throws ValueError when capacity is 0 or above 2^24
  explicit SampleQueue(std::size_t capacity) : mask_(slots(capacity) - 1), samples_(new Sample[mask_ + 1]) {}

  /// False, and counted, when there is no room. Pushing thread.
  bool push(const Sample& sample) noexcept {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (end - known_begin_ > mask_) {
      known_begin_ = begin_.load(std::memory_order_acquire);
      if (end - known_begin_ > mask_) {
        dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        return false;
      }
    }
    samples_[end & mask_] = sample;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  /// The oldest value; false when there is none. Popping thread.
  bool pop(Sample& sample) noexcept {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == known_end_) {
      known_end_ = end_.load(std::memory_order_acquire);
      if (begin == known_end_) return false;
    }
    sample = samples_[begin & mask_];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  std::size_t capacity() const noexcept { return mask_ + 1; }
  /// Values that found no room so far. Any thread.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  static std::size_t slots(std::size_t capacity) {
    if (capacity == 0 || capacity > (std::size_t{1} << 24)) {
      throw ValueError("capacity of a queue is " + std::to_string(capacity) + ", must be from 1 to 16777216");
    }
    std::size_t result = 1;
    while (result < capacity) result *= 2;
    return result;
  }

  // What either thread writes lies on cache lines of its own.
  static constexpr std::size_t line = 64;

  std::size_t mask_;
  std::unique_ptr<Sample[]> samples_;
  alignas(line) std::atomic<std::uint64_t> end_ = 0;  ///< next to be pushed
  std::uint64_t known_begin_ = 0;                     ///< of the pushing thread
  std::atomic<std::uint64_t> dropped_ = 0;
  alignas(line) std::atomic<std::uint64_t> begin_ = 0;  ///< next to be popped
  std::uint64_t known_end_ = 0;                         ///< of the popping thread
};

}  // namespace calligraphy
