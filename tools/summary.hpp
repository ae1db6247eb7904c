// Report of `calligraphy write`, as a table and as JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/pictures/error_plot.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

namespace calligraphy::tools {

/// One character, written once.
struct Result {
  int position = 0;  ///< in the text, from 1
  FeedbackMode mode = FeedbackMode::force;
  int repetition = 1;  ///< from 1
  std::optional<std::uint64_t> seed = {};  ///< of a simulated writer, if it is known
  CharacterScore score;
  double tick_p50 = 0.0;   ///< NaN: not measured [ns]
  double tick_p999 = 0.0;  ///< likewise [ns]
};

/// What a run has written.
struct Summary {
  std::vector<Result> results;        ///< ordered by position, then mode, then repetition
  int repetitions = 1;                ///< asked for
  bool interrupted = false;           ///< there are fewer
  std::vector<std::string> warnings;  ///< of the device that a person held
};

/// The smallest value that at least a fraction `share` of the values do not exceed; 0 if empty. Reorders `values`.
double percentile(std::vector<float>& values, double share);

/// One line per character and mode, with means over as many repetitions as there are, which the first line says.
std::string table(const Summary& summary, const Language& language);

/// An object: how many repetitions were asked for, whether the run was interrupted, the warnings, and a list with one
/// object per result; where characters were written in both modes, also their errors in pairs.
nlohmann::ordered_json json(const Summary& summary);

/// Fewer independent pairs of runs vary too much to show an effect of force.
inline constexpr std::size_t least_runs = 10;

/// RMS errors without and with force over the pairs of character and repetition that are complete in both modes.
///
/// Clustered by run, that is by page and seed: its characters draw their own beliefs, but one renderer renders them,
/// whose assistance and thermal budget carry over, and a run that stops early loses all that follow.
ErrorsByCharacter errors_by_character(const std::vector<Result>& results);

/// Reduction of error and time with force: mean and 95 % interval over the same pairs; with fewer than `least_runs`
/// pairs of runs, that they are too few. Empty without a pair.
std::string reductions(const std::vector<Result>& results, const Language& language);

/// All remarks, a line each; of more than 20, how many there are. Empty without any.
std::string remarks(const Summary& summary, const Language& language);

}  // namespace calligraphy::tools
