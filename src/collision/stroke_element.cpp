#include <calligraphy/collision/stroke_element.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "length.hpp"

namespace calligraphy {

using detail::LineElement;

namespace {

/// A smaller curve counts as a point, since division by its size could overflow [m].
constexpr double min_curve = 1e-300;

/// Squares of anything larger overflow [m].
constexpr double max_element = 1e150;

/// An element without a position: every query returns not_finite.
LineElement unusable_element() {
  LineElement nowhere;
  nowhere.length = std::numeric_limits<double>::quiet_NaN();
  return nowhere;
}

}  // namespace

LineElement detail::prepare_line(const Point& start, const Point& end) noexcept {
  LineElement line;
  line.origin = start;
  line.edge = end - start;
  line.length = length(line.edge);
  if (line.length > 0.0) line.direction = line.edge / line.length;
  return line;
}

StrokeElement prepare_element(std::span<const Point> control_points) noexcept {
  if (control_points.size() < 2 || control_points.size() > max_curve_degree + 1) return {unusable_element()};
  const Point& start = control_points.front();
  const auto all_within = [&](double reach) {
    return std::all_of(control_points.begin(), control_points.end(), [&](const Point& point) {
      return std::abs(point.x() - start.x()) <= reach && std::abs(point.y() - start.y()) <= reach;
    });
  };
  if (!all_within(max_element)) return {unusable_element()};
  if (all_within(min_curve)) return {detail::prepare_line(start, start)};
  if (control_points.size() == 2) return {detail::prepare_line(start, control_points.back())};
  return {detail::prepare_curve(control_points)};
}

std::vector<StrokeElement> place_elements(const Stroke& stroke, const Placement& placement) {
  std::vector<StrokeElement> elements;
  const std::vector<int> ends = feature_points(stroke.elements, stroke.curve_degree);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    std::vector<Point> points;
    for (int k = ends[i]; k <= ends[i + 1]; ++k) {
      points.push_back(placement.to_page(stroke.control_points[static_cast<std::size_t>(k)]));
    }
    elements.push_back(prepare_element(points));
  }
  return elements;
}

std::vector<std::vector<StrokeElement>> place_elements(const PlacedCharacter& placed) {
  std::vector<std::vector<StrokeElement>> elements;
  for (const Stroke& stroke : strokes(placed.character)) elements.push_back(place_elements(stroke, placed.placement));
  return elements;
}

}  // namespace calligraphy
