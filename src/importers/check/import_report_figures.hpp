// Counts, shares and means of the report of an import, for its tables and its JSON; private to importers and program.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy {

/// Part of the whole [1]; 1 if the whole is 0.
double share_of(int part, int whole);

bool runs_back(const StrokeMeasures& stroke);
/// True from 0.9 (L - 2 h) to 1.1 L, where L is the length of the source and h the half-width of the brush.
bool keeps_length(const StrokeMeasures& stroke);
bool has_false_corner(const StrokeMeasures& stroke);
bool has_lost_corner(const StrokeMeasures& stroke);
/// True if a corner is lost farther from the ends than a brush turns as it is set down or lifted.
bool has_lost_inner_corner(const StrokeMeasures& stroke);

/// How many of the measured strokes meet the condition.
int count_of(const ImportReport& report, bool (*condition)(const StrokeMeasures&));
int count_of(const ImportReport& report, LabelResolution resolution);

/// `bytes`: size of the file that was written [byte].
double bytes_per_character(const ImportReport& report, std::size_t bytes);

/// Paths of skipped files, by reason.
std::map<std::string, std::vector<std::string>> skipped_by_reason(const ImportReport& report, bool unusable);

/// What ink of one detail costs in a set file at standard precision, and how well it covers the outlines.
struct InkFigures {
  const char* name;  ///< in a table
  const char* key;   ///< in JSON
  const InkMeasures* measures;
  double bytes_per_character;
  double mean;            ///< intersection over union, of the strokes [1]
  double low;             ///< the same, of the stroke that 5 % are worse than [1]
  double character_mean;  ///< the same, of whole characters [1]
};

/// Typical ink, half-widths alone and, if the list has them, half-widths with offsets. Empty if nothing was imported
/// with ink and a report.
std::vector<InkFigures> ink_figures(const ImportResult& import);

}  // namespace calligraphy
