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
  double uncovered;       ///< share of strokes whose outline lies farther than `ink_off` from the ink [1]
  double beyond;          ///< share of strokes whose ink lies farther than `ink_off` beyond the outline [1]
};

inline constexpr double ink_off = 0.02;      ///< [em]; what ink misses or adds beyond this shows
inline constexpr double notch_angle = 35.0;  ///< [degree]; an edge that turns into the ink by more has a notch

/// Of the strokes of one kind that end in a hook.
struct NotchFigures {
  int id;
  int strokes;
  double ink;     ///< share with a notch in the ink near the tip [1]
  double source;  ///< the same of the outlines [1]
};

/// Typical ink, half-widths alone and, if the list has them, half-widths with offsets. Empty if nothing was imported
/// with ink and a report.
std::vector<InkFigures> ink_figures(const ImportResult& import);

/// By id; of the ink as imported.
std::vector<NotchFigures> notch_figures(const ImportReport& report);

}  // namespace calligraphy
