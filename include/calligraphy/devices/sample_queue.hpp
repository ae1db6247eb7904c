// Wait-free single-producer, single-consumer queue that drops and counts values that do not fit.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

#include <calligraphy/base/error.hpp>

namespace calligraphy {

/// One thread pushes (a servo loop), one pops (a recorder). Neither waits for the other. When the queue is
/// full, the new value is dropped, so queued values stay intact and in order.
template <class Sample>
class SampleQueue {
  static_assert(std::is_copy_assignable_v<Sample> && std::is_trivially_destructible_v<Sample>,
                "values are copied in the servo loop: use a plain struct that owns no resources");

 public:
  /// Holds at least `capacity` values, rounded up to a power of two. All memory is allocated here.
  /// @throws ValueError when capacity is 0 or above 2^24
  explicit SampleQueue(std::size_t capacity) : mask_(slots(capacity) - 1), samples_(new Sample[mask_ + 1]) {}

  /// Returns false, and counts the value as dropped, if the queue is full. Call from the producer only.
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

  /// Takes the oldest value; returns false if the queue is empty. Call from the consumer only.
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

  /// Whether pop() would find nothing. Call from the consumer only.
  bool is_empty() const noexcept {
    return begin_.load(std::memory_order_relaxed) == end_.load(std::memory_order_acquire);
  }

  /// Number of values in a full queue, a power of two.
  std::size_t capacity() const noexcept { return mask_ + 1; }
  /// Number of values dropped so far. Thread-safe.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  static std::size_t slots(std::size_t capacity) {
    if (capacity == 0 || capacity > (std::size_t{1} << 24)) {
      throw ValueError("capacity of a queue = " + std::to_string(capacity) + ", must be from 1 to 16777216");
    }
    std::size_t result = 1;
    while (result < capacity) result *= 2;
    return result;
  }

  // Each thread writes only to its own cache lines, which prevents false sharing.
  static constexpr std::size_t line = 64;

  std::size_t mask_;
  std::unique_ptr<Sample[]> samples_;
  alignas(line) std::atomic<std::uint64_t> end_ = 0;  ///< next to be pushed
  std::uint64_t known_begin_ = 0;                     ///< producer's copy
  std::atomic<std::uint64_t> dropped_ = 0;
  alignas(line) std::atomic<std::uint64_t> begin_ = 0;  ///< next to be popped
  std::uint64_t known_end_ = 0;                         ///< consumer's copy
};

}  // namespace calligraphy
