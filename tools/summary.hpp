// What a run of `calligraphy write` measured: as a table for a person, as JSON for a program.
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

/// The smallest value that at least `share` of the values do not exceed; 0 of none. Reorders `values`.
double percentile(std::vector<float>& values, double share);

/// A line per character and mode; means over the repetitions. `results` are ordered by position, then mode.
std::string table(const std::vector<Result>& results);

/// A list with an object per result.
std::string json(const std::vector<Result>& results);

/// How much smaller error and time are with force: mean over the pairs of a character and a repetition, with its 95 %
/// interval by Student's t, over the pairs that are complete in both modes. Empty with fewer than two of them.
std::string reductions(const std::vector<Result>& all);

}  // namespace calligraphy::tools
