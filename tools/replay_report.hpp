// Report of `calligraphy replay`, as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/language.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/practice/score.hpp>

namespace calligraphy::tools {

/// Result of one trace.
struct Replayed {
  int position = 0;  ///< in the file, from 1
  std::string set;
  MatchResult match;         ///< of what the person wrote
  std::string order;         ///< of the form as which it was read; empty for the standard one
  std::string source;        ///< of that form
  std::size_t accepted = 0;  ///< forms that were accepted
  WritingMotion motion;      ///< of the person's pen [em]
  CharacterScore guided;     ///< of the simulated pen under guidance
  int faults = 0;            ///< ticks whose sample the renderer rejected
};

/// What a trace resembles.
struct Recognised {
  int position = 0;        ///< in the file, from 1
  char32_t character = 0;  ///< that the person was to write
  std::vector<RecognisedCharacter> as;
};

struct ReplayReport {
  Capabilities device;
  std::string renderer;         ///< "default" or "everything"
  double max_force_step = 0.0;  ///< of the renderer [N per tick]
  std::vector<Replayed> traces;
  std::vector<Recognised> recognised;  ///< if asked for, of every trace
  bool interrupted = false;            ///< there are fewer than were asked for
  std::u32string without_template;     ///< written characters that are not in the set
  std::vector<std::string> warnings;   ///< of the file as a whole
};

/// One line per trace, the limits, all remarks in a language, then the totals.
std::string table(const ReplayReport& report, const Language& language);

nlohmann::ordered_json json(const ReplayReport& report);

}  // namespace calligraphy::tools
