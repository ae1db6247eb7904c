// Counts of a fuzz run, by family, and the failures found.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../nearest_point_oracle.hpp"

namespace calligraphy_test {

/// Histogram of call times in eighths of an octave: its median is insensitive to other running programs.
class Times {
 public:
  void add(double nanoseconds, std::uint64_t calls);
  void add(const Times& other);
  /// Median of one call [ns]; 0 when none was timed.
  double median() const;

 private:
  static constexpr int steps_per_octave = 8;
  std::array<std::uint64_t, 20 * steps_per_octave> counts_ = {};
};

/// Counts of results, and the maximum errors.
struct Count {
  std::uint64_t answers = 0;
  std::uint64_t wrong_branches = 0;
  std::uint64_t above_allowance = 0;  ///< no wrong branch, but an error above the tolerance
  std::uint64_t inconsistent = 0;     ///< parameter, point, distance, tangent or status contradict each other
  std::uint64_t uncertified = 0;
  std::uint64_t not_finite = 0;  ///< output that is not finite for finite input
  std::uint64_t different = 0;   ///< a different result in a batch or in a repeated query
  double worst_error = 0.0;      ///< maximum over those whose tolerance is 1e-9 of the size [size of the curve]
  double proven_error = 0.0;     ///< of the same results, a proven upper bound [size of the curve]
  double worst_share = 0.0;      ///< over all results, proven [tolerance]
  Times times;                   ///< of the code under test

  std::uint64_t failures() const {
    return wrong_branches + above_allowance + inconsistent + uncertified + not_finite + different;
  }
  void add(const Count& other);
};

struct Failure {
  std::uint64_t block = 0, index = 0;  ///< order of the failures, whatever the threads
  std::size_t family = 0;
  std::string text;  ///< one line that suffices to reproduce it
};

/// The tally of one thread.
class Tally {
 public:
  static constexpr std::size_t shown_failures = 10;
  static constexpr int shown_failures_per_family = 2;

  explicit Tally(std::size_t families) : counts_(families), kept_(families) {}

  /// The blocks of a thread must ascend, so that the first failures are retained.
  void begin_block(std::uint64_t block) { block_ = block; }
  Count& operator[](std::size_t family) { return counts_[family]; }
  const Count& operator[](std::size_t family) const { return counts_[family]; }

  /// Counts a verified result; true when it is a failure.
  bool judge(std::size_t family, const Verdict& verdict, bool finite, bool certified);
  template <typename Text>
  void fail(std::size_t family, Text text) {
    if (kept_[family] == shown_failures_per_family) return;
    ++kept_[family];
    failures_.push_back({block_, failures_.size(), family, text()});
  }

  void add(const Tally& other);
  Count total() const;
  /// The first ones in order, a few per family.
  std::vector<Failure> failures() const;

 private:
  std::vector<Count> counts_;
  std::vector<Failure> failures_;
  std::vector<int> kept_;  ///< failures of each family
  std::uint64_t block_ = 0;
};

/// "(0x1p+0,-0x1.8p-1) ..." [hexadecimal floating point, read back exactly by strtod]
std::string exact_text(std::span<const Point> points);
std::string exact_text(double value);

}  // namespace calligraphy_test
