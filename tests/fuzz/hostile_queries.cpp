#include "hostile_queries.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy_test {
namespace {

using Points = std::span<const Point>;

Point turned_left(const Point& vector) { return {-vector.y(), vector.x()}; }

/// The curve and its first two derivatives at t.
struct Jet {
  Point point, slope, bend;
};

Jet jet(Points points, double t) {
  std::array<Point, 5> row;
  std::copy(points.begin(), points.end(), row.begin());
  const std::size_t n = points.size() - 1;
  const double degree = static_cast<double>(n);
  Jet at{Point::Zero(), Point::Zero(), Point::Zero()};
  for (std::size_t count = n; count > 0; --count) {
    if (count == 2) at.bend = degree * (degree - 1.0) * (row[2] - 2.0 * row[1] + row[0]);
    if (count == 1) at.slope = degree * (row[1] - row[0]);
    for (std::size_t i = 0; i < count; ++i) row[i] += t * (row[i + 1] - row[i]);
  }
  at.point = row[0];
  return at;
}

double size_of_box(Points points) {
  Point low = points[0], high = points[0];
  for (const Point& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double size = (high - low).norm();
  return size > 0.0 ? size : 1.0;
}

Point in_box(RandomPoints& random, Points points) {
  Point low = points[0], high = points[0];
  for (const Point& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double margin = random.next() * size_of_box(points);
  const Point share = random.point(0.0, 1.0);
  return (low - Point(margin, margin)) + share.cwiseProduct(high - low + 2.0 * Point(margin, margin));
}

double parameter(RandomPoints& random) {
  switch (random.index(6)) {
    case 0:
      return 0.0;
    case 1:
      return 1.0;
    case 2:
      return static_cast<double>(random.index(17)) / 16.0;
    default:
      return random.next();
  }
}

Point near(RandomPoints& random, Points points) {
  return jet(points, random.next()).point + magnitude(random, -15.0, 0.0) * size_of_box(points) * random.direction();
}

Point on_curve(RandomPoints& random, Points points) { return jet(points, parameter(random)).point; }

Point at_control_points(RandomPoints& random, Points points) {
  const Point& a = points[random.index(points.size())];
  const Point& b = points[random.index(points.size())];
  return one_in(random, 2) ? a : Point(0.5 * (a + b));
}

/// Where the slope of the squared distance vanishes at an end, or is noise there.
Point on_end_normal(RandomPoints& random, Points points) {
  const bool at_start = one_in(random, 2);
  const Point end = at_start ? points.front() : points.back();
  const std::size_t which = 1 + random.index(points.size() - 1);
  const Point handle = (at_start ? points[which] : points[points.size() - 1 - which]) - end;
  const double sizes =
      one_in(random, 2) ? static_cast<double>(random.index(17)) / 8.0 - 1.0 : random.between(-2.0, 2.0);
  return end + sizes * turned_left(handle) + slight(random) * random.in_disc();
}

/// On the straight line through a handle.
Point on_handle(RandomPoints& random, Points points) {
  const std::size_t i = random.index(points.size() - 1);
  const double share =
      one_in(random, 2) ? static_cast<double>(random.index(17)) / 8.0 - 0.5 : random.between(-2.0, 3.0);
  return points[i] + share * (points[i + 1] - points[i]);
}

/// Where two or three closest points coincide.
Point at_centre_of_curvature(RandomPoints& random, Points points) {
  const double size = size_of_box(points);
  for (int attempt = 0; attempt < 8; ++attempt) {
    const Jet at = jet(points, parameter(random));
    const double turn = at.slope.x() * at.bend.y() - at.slope.y() * at.bend.x();
    const Point radius = turned_left(at.slope) * at.slope.squaredNorm();
    if (!(radius.norm() < 100.0 * size * std::abs(turn))) continue;
    // Next to it the closest points separate, by so little that signs in single precision hardly distinguish them.
    const double beside = one_in(random, 2) ? slight(random) : magnitude(random, -7.0, -1.0);
    return at.point + radius / turn + beside * size * random.in_disc();
  }
  return in_box(random, points);
}

/// On the grid of snapped control points, or on the axis of symmetric ones.
Point on_grid(RandomPoints& random, Points) {
  const auto step = [&] { return static_cast<double>(random.index(65)) / 16.0 - 2.0; };
  if (one_in(random, 3)) return {slight(random), one_in(random, 2) ? step() : random.between(-2.0, 2.0)};
  const double x = step();
  return {x, step()};
}

/// The centre of arcs, and of curves with rotational symmetry.
Point at_origin(RandomPoints& random, Points) { return slight(random) * random.in_disc(); }

Point far(RandomPoints& random, Points points) {
  const Point direction = one_in(random, 4) ? Point(0.0, 1.0) : random.direction();
  const double sizes = one_in(random, 8) ? magnitude(random, 8.0, 60.0) : magnitude(random, 0.0, 8.0);
  return points[0] + sizes * size_of_box(points) * direction;
}

constexpr Point (*kinds[])(RandomPoints&, Points) = {
    in_box,  near,      on_curve, at_control_points, on_end_normal, on_handle, at_centre_of_curvature,
    on_grid, at_origin, far};

}  // namespace

Point draw_query(RandomPoints& random, Points control_points) {
  // Most pens are near the box or inside it.
  if (one_in(random, 3)) return one_in(random, 2) ? in_box(random, control_points) : near(random, control_points);
  return kinds[random.index(std::size(kinds))](random, control_points);
}

Point draw_tie(RandomPoints& random, Points control_points) {
  const calligraphy::StrokeElement element = calligraphy::prepare_element(control_points);
  const auto closest = [&](const Point& query) { return calligraphy::nearest_point(element, query).parameter; };
  Point one = in_box(random, control_points), other = in_box(random, control_points);
  double at_one = closest(one), at_other = closest(other);
  const int halvings = 10 + static_cast<int>(random.index(45));
  for (int i = 0; i < halvings; ++i) {
    const Point middle = 0.5 * (one + other);
    const double at_middle = closest(middle);
    if (std::abs(at_middle - at_one) < std::abs(at_middle - at_other)) {
      one = middle, at_one = at_middle;
    } else {
      other = middle, at_other = at_middle;
    }
  }
  return one;
}

}  // namespace calligraphy_test
