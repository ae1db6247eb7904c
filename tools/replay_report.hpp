// What `calligraphy replay` found: as a table for a person, as JSON for a program.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy::tools {

/// One trace of a person.
struct Replayed {
  int position = 0;  ///< in the file, from 1
  std::string set;
  MatchResult match;      ///< on what the person wrote
  CharacterScore guided;  ///< of the device under guidance
  int faults = 0;         ///< ticks whose sample the renderer refused
};

struct ReplayReport {
  std::string device;
  std::string renderer;         ///< "default" or "everything"
  double peak_force = 0.0;      ///< of the device [N]
  double max_force_step = 0.0;  ///< of the renderer [N per tick]
  std::vector<Replayed> traces;
  std::u32string without_template;  ///< characters that were written and are not in the set
};

/// A line per trace, then every remark, then what is true of all.
std::string table(const ReplayReport& report);

std::string json(const ReplayReport& report);

}  // namespace calligraphy::tools
