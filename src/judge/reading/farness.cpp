#include "farness.hpp"

#include <algorithm>

#include "judge/judge_constants.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr double fewest_unreadable = 3.0;  // pen-downs that cannot be read together: of fewer, each is judged
constexpr double much_farther = 2.0;       // distance of the farthest pen-down, over the mean of the others [1]

}  // namespace

double ComparedStep::distance_of_shapes() const {
  return mean_distance(drawn.rowwise() - drawn.colwise().mean(), wanted.rowwise() - wanted.colwise().mean());
}

ComparedStep compare_step(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes) {
  const Outline line = run_of(step, strokes).line;
  return {reading.costs->placed(step.path, step.paths), reading.pair(step).backwards ? reversed(line) : line};
}

bool Farness::is_all_over() const {
  return count >= fewest_unreadable && unlike > judge_constants.far_distance && far >= judge_constants.unreadable_share;
}

bool Farness::is_beyond_right_writing() const {
  return count > 1.0 && distance > judge_constants.max_unremarked_distance;
}

Farness farness_of(const StrokeReading& reading, const StrokeOutlines& strokes, std::span<const DrawnStroke> drawn) {
  Farness sum;
  double farthest = 0.0;
  for (const ReadingStep& step : reading.steps) {
    if (step.paths == 0 || (step.paths == 1 && reading.costs->is_tap(step.path))) continue;
    double distance = judge_constants.left_over_cost;
    if (step.strokes == 0 && drawn[step.path].attempt >= 0) distance = judge_constants.far_distance;
    double unlike = distance;
    if (step.strokes > 0) {
      const ComparedStep compared = compare_step(step, reading, strokes);
      distance = unlike = compared.distance();
      const bool is_alike = compared.distance_of_shapes() < judge_constants.far_shape;
      if (is_alike) unlike = std::min(unlike, judge_constants.far_distance);
      if (distance > farthest) {
        sum.misplaced.reset();
        if (step.strokes == 1 && step.paths == 1) sum.misplaced = {step.path, step.stroke, compared.offset()};
      }
    } else if (distance > farthest) {
      sum.misplaced.reset();
    }
    farthest = std::max(farthest, distance);
    ++sum.count;
    sum.distance += distance;
    sum.unlike += unlike;
    if (unlike > judge_constants.far_distance) ++sum.far;
  }
  if (sum.distance - farthest > (sum.count - 1.0) * farthest / much_farther) sum.misplaced.reset();
  const double count = std::max(sum.count, 1.0);
  sum.distance /= count;
  sum.unlike /= count;
  sum.far /= count;
  return sum;
}

}  // namespace calligraphy
