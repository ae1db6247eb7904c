#include "import_measures.hpp"

#include <cstddef>
#include <span>

#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/set_encoding.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "importers/fit/ink_fit.hpp"
#include "shape_contradiction.hpp"

namespace calligraphy {
namespace {

/// The ink of the strokes as a set file at standard precision holds it.
std::vector<std::vector<InkDisc>> stored_ink(char32_t code, const std::vector<StrokeInput>& strokes) {
  constexpr double spacing = 0.003;  // [em]
  const CharacterSet set =
      CharacterSet::from_bytes(encode_character_set({{}, {make_character(code, strokes)}}), "measured");
  const Character stored = set.find(code)->character();
  std::vector<std::vector<InkDisc>> inks;
  for (const Stroke& stroke : calligraphy::strokes(stored)) {
    inks.push_back(ink_discs(stroke, spacing));
  }
  return inks;
}

/// Measures the ink as stored and, for comparison, ink without offsets and the typical ink of each kind.
void measure_ink(const std::vector<SourceStroke>& drawn, const std::vector<recognition::Outline>& outlines,
                 std::vector<StrokeInput> strokes, ImportedCharacter& result) {
  const char32_t code = result.character.code;
  std::vector<Point> ends;
  for (const SourceStroke& each : drawn) ends.push_back(each.path.back());
  result.ink = recognition::measure_ink(outlines, ends, stored_ink(code, strokes));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Stroke stroke = recognition::view_of(strokes[i]);
    strokes[i].ink = recognition::fit_ink(stroke, drawn[i].path, outlines[i], InkDetail::half_widths);
  }
  result.plain_ink = recognition::measure_ink(outlines, ends, stored_ink(code, strokes));
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    strokes[i].ink = typical_ink(strokes[i].id, result.strokes[i].half_width);
  }
  result.typical_ink = recognition::measure_ink(outlines, ends, stored_ink(code, strokes));
}

/// True if the drawing clearly contradicts the label of a stroke imported as `id`.
bool contradicts_label(const SourceStroke& drawn, const ImportedStroke& stroke, int id) {
  if (stroke.label_agrees || drawn.label_ids.empty()) return false;
  // A shape that overrides the label does, unless the label is a dot's, which may fall in any direction.
  if (id == stroke.recognised && !drawn.allows(8)) return true;
  return recognition::contradicts(drawn.path, !drawn.outline.empty(), drawn.label_ids, stroke.recognised);
}

}  // namespace

void measure_import(const std::vector<SourceStroke>& drawn, const std::vector<recognition::Outline>& outlines,
                    const std::vector<StrokeInput>& strokes,
                    const std::vector<recognition::CrossingStrokes>& crossings, ImportedCharacter& result) {
  std::vector<recognition::Path> paths;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    paths.push_back(recognition::flattened(strokes[i]));
    StrokeMeasures& measures = result.measures.emplace_back(
        recognition::measure_stroke(paths.back(), drawn[i].path, result.strokes[i].half_width));
    ImportedStroke& stroke = result.strokes[i];
    measures.place = {result.character.code, result.character.order, static_cast<int>(i) + 1};
    measures.id = strokes[i].id;
    measures.frechet = stroke.error;
    measures.outline_size = outlines[i].empty() ? 0.0 : recognition::box_of(outlines[i]).diagonal().norm();
    stroke.contradicts_label = contradicts_label(drawn[i], stroke, strokes[i].id);
  }
  if (strokes.front().ink) measure_ink(drawn, outlines, strokes, result);
  result.crossings.source = static_cast<int>(crossings.size());
  for (const auto& [one, other, at] : crossings) {
    if (recognition::crossing_of(paths[one], paths[other])) {
      ++result.crossings.kept;
    } else {
      result.lost_crossings.push_back({result.measures[one].place, static_cast<int>(other) + 1});
    }
  }
}

}  // namespace calligraphy
