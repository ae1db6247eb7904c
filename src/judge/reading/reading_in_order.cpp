#include "reading_in_order.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "judge/judge_constants.hpp"

namespace calligraphy {

using detail::judge_constants;

StrokeReading read_in_this_order(std::shared_ptr<const StrokeCosts> costs, std::span<const std::size_t> order) {
  struct Best {
    double cost = std::numeric_limits<double>::infinity();
    ReadingStep step;
  };
  const std::size_t paths = order.size(), strokes = costs->strokes();
  const double unlikely = judge_constants.unlikely_count_cost;
  const double join_price = judge_constants.join_cost + (paths >= strokes ? unlikely : 0.0);
  const double break_price = judge_constants.break_cost + (paths <= strokes ? unlikely : 0.0);
  std::vector<std::vector<Best>> best(paths + 1, std::vector<Best>(strokes + 1));
  best[0][0].cost = 0.0;
  for (std::size_t i = 0; i <= paths; ++i) {
    const std::size_t path = i < paths ? order[i] : paths;
    for (std::size_t stroke = 0; stroke <= strokes; ++stroke) {
      const double before = best[i][stroke].cost;
      const auto reach = [&](std::size_t more_paths, std::size_t more_strokes, double cost) {
        Best& then = best[i + more_paths][stroke + more_strokes];
        if (before + cost < then.cost) then = {before + cost, {path, more_paths, stroke, more_strokes, cost}};
      };
      if (stroke < strokes) reach(0, 1, judge_constants.left_over_cost);
      if (i == paths) continue;
      reach(1, 0, costs->is_tap(path) ? 0.0 : judge_constants.left_over_cost);
      if (stroke == strokes) continue;
      reach(1, 1, costs->single(path, stroke).cost);
      for (std::size_t more = 2; more <= std::min(max_joined, strokes - stroke); ++more) {
        reach(1, more, costs->joined(path, stroke, more).cost + join_price * static_cast<double>(more - 1));
      }
      if (i + 1 < paths && order[i + 1] == path + 1) reach(2, 1, costs->broken(path, stroke).cost + break_price);
    }
  }
  StrokeReading reading{{}, best[paths][strokes].cost, std::move(costs)};
  for (std::size_t i = paths, stroke = strokes; i > 0 || stroke > 0;) {
    const ReadingStep& step = best[i][stroke].step;
    reading.steps.push_back(step);
    i -= step.paths;
    stroke -= step.strokes;
  }
  std::reverse(reading.steps.begin(), reading.steps.end());
  return reading;
}

}  // namespace calligraphy
