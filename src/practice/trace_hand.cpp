#include "trace_hand.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "hand_motion.hpp"

namespace calligraphy {
namespace {

constexpr double min_traced_approach = 0.15;  // [s]
constexpr double first_approach = 0.5;        // time to the first stroke [s]
constexpr double max_rest = 3.0;              // longer pauses in the air are shortened to this [s]
constexpr double air_step = 0.004;            // between knots in the air [s]

void require_valid(const PenTrace& trace) {
  double last = 0.0;
  bool any = false;
  for (const PenStroke& stroke : trace.strokes) {
    for (const TimedPoint& timed : stroke) {
      if (!timed.point.allFinite()) throw ValueError("a trace with a point that is not finite");
      if (!(timed.time >= last) || !std::isfinite(timed.time)) {
        throw ValueError("a trace whose time goes from " + number_text(last) + " s to " + number_text(timed.time) +
                         " s");
      }
      last = timed.time;
      any = any || !is_erasing(stroke);
    }
  }
  if (!any) throw ValueError("a trace without a point");
}

}  // namespace

TraceHand::TraceHand(const PenTrace& trace, const PlacedCharacter& placed, const Eigen::Vector3d& start)
    : knots_{{0.0, start, sensed_at(start.z())}} {
  require_valid(trace);
  const BoxMap map = fit_box(pen_paths(trace), placed.character);
  double last_time = 0.0;
  for (const PenStroke& stroke : trace.strokes) {
    if (stroke.empty() || is_erasing(stroke)) continue;
    const bool first = knots_.size() == 1;
    Eigen::Vector3d above = Eigen::Vector3d::Zero();
    above << placed.placement.to_page(map(stroke.front().point)), raised_height;
    const double rest = std::min(stroke.front().time - last_time, max_rest) - lowering_time - raising_time;
    const double way = (above - knots_.back().point).norm();
    move(above, std::max({first ? first_approach : rest, way / approach_speed, min_traced_approach}));
    move({above.x(), above.y(), -pressed_depth}, lowering_time);
    write(stroke, map, placed.placement);
    const Eigen::Vector3d end = knots_.back().point;
    move({end.x(), end.y(), raised_height}, raising_time);
    last_time = stroke.back().time;
  }
}

TraceHand::Pen TraceHand::at(double time) const noexcept {
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), time,
                                      [](double value, const Knot& knot) { return value < knot.time; });
  if (after == knots_.begin()) return {knots_.front().point, knots_.front().stylus};
  if (after == knots_.end()) return {knots_.back().point, knots_.back().stylus};
  const Knot& before = *(after - 1);
  const double share = (time - before.time) / (after->time - before.time);
  return {before.point + share * (after->point - before.point), before.stylus};
}

void TraceHand::move(const Eigen::Vector3d& to, double seconds) {
  const Knot from = knots_.back();
  const int steps = std::max(1, static_cast<int>(std::ceil(seconds / air_step)));
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const Eigen::Vector3d point = from.point + minimum_jerk(share) * (to - from.point);
    knots_.push_back({from.time + share * seconds, point, sensed_at(point.z())});
  }
}

void TraceHand::write(const PenStroke& stroke, const BoxMap& map, const Placement& placement) {
  const double shift = knots_.back().time - stroke.front().time;
  for (const TimedPoint& timed : stroke) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point << placement.to_page(map(timed.point)), -pressed_depth;
    // Points with the same time lie on the way from one sample to the next; the last of them is where the pen was.
    if (timed.time + shift <= knots_.back().time) {
      knots_.back() = {knots_.back().time, point, timed.stylus};
    } else {
      knots_.push_back({timed.time + shift, point, timed.stylus});
    }
  }
}

}  // namespace calligraphy
