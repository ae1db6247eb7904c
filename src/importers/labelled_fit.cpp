#include "labelled_fit.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "importers/fit/outline.hpp"

namespace calligraphy {
namespace {

/// True if the stroke runs across or against the typical one: then the label belongs to another stroke.
bool is_misdirected(const StrokeInput& stroke) {
  constexpr double most = 80.0 * std::numbers::pi / 180.0;
  const std::string_view elements = stroke.composition().elements();
  return start_direction_error({&typical_stroke(stroke.id), elements, 3, stroke.control_points, {}}) > most;
}

/// Fits a stroke. Its label decides unless the recognised kind follows the drawing much more closely or, if the label
/// is doubtful because it may belong to another stroke, just as closely.
StrokeInput fit(const DrawnStroke& drawn, bool doubtful, ImportedStroke& result) {
  constexpr double of_pen = 0.018;     // [em]; a label is not questioned within this distance of the drawing
  constexpr double much_closer = 0.7;  // [1]
  FittedStroke fitted = fit_stroke(drawn.path, {drawn.outline, drawn.label_ids});
  result.recognised = fitted.recognised;
  result.label = drawn.label;
  result.label_known = !drawn.label_ids.empty();
  result.label_agrees = drawn.allows(result.recognised);
  if (result.label_known && !result.label_agrees) {
    doubtful = doubtful || is_misdirected(fitted.stroke);
    if (doubtful || fitted.unbent_error > (drawn.outline.empty() ? of_pen : recognition::reach_of_brush)) {
      FittedStroke shape = fit_stroke(drawn.path, {drawn.outline, {&result.recognised, 1}});
      const double limit = doubtful ? std::max(of_pen, fitted.unbent_error) : much_closer * fitted.unbent_error;
      if (shape.unbent_error < limit) fitted = std::move(shape);
    }
  }
  result.error = fitted.error;
  result.half_width = fitted.half_width;
  return std::move(fitted.stroke);
}

}  // namespace

LabelledFit fit_labelled(const std::vector<DrawnStroke>& drawn, const DrawingFile& file) {
  LabelledFit result{std::vector<StrokeInput>(drawn.size()), std::vector<ImportedStroke>(drawn.size())};
  const auto fit_one = [&](std::size_t i, bool doubtful) {
    try {
      result.inputs[i] = fit(drawn[i], doubtful, result.strokes[i]);
    } catch (const ValueError& error) {
      throw FormatError(file.place + ": stroke " + std::to_string(i + 1) + ": " + error.what());
    }
  };
  for (std::size_t i = 0; i < drawn.size(); ++i) fit_one(i, false);

  // Letters are those of another stroke order if geometry alone recognises something else for many of them: then these
  // are doubtful.
  constexpr std::ptrdiff_t many = 5;  // in the right order there are up to four
  const auto is_contradicted = [](const ImportedStroke& stroke) { return stroke.label_known && !stroke.label_agrees; };
  const bool has_letters = file.character.kind == SourceKind::hanzi_writer_data;
  if (!has_letters || std::count_if(result.strokes.begin(), result.strokes.end(), is_contradicted) < many) {
    return result;
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (is_contradicted(result.strokes[i])) fit_one(i, true);
  }
  return result;
}

}  // namespace calligraphy
