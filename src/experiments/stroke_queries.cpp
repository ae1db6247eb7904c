#include "stroke_queries.hpp"

#include <algorithm>
#include <cstddef>

#include <calligraphy/collision/active_stroke.hpp>

#include "base/require.hpp"
#include "model/random_points.hpp"

namespace calligraphy {
namespace {

/// Length of stroke from one turning point of the wobble to the next [m].
constexpr double wobble_length = 0.01;

/// A smooth deviation through random points at even distances: it rests at each, with neither speed nor acceleration.
class Wobble {
 public:
  Wobble(RandomPoints& random, double length, double most) {
    const double amplitude = most * random.next();
    const auto count = static_cast<std::size_t>(length / wobble_length) + 2;
    for (std::size_t i = 0; i < count; ++i) turning_points_.push_back(amplitude * random.in_disc());
  }

  Point at(double arc) const {
    const double scaled = arc / wobble_length;
    const auto i = std::min(static_cast<std::size_t>(scaled), turning_points_.size() - 2);
    const double x = scaled - static_cast<double>(i);
    const double share = x * x * x * (10.0 + x * (6.0 * x - 15.0));
    return turning_points_[i] + share * (turning_points_[i + 1] - turning_points_[i]);
  }

 private:
  std::vector<Point> turning_points_;
};

std::vector<Point> path_along(const Stroke& stroke, const StrokeQueryOptions& options, RandomPoints& random) {
  ActiveStroke active;
  active.load(stroke, {Point::Zero(), options.em});
  const Wobble wobble(random, active.length(), options.wobble);
  const double step = options.speed / options.rate;
  std::vector<Point> path;
  for (int tick = 0;; ++tick) {
    const double arc = tick * step;
    if (arc > active.length()) return path;
    path.push_back(active.at(arc).point + wobble.at(arc));
  }
}

}  // namespace

std::vector<std::vector<Point>> elements_of(const Stroke& stroke, double em) {
  std::vector<std::vector<Point>> elements;
  const std::vector<int> ends = feature_points(stroke.elements, stroke.curve_degree);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    std::vector<Point>& element = elements.emplace_back();
    for (int k = ends[i]; k <= ends[i + 1]; ++k) {
      element.push_back(em * stroke.control_points[static_cast<std::size_t>(k)]);
    }
  }
  return elements;
}

std::vector<StrokeQueries> stroke_queries(std::span<const Character> characters, const StrokeQueryOptions& options) {
  require_above_zero("stroke queries: em", options.em, "m");
  require_above_zero("stroke queries: rate", options.rate, "Hz");
  require_above_zero("stroke queries: speed", options.speed, "m/s");
  require_not_negative("stroke queries: wobble", options.wobble, "m");
  std::vector<StrokeQueries> drawn;
  RandomPoints random(options.seed);
  for (const Character& character : characters) {
    for (const Stroke& stroke : strokes(character)) {
      StrokeQueries& queries = drawn.emplace_back();
      queries.elements = elements_of(stroke, options.em);
      queries.path = path_along(stroke, options, random);
    }
  }
  return drawn;
}

}  // namespace calligraphy
