#include "hostile_curves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace calligraphy_test {
namespace {

using Polygon = std::vector<Point>;

std::size_t count_of(int degree) { return static_cast<std::size_t>(degree) + 1; }

Point perpendicular(const Point& vector) { return {-vector.y(), vector.x()}; }

double sign(RandomPoints& random) { return one_in(random, 2) ? 1.0 : -1.0; }

Point on_grid(RandomPoints& random, int steps) {
  const double x = static_cast<double>(random.index(static_cast<std::uint64_t>(steps) + 1)) / steps;
  return {x, static_cast<double>(random.index(static_cast<std::uint64_t>(steps) + 1)) / steps};
}

Polygon line(RandomPoints& random, int) {
  if (one_in(random, 3)) return {on_grid(random, 8), on_grid(random, 8)};
  const Point start = random.point(0.0, 1.0);
  return {start, start + magnitude(random, -3.0, 0.0) * random.direction()};
}

Polygon anywhere(RandomPoints& random, int degree) {
  Polygon polygon(count_of(degree));
  for (Point& point : polygon) point = random.point(0.0, 1.0);
  return polygon;
}

/// Like real strokes: handles of similar length, each turned slightly from the last.
Polygon gentle(RandomPoints& random, int degree) {
  Polygon polygon = {random.point(0.0, 1.0)};
  double heading = random.between(0.0, 2.0 * std::numbers::pi);
  const double turn = random.between(0.0, 1.5);
  for (int i = 0; i < degree; ++i) {
    polygon.push_back(polygon.back() + random.between(0.1, 0.5) * Point(std::cos(heading), std::sin(heading)));
    heading += random.between(-0.3, 1.0) * turn;
  }
  return polygon;
}

/// Collinear, symmetric, closed, folded and equal control points are frequent, and exact.
Polygon snapped(RandomPoints& random, int degree) {
  constexpr int grids[] = {2, 4, 8};
  const int steps = grids[random.index(3)];
  Polygon polygon(count_of(degree));
  for (Point& point : polygon) point = on_grid(random, steps);
  return polygon;
}

Polygon equal_control_points(RandomPoints& random, int degree) {
  Polygon polygon = one_in(random, 3) ? snapped(random, degree) : anywhere(random, degree);
  const double apart = slight(random);
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    if (one_in(random, 2)) polygon[i] = polygon[random.index(i)] + apart * random.in_disc();
  }
  return polygon;
}

/// End handles of length 0 or 1e-16 to 1e-1: the slope is noise at the ends.
Polygon short_handles(RandomPoints& random, int degree) {
  Polygon polygon = anywhere(random, degree);
  const bool exact = one_in(random, 3);
  const double length = exact ? 0.0 : magnitude(random, -16.0, -1.0);
  if (!one_in(random, 3)) polygon[1] = polygon[0] + length * random.direction();
  if (!one_in(random, 3)) *(polygon.end() - 2) = polygon.back() + length * random.direction();
  return polygon;
}

Polygon long_handles(RandomPoints& random, int degree) {
  Polygon polygon = anywhere(random, degree);
  const double length = magnitude(random, 0.0, 5.0);
  polygon[1] = polygon[0] + length * random.direction();
  if (one_in(random, 2)) *(polygon.end() - 2) = polygon.back() + length * random.direction();
  return polygon;
}

Polygon collinear(RandomPoints& random, int degree) {
  const Point start = random.point(-1.0, 1.0);
  const Point along = one_in(random, 3) ? Point(1.0, 0.0) : one_in(random, 2) ? Point(1.0, 0.5) : random.direction();
  const double bow = slight(random);
  const bool grid = one_in(random, 2), ordered = one_in(random, 2);
  std::vector<double> at(count_of(degree));
  for (double& value : at) value = grid ? static_cast<double>(random.index(9)) / 8.0 : random.next();
  if (ordered) std::sort(at.begin(), at.end());
  Polygon polygon;
  for (const double value : at) {
    polygon.push_back(start + value * along + bow * random.between(-1.0, 1.0) * perpendicular(along));
  }
  return polygon;
}

Polygon evenly_spaced(RandomPoints& random, int degree) {
  const double bow = one_in(random, 4) ? 0.0 : magnitude(random, -17.0, -1.0);
  Polygon polygon;
  for (int i = 0; i <= degree; ++i) {
    polygon.emplace_back(static_cast<double>(i) / degree, bow * random.between(-1.0, 1.0));
  }
  return polygon;
}

/// Its own mirror image in the axis x = 0, or its own image when rotated by half a turn about the origin; or nearly so.
Polygon symmetric(RandomPoints& random, int degree) {
  const bool grid = one_in(random, 2), turned = one_in(random, 3);
  const double broken = one_in(random, 3) ? slight(random) : 0.0;
  Polygon polygon(count_of(degree));
  for (std::size_t i = 0, j = polygon.size() - 1; i <= j; ++i, --j) {
    Point point = grid ? Point(2.0 * on_grid(random, 8) - Point(1.0, 1.0)) : random.point(-1.0, 1.0);
    if (i == j) point = turned ? Point(0.0, 0.0) : Point(0.0, point.y());
    polygon[i] = point;
    polygon[j] = turned ? Point(-point) : Point(-point.x(), point.y());
    if (i != j) polygon[j] += broken * random.in_disc();
    if (j == 0) break;
  }
  return polygon;
}

Polygon closed(RandomPoints& random, int degree) {
  Polygon polygon = one_in(random, 2) ? anywhere(random, degree) : snapped(random, degree);
  polygon.back() = polygon.front() + slight(random) * random.in_disc();
  if (one_in(random, 4)) {  // there and back over the same points
    for (std::size_t i = 0, j = polygon.size() - 1; i < j; ++i, --j) polygon[j] = polygon[i];
  }
  return polygon;
}

/// B' = (t - t0) V(t): the speed vanishes inside, or nearly so.
Polygon cusp(RandomPoints& random, int degree) {
  const double t0 = one_in(random, 3) ? 0.5 : random.between(0.05, 0.95);
  std::vector<Point> v(static_cast<std::size_t>(degree) - 1);  // Bernstein ordinates of V, of degree n - 2
  for (Point& point : v) point = random.direction();
  Polygon polygon = {random.point(0.0, 1.0)};
  const int m = degree - 1;  // of B'
  for (int k = 0; k <= m; ++k) {
    Point slope = Point::Zero();
    if (k < m) slope += (static_cast<double>(m - k) / m) * -t0 * v[static_cast<std::size_t>(k)];
    if (k > 0) slope += (static_cast<double>(k) / m) * (1.0 - t0) * v[static_cast<std::size_t>(k) - 1];
    polygon.push_back(polygon.back() + slope);
  }
  const double apart = one_in(random, 3) ? magnitude(random, -3.0, -1.0) : slight(random);
  for (Point& point : polygon) point += apart * random.in_disc();
  return polygon;
}

/// A loop: the handles cross.
Polygon loop(RandomPoints& random, int degree) {
  Polygon polygon = {{0.0, 0.0}};
  for (int i = 1; i < degree; ++i) {
    const double share = static_cast<double>(i - 1) / std::max(1, degree - 2);
    polygon.emplace_back(1.5 - 2.0 * share, 1.0 + (i % 2) * 0.3);
  }
  polygon.emplace_back(1.0, 0.0);
  const double apart = one_in(random, 4) ? 0.0 : 0.3;
  for (Point& point : polygon) point += apart * random.in_disc();
  return polygon;
}

/// Forwards and backwards, a narrow distance apart.
Polygon hairpin(RandomPoints& random, int degree) {
  const double width = magnitude(random, -16.0, -1.0);
  Polygon polygon;
  for (int i = 0; i <= degree; ++i) {
    const double x = i == 0 ? 0.0 : i == degree ? random.between(-0.2, 0.2) : random.between(0.7, 1.3);
    polygon.emplace_back(x, width * i);
  }
  return polygon;
}

/// The usual Bezier approximations of circular arcs around the origin.
Polygon arc(RandomPoints& random, int degree) {
  const double angle = one_in(random, 2) ? random.between(0.05, 3.0) : magnitude(random, -3.0, 0.0);
  const double first = one_in(random, 3) ? 0.0 : random.between(0.0, 6.3);
  const auto at = [&](double a) { return Point(std::cos(first + a), std::sin(first + a)); };
  const Point start = at(0.0), end = at(angle);
  if (degree == 2) return {start, (1.0 / std::cos(0.5 * std::min(angle, 2.5))) * at(0.5 * angle), end};
  const double handle = 4.0 / 3.0 * std::tan(0.25 * angle);
  const Polygon cubic = {start, start + handle * perpendicular(start), end - handle * perpendicular(end), end};
  if (degree == 3) return cubic;
  return {cubic[0], 0.25 * (cubic[0] + 3.0 * cubic[1]), 0.5 * (cubic[1] + cubic[2]), 0.25 * (3.0 * cubic[2] + cubic[3]),
          cubic[3]};
}

/// A curve elevated from a lower degree, so that the leading coefficient is rounding noise.
Polygon raised(RandomPoints& random, int degree) {
  const int lower = 1 + static_cast<int>(random.index(static_cast<std::uint64_t>(degree) - 1));
  Polygon polygon = one_in(random, 2) ? snapped(random, lower) : anywhere(random, lower);
  for (int n = lower; n < degree; ++n) {
    Polygon next = {polygon.front()};
    for (int i = 1; i <= n; ++i) {
      const double share = static_cast<double>(i) / (n + 1);
      next.push_back(share * polygon[static_cast<std::size_t>(i) - 1] +
                     (1.0 - share) * polygon[static_cast<std::size_t>(i)]);
    }
    next.push_back(polygon.back());
    polygon = next;
  }
  const double apart = slight(random);
  for (Point& point : polygon) point += apart * random.in_disc();
  return polygon;
}

/// Flat where it begins or ends: all but the last control points lie within 1e-8 to 1e-1.
Polygon crowded(RandomPoints& random, int degree) {
  const double within = magnitude(random, -8.0, -1.0);
  Polygon polygon(count_of(degree));
  for (Point& point : polygon) point = within * random.in_disc();
  polygon.back() = random.direction();
  if (one_in(random, 2)) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

constexpr CurveFamily hostile_families[] = {
    {"line", line},
    {"anywhere", anywhere},
    {"gentle", gentle},
    {"snapped to a grid", snapped},
    {"equal control points", equal_control_points},
    {"short handles", short_handles},
    {"long handles", long_handles},
    {"collinear", collinear},
    {"evenly spaced", evenly_spaced},
    {"symmetric", symmetric},
    {"closed", closed},
    {"cusp", cusp},
    {"loop", loop},
    {"hairpin", hairpin},
    {"arc", arc},
    {"raised degree", raised},
    {"crowded", crowded},
};

}  // namespace

std::span<const CurveFamily> curve_families() { return hostile_families; }

double magnitude(RandomPoints& random, double low, double high) { return std::pow(10.0, random.between(low, high)); }

double slight(RandomPoints& random) { return one_in(random, 2) ? 0.0 : magnitude(random, -16.0, -4.0); }

bool one_in(RandomPoints& random, int count) { return random.index(static_cast<std::uint64_t>(count)) == 0; }

Place::Place(RandomPoints& random) {
  if (!one_in(random, 3)) return;
  const bool exact = one_in(random, 2);
  if (!one_in(random, 3)) {
    scale_ = magnitude(random, -12.0, 8.0);
    if (exact) scale_ = std::exp2(std::round(std::log2(scale_)));
  }
  if (one_in(random, 2)) {
    along_ = exact ? Point(0.0, sign(random)) : random.direction();
  }
  if (one_in(random, 2)) {
    const double sizes = magnitude(random, 0.0, 8.0);
    offset_ = scale_ * (exact ? Point(std::round(sizes), -std::round(sizes)) : Point(sizes * random.in_disc()));
  }
}

Point Place::operator()(const Point& point) const {
  return offset_ + scale_ * (point.x() * along_ + point.y() * perpendicular(along_));
}

}  // namespace calligraphy_test
