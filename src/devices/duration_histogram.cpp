#include <calligraphy/devices/detail/duration_histogram.hpp>

#include <bit>
#include <cmath>

namespace calligraphy::detail {
namespace {

constexpr int leading_bits = 7;
constexpr std::uint64_t per_octave = 1u << leading_bits;

/// Relaxed ordering suffices: only one thread writes, and the count publishes no other data.
void count_one(std::atomic<std::uint64_t>& count) noexcept {
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

/// One bucket per nanosecond for small durations, then by the seven bits below the leading one.
std::size_t bucket_of(std::uint64_t nanoseconds, std::size_t last) noexcept {
  if (nanoseconds < per_octave) return static_cast<std::size_t>(nanoseconds);
  const int octave = static_cast<int>(std::bit_width(nanoseconds)) - leading_bits - 1;
  const std::uint64_t within = (nanoseconds >> octave) - per_octave;
  const std::uint64_t bucket = (static_cast<std::uint64_t>(octave) + 1) * per_octave + within;
  return bucket < last ? static_cast<std::size_t>(bucket) : last;
}

/// Centre of a bucket [ns].
double middle_of(std::size_t bucket) noexcept {
  if (bucket < per_octave) return static_cast<double>(bucket);
  const int octave = static_cast<int>(bucket / per_octave) - 1;
  const double first = static_cast<double>(per_octave + bucket % per_octave);
  return std::ldexp(first + 0.5, octave) - 0.5;  // in whole nanoseconds, so the last one is 1 below the next bucket
}

}  // namespace

void DurationHistogram::add(double seconds) noexcept {
  constexpr double longest = 9e18;  // fits into 63 bits [ns]
  const double nanoseconds = std::round(seconds * 1e9);
  std::uint64_t whole = 0;  // NaN too
  if (nanoseconds >= longest) {
    whole = static_cast<std::uint64_t>(longest);
  } else if (nanoseconds > 0.0) {
    whole = static_cast<std::uint64_t>(nanoseconds);
  }
  count_one(buckets_[bucket_of(whole, buckets_.size() - 1)]);
  if (whole > worst_.load(std::memory_order_relaxed)) worst_.store(whole, std::memory_order_relaxed);
}

DurationSummary DurationHistogram::summary() const noexcept {
  std::array<std::uint64_t, octaves * DurationHistogram::per_octave> counts;
  DurationSummary result;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = buckets_[i].load(std::memory_order_relaxed);
    result.count += counts[i];
  }
  if (result.count == 0) return result;
  result.worst = 1e-9 * static_cast<double>(worst_.load(std::memory_order_relaxed));

  // Minimum duration that at least this fraction does not exceed.
  const auto percentile = [&](double share) {
    const double needed = std::ceil(share * static_cast<double>(result.count));
    double sum = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      sum += static_cast<double>(counts[i]);
      if (sum >= needed) return std::fmin(1e-9 * middle_of(i), result.worst);
    }
    return result.worst;
  };
  result.p50 = percentile(0.5);
  result.p99 = percentile(0.99);
  result.p99_9 = percentile(0.999);
  return result;
}

}  // namespace calligraphy::detail
