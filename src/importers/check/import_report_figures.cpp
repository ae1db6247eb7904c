#include "import_report_figures.hpp"

#include <algorithm>
#include <numeric>

#include <calligraphy/model/set_encoding.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "model/stroke_ends.hpp"

namespace calligraphy {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The value below which a share of the values lies.
double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double share_above(const std::vector<double>& values, double threshold) {
  const auto count = std::count_if(values.begin(), values.end(), [&](double value) { return value > threshold; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

InkFigures figures_of(const char* name, const char* key, const InkMeasures& ink, double bytes) {
  constexpr double low = 0.05;
  return {name,
          key,
          &ink,
          bytes,
          mean_of(ink.strokes),
          quantile(ink.strokes, low),
          mean_of(ink.characters),
          share_above(ink.uncovered, ink_off),
          share_above(ink.beyond, ink_off)};
}

}  // namespace

double share_of(int part, int whole) { return whole == 0 ? 1.0 : static_cast<double>(part) / whole; }

bool runs_back(const StrokeMeasures& stroke) { return stroke.backward > most_backward; }

bool keeps_length(const StrokeMeasures& stroke) {
  return stroke.length >= 0.9 * (stroke.source_length - 2.0 * stroke.half_width) &&
         stroke.length <= 1.1 * stroke.source_length;
}

bool has_false_corner(const StrokeMeasures& stroke) { return stroke.false_corners > 0; }
bool has_lost_corner(const StrokeMeasures& stroke) { return stroke.lost_corners > 0; }
bool has_lost_inner_corner(const StrokeMeasures& stroke) { return stroke.lost_inside > brush_end; }

int count_of(const ImportReport& report, bool (*condition)(const StrokeMeasures&)) {
  return static_cast<int>(std::count_if(report.measures.begin(), report.measures.end(), condition));
}

int count_of(const ImportReport& report, LabelResolution resolution) {
  return static_cast<int>(
      std::count_if(report.label_conflicts.begin(), report.label_conflicts.end(),
                    [resolution](const LabelConflict& conflict) { return conflict.resolution == resolution; }));
}

double bytes_per_character(const ImportReport& report, std::size_t bytes) {
  return report.characters == 0 ? 0.0 : static_cast<double>(bytes) / report.characters;
}

std::map<std::string, std::vector<std::string>> skipped_by_reason(const ImportReport& report, bool unusable) {
  std::map<std::string, std::vector<std::string>> reasons;
  for (const SkippedFile& file : report.skipped) {
    if (file.unusable == unusable) reasons[file.reason].push_back(file.path);
  }
  return reasons;
}

std::vector<InkFigures> ink_figures(const ImportResult& import) {
  const ImportReport& report = import.report;
  if (report.ink.strokes.empty()) return {};
  const auto size = [](const CharacterList& list) { return static_cast<double>(encode_character_set(list).size()); };
  CharacterList list = import.list;
  const double full = size(list);
  for (Character& character : list.characters) {
    for (StrokeInk& ink : character.physics.ink) {
      ink.offsets = {};
      ink.shifts = {};
    }
  }
  const double plain = size(list);
  for (Character& character : list.characters) character.physics.ink.clear();
  const double none = size(list);
  const auto count = static_cast<double>(list.characters.size());
  std::vector<InkFigures> figures{
      figures_of("typical of the kind, scaled", "typical", report.typical_ink, 0.0),
      figures_of("half-widths", "half_widths", report.plain_ink, (plain - none) / count)};
  if (full != plain) {
    figures.push_back(figures_of("half-widths, offsets, shifts", "full", report.ink, (full - none) / count));
  }
  return figures;
}

std::vector<NotchFigures> notch_figures(const ImportReport& report) {
  std::vector<NotchFigures> figures;
  for (int id = 1; id <= typical_stroke_count && !report.ink.strokes.empty(); ++id) {
    int strokes = 0, of_ink = 0, of_source = 0;
    for (std::size_t i = 0; i < report.measures.size(); ++i) {
      if (report.measures[i].id != id || !ends_in_hook(typical_stroke(id))) continue;
      ++strokes;
      of_ink += report.ink.notches[i] > notch_angle ? 1 : 0;
      of_source += report.ink.source_notches[i] > notch_angle ? 1 : 0;
    }
    if (strokes > 0) figures.push_back({id, strokes, share_of(of_ink, strokes), share_of(of_source, strokes)});
  }
  return figures;
}

}  // namespace calligraphy
