#include "tradeoff_pen.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <calligraphy/collision/stroke_tracker.hpp>
#include <calligraphy/render/force_terms.hpp>

#include "base/monotonic_clock.hpp"

namespace calligraphy {
namespace {

/// The nearest point of all elements.
NearestPoint over_all(const std::vector<StrokeElement>& elements, const Point& query,
                      const NearestPointOptions& options) {
  NearestPoint nearest = nearest_point(elements.front(), query, options);
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const NearestPoint found = nearest_point(elements[i], query, options);
    if (found.distance < nearest.distance) nearest = found;
  }
  return nearest;
}

/// Follows the pen along each stroke; `use` gets the stroke, the tick and the closest point.
template <typename Use>
void follow(const TracedStrokes& strokes, const NearestPointOptions& options, const Use& use) {
  for (const TracedStroke& stroke : strokes) {
    if (options.method == NearestPointMethod::tracked) {
      StrokeTracker tracker(stroke.elements, options.tolerance);
      for (std::size_t i = 0; i < stroke.path.size(); ++i) use(stroke, i, tracker.update(stroke.path[i]).closest);
    } else {
      for (std::size_t i = 0; i < stroke.path.size(); ++i) {
        use(stroke, i, over_all(stroke.elements, stroke.path[i], options));
      }
    }
  }
}

/// A pen beside an arc of 90 degrees round the origin, outside it by `offset`, at constant speed.
DrawnCurve arc(double radius, double offset, double step) {
  constexpr double angle = 0.5 * std::numbers::pi;
  const double handle = 4.0 / 3.0 * std::tan(angle / 4.0) * radius;
  const std::vector<Point> points = {{radius, 0.0}, {radius, handle}, {handle, radius}, {0.0, radius}};
  DrawnCurve curve{prepare_element(points), {}};
  const double pen_radius = radius + offset;
  for (double turned = 0.0; turned <= angle; turned += step / pen_radius) {
    curve.path.push_back(pen_radius * Point(std::cos(turned), std::sin(turned)));
  }
  return curve;
}

}  // namespace

TracedStrokes drawn_strokes(const std::vector<StrokeQueries>& queries) {
  TracedStrokes strokes;
  for (const StrokeQueries& each : queries) {
    TracedStroke stroke;
    for (const auto& element : each.elements) {
      stroke.elements.push_back(prepare_element(element));
      stroke.size = std::max(stroke.size, stroke.elements.back().size());
    }
    stroke.path = each.path;
    for (const Point& tip : stroke.path) {
      stroke.distances.push_back(over_all(stroke.elements, tip, reference).distance);
    }
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

std::vector<TracedStrokes> in_groups(const TracedStrokes& strokes) {
  constexpr std::size_t size = 4;
  std::vector<TracedStrokes> groups;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    if (i % size == 0) groups.emplace_back();
    groups.back().push_back(strokes[i]);
  }
  return groups;
}

std::vector<double> tick_errors(const TracedStrokes& strokes, const NearestPointOptions& options) {
  std::vector<double> errors;
  follow(strokes, options, [&errors](const TracedStroke& stroke, std::size_t i, const NearestPoint& closest) {
    errors.push_back(std::abs(closest.distance - stroke.distances[i]) / stroke.size);
  });
  return errors;
}

double tick_time(const TracedStrokes& strokes, const NearestPointOptions& options) {
  return seconds_of([&] {
    double sum = 0.0;
    follow(strokes, options,
           [&sum](const TracedStroke&, std::size_t, const NearestPoint& closest) { sum += closest.parameter; });
    return sum;
  });
}

std::vector<DrawnCurve> drawn_curves(const TracedStrokes& strokes, double step) {
  std::vector<DrawnCurve> curves;
  for (const TracedStroke& stroke : strokes) {
    double end = 0.0;
    std::size_t tick = 0;
    for (const StrokeElement& element : stroke.elements) {
      end += element.length();
      DrawnCurve curve{element, {}};
      for (; tick < stroke.path.size() && static_cast<double>(tick) * step <= end; ++tick) {
        curve.path.push_back(stroke.path[tick]);
      }
      if (element.curve() != nullptr) curves.push_back(std::move(curve));
    }
  }
  return curves;
}

std::vector<DrawnCurve> gentle_arcs(double step) {
  std::vector<DrawnCurve> arcs;
  for (const double radius : {0.015, 0.025, 0.040}) {
    for (const double offset : {-0.004, -0.002, -0.001, 0.001, 0.002, 0.004}) arcs.push_back(arc(radius, offset, step));
  }
  return arcs;
}

PenFeel feel(const std::vector<DrawnCurve>& curves, const NearestPointOptions& options, double stiffness) {
  PenFeel result;
  std::size_t ticks = 0, wrong = 0;
  for (const DrawnCurve& curve : curves) {
    Point last = Point::Zero();
    double parameter = 0.5;
    for (std::size_t i = 0; i < curve.path.size(); ++i) {
      const Point& tip = curve.path[i];
      const NearestPoint closest = nearest_point(curve.element, tip, options, {}, parameter);
      parameter = closest.parameter;
      const double exact = nearest_point(curve.element, tip, reference).distance;
      const Point force = attraction_force(stiffness, tip, closest.point);
      if (i > 0) result.max_step = std::max(result.max_step, (force - last).norm());
      last = force;
      ++ticks;
      if (!(std::abs(closest.distance - exact) <= wrong_branch * curve.element.size())) ++wrong;
    }
  }
  result.wrong = ticks > 0 ? static_cast<double>(wrong) / static_cast<double>(ticks) : 0.0;
  return result;
}

}  // namespace calligraphy
