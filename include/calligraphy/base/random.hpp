// Random draws that are the same with every compiler, standard library and processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>

namespace calligraphy {

/// A sequence of draws that depends on its seed alone. The standard leaves the algorithms of its distributions and of
/// std::shuffle open, and libraries differ; here each is defined.
///
/// The engine is splitmix64 (Steele, Lea and Flood, Fast splittable pseudorandom number generators, OOPSLA 2014): the
/// n-th draw is a hash of seed + n * 0x9E3779B97F4A7C15. Not for cryptography.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// A sequence of its own for each list of keys: draws for one key do not depend on how many another key took.
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
  /// Uniform from `low` to `high`.
  double between(double low, double high);
  /// Uniform among 0 to `count` - 1, without bias; 0 when `count` is 0.
  std::uint64_t index(std::uint64_t count);
  /// Normal with mean 0 and standard deviation 1: the ratio of two uniform draws (Kinderman and Monahan, Computer
  /// generation of random variables using the ratio of uniform deviates, ACM TOMS 3, 1977). The logarithm decides only
  /// which ratios are taken, so that the last bit of a libm does not reach the value.
  double normal();

 private:
  std::uint64_t state_;
};

/// Puts the values of an array, vector or span in a random order, each order as likely (Fisher and Yates).
template <typename Values>
void shuffle(Values&& values, Random& random) {
  for (std::size_t left = values.size(); left > 1; --left) {
    using std::swap;
    swap(values[left - 1], values[static_cast<std::size_t>(random.index(left))]);
  }
}

}  // namespace calligraphy
