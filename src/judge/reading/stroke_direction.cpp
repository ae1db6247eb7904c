#include "stroke_direction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calligraphy {
namespace {

constexpr double same_way = std::numbers::pi / 3.0;               // within which a stroke runs forwards [rad]
constexpr double almost = 0.999;                                  // evidence that is not enough
constexpr double opposite_way = 55.0 * std::numbers::pi / 180.0;  // within which a stroke runs backwards [rad]
constexpr double short_angle = std::numbers::pi / 3.0;  // besides, of strokes whose direction tells nothing [rad]

}  // namespace

double length_share(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes) {
  double length = reading.costs->length(step.path);
  if (step.paths > 1) length += reading.costs->length(step.path + 1);
  const double whole = strokes.run(step.stroke, step.strokes).way;
  return whole > 0.0 ? length / whole : 1.0;
}

StrokeDirection direction_of(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes) {
  if (reading.costs->is_tap(step.path)) return {};
  const StrokeRun& run = strokes.run(step.stroke, step.strokes);
  const double share = length_share(step, reading, strokes);
  const double left_out = (1.0 - share) * run.way;
  if (share < least_share && left_out > sure_length) {
    return {WritingDirection::neither, std::min(least_share / share, left_out / sure_length)};
  }
  const PairCost& pair = reading.pair(step);
  // The angle over the one within which it runs so, beyond what is allowed to short strokes.
  const auto off = [](double accord, double trusted_length, double within) {
    const double allowed = (1.0 - trust_in_direction(trusted_length)) * short_angle;
    return std::max(0.0, std::acos(std::clamp(accord, -1.0, 1.0)) - allowed) / within;
  };
  if (pair.with >= pair.against) {
    const double off_course = off(pair.with, run.length, same_way);
    if (off_course <= 1.0) return {WritingDirection::forwards, std::min(off_course, almost)};
  } else {
    // Something much longer than a dot is no dot written backwards.
    const double off_reverse = off(pair.against, std::max(run.length, reading.costs->length(step.path)), opposite_way);
    if (off_reverse <= 1.0) return {WritingDirection::backwards, 1.0 / std::max(off_reverse, 1.0 - almost)};
  }
  if (step.paths > 1 || step.strokes > 1) return {WritingDirection::forwards, 0.0};
  return {WritingDirection::neither, std::max(1.0, off(pair.with, run.length, same_way))};
}

}  // namespace calligraphy
