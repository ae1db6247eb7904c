// Random numbers that are identical with every compiler, standard library and processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>

namespace calligraphy {

/// A sequence of draws that depends only on its seed. The standard does not specify the algorithms of its distributions
/// and of std::shuffle, so libraries differ; here each algorithm is specified.
///
/// The engine is splitmix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014): the
/// n-th draw is a hash of seed + n * 0x9E3779B97F4A7C15. Not for cryptography.
class Random {
 public:
  /// Starts the sequence of a seed; no seed is better than another.
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Starts an independent sequence for each list of keys: draws for one do not affect those for another.
  Random(std::uint64_t seed, std::initializer_list<int> keys);

  /// 64 random bits.
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// Uniform in [0, 1), in steps of 2^-53.
  double next() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform between `low` and `high`.
  double between(double low, double high);
  /// Uniform over 0 to `count` - 1, without bias; 0 if `count` is 0.
  std::uint64_t index(std::uint64_t count);
  /// Normal with mean 0 and standard deviation 1: the ratio of two uniform draws (Kinderman and Monahan, Computer
  /// generation of random variables using the ratio of uniform deviates, ACM TOMS 3, 1977). The logarithm decides only
  /// which ratios are accepted, so rounding differences between libms do not reach the value.
  double normal();

 private:
  std::uint64_t state_;
};

/// Shuffles the values of an array, vector or span; all orders are equally likely (Fisher and Yates).
template <typename Values>
void shuffle(Values&& values, Random& random) {
  for (std::size_t left = values.size(); left > 1; --left) {
    using std::swap;
    swap(values[left - 1], values[static_cast<std::size_t>(random.index(left))]);
  }
}

}  // namespace calligraphy
