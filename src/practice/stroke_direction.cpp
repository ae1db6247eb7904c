#include "stroke_direction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calligraphy {
namespace {

constexpr double opposite_way = 55.0 * std::numbers::pi / 180.0;  // within which a stroke runs backwards [rad]
constexpr double short_angle = std::numbers::pi / 3.0;  // besides, of strokes whose direction tells nothing [rad]

}  // namespace

double length_share(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes) {
  double length = reading.costs->length(step.path);
  if (step.paths > 1) length += reading.costs->length(step.path + 1);
  const double whole = strokes.run(step.stroke, step.strokes).way;
  return whole > 0.0 ? length / whole : 1.0;
}

WritingDirection direction_of(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes,
                              const StrokeTolerances& tolerances) {
  if (reading.costs->is_tap(step.path)) return WritingDirection::unknown;
  const double share = length_share(step, reading, strokes);
  const double left_out = (1.0 - share) * strokes.run(step.stroke, step.strokes).way;
  if (share < least_share && left_out > sure_length) return WritingDirection::neither;
  const PairCost& pair = reading.pair(step);
  const double length = strokes.run(step.stroke, step.strokes).length;
  const auto runs_along = [&](double accord, double trusted_length, double angle) {
    return std::acos(std::clamp(accord, -1.0, 1.0)) <= angle + (1.0 - trust_in_direction(trusted_length)) * short_angle;
  };
  if (pair.with >= pair.against) {
    if (runs_along(pair.with, length, tolerances.direction)) return WritingDirection::forwards;
  } else {
    // Something much longer than a dot is no dot written backwards.
    const double longer = std::max(length, reading.costs->length(step.path));
    if (runs_along(pair.against, longer, std::min(tolerances.direction, opposite_way))) {
      return WritingDirection::backwards;
    }
  }
  return step.paths > 1 || step.strokes > 1 ? WritingDirection::forwards : WritingDirection::neither;
}

}  // namespace calligraphy
