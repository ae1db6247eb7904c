#include "stroke_direction.hpp"

#include <algorithm>
#include <cmath>

#include "judge/judge_constants.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr double almost = 0.999;  // evidence just short of a remark

}  // namespace

double length_share(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes) {
  double length = 0.0;
  for (std::size_t path = step.path; path < step.path + step.paths; ++path) length += reading.costs->length(path);
  const double whole = run_of(step, strokes).line_length;
  return whole > 0.0 ? length / whole : 1.0;
}

StrokeDirection direction_of(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes) {
  if (reading.costs->is_tap(step.path)) return {};
  const StrokeRun run = run_of(step, strokes);
  const double share = length_share(step, reading, strokes);
  const double left_out = (1.0 - share) * run.line_length;
  if (share < judge_constants.least_share && left_out > judge_constants.sure_length) {
    return {WritingDirection::neither,
            std::min(judge_constants.least_share / share, left_out / judge_constants.sure_length)};
  }
  const PairCost& pair = reading.pair(step);
  // The angle beyond what short strokes are allowed, over the largest permitted one.
  const auto off = [](double accord, double trusted_length, double within) {
    const double allowed = (1.0 - trust_in_direction(trusted_length)) * judge_constants.untrusted_angle;
    return std::max(0.0, std::acos(std::clamp(accord, -1.0, 1.0)) - allowed) / within;
  };
  if (pair.with >= pair.against) {
    const double off_course = off(pair.with, run.length, judge_constants.forwards_angle);
    if (off_course <= 1.0) return {WritingDirection::forwards, std::min(off_course, almost)};
  } else {
    // Something much longer than a dot is not a dot written backwards.
    const double length = std::max(run.length, reading.costs->length(step.path));
    const double off_reverse = off(pair.against, length, judge_constants.backwards_angle);
    if (off_reverse <= 1.0) return {WritingDirection::backwards, 1.0 / std::max(off_reverse, 1.0 - almost)};
  }
  if (step.paths > 1 || step.strokes > 1 || step.also) return {WritingDirection::forwards, 0.0};
  return {WritingDirection::neither, std::max(1.0, off(pair.with, run.length, judge_constants.forwards_angle))};
}

}  // namespace calligraphy
