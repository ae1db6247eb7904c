// Report of `calligraphy write`, as a table and as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

namespace calligraphy::tools {

/// One character, written once.
struct Result {
  int position = 0;  ///< in the text, from 1
  FeedbackMode mode = FeedbackMode::force;
  int repetition = 1;  ///< from 1
  std::uint64_t seed = 0;
  CharacterScore score;
  double tick_p50 = 0.0;   ///< [ns]
  double tick_p999 = 0.0;  ///< [ns]
};

/// The smallest value that at least a fraction `share` of the values do not exceed; 0 if empty. Reorders `values`.
double percentile(std::vector<float>& values, double share);

/// One line per character and mode, with means over repetitions. `results` must be ordered by position, then mode.
std::string table(const std::vector<Result>& results);

/// A list with one object per result.
std::string json(const std::vector<Result>& results);

/// Reduction of error and time with force: mean and 95 % interval (Student's t) over the pairs of character and
/// repetition that are complete in both modes. Empty if there are fewer than two such pairs.
std::string reductions(const std::vector<Result>& all);

}  // namespace calligraphy::tools
