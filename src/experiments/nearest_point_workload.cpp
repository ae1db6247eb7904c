#include "nearest_point_workload.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/bezier.hpp>

#include "base/require.hpp"
#include "model/random_points.hpp"
#include "stroke_queries.hpp"

namespace calligraphy {
namespace {

constexpr int curves_per_workload = 64;

using Curve = Bezier<3>;
using Vertices = std::array<Point, 4>;

Eigen::AlignedBox2d box_of(const Curve& curve) {
  Eigen::AlignedBox2d box;
  for (const Point& point : curve.control_points) box.extend(point);
  return box;
}

/// What a query is drawn from; a point, which has no size of its own, has size 1.
struct Target {
  Curve curve;
  double size;
  explicit Target(const Curve& of) : curve(of), size(box_of(of).sizes().norm()) {
    if (!(size > 0.0)) size = 1.0;
  }
};

double power_of_ten(int exponent) {
  double power = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) power *= 10.0;
  return exponent < 0 ? 1.0 / power : power;
}

/// Zero in one case out of four, otherwise 1e-15 to 1e-2.
double slight(RandomPoints& random) {
  const bool none = random.index(4) == 0;
  const int exponent = 2 + static_cast<int>(random.index(14));
  return none ? 0.0 : power_of_ten(-exponent);
}

Point perpendicular(const Point& vector) { return {-vector.y(), vector.x()}; }

/// The vertices turned, scaled by 0.5 to 2, mirrored in one case out of two, and moved.
Curve placed(RandomPoints& random, Vertices vertices) {
  const Point along = random.between(0.5, 2.0) * random.direction();
  const Point across = random.index(2) == 0 ? perpendicular(along) : -perpendicular(along);
  const Point offset = random.point(-1.0, 1.0);
  for (Point& vertex : vertices) vertex = offset + vertex.x() * along + vertex.y() * across;
  return {vertices};
}

Vertices moved_slightly(RandomPoints& random, Vertices vertices, double by) {
  for (Point& vertex : vertices) vertex += by * random.in_disc();
  return vertices;
}

// Curves. `i` counts the curves of a workload, so that every kind in a mixed one occurs.

Curve random_curve(RandomPoints& random, int) {
  Vertices vertices;
  for (Point& vertex : vertices) vertex = random.point(0.0, 1.0);
  return {vertices};
}

/// Strong bends on which a greedy subdivision takes the wrong branch.
Curve hook(RandomPoints& random, int i) {
  constexpr double bends[2][4][2] = {{{0.0, 0.0}, {1.2, 0.0}, {1.3, 0.1}, {0.9, 0.15}},
                                     {{0.4, 0.9}, {0.7, 0.05}, {0.75, 0.35}, {0.7, 0.65}}};
  Vertices vertices;
  for (std::size_t k = 0; k < 4; ++k) vertices[k] = Point(bends[i % 2][k][0], bends[i % 2][k][1]);
  return placed(random, moved_slightly(random, vertices, 0.03));
}

Curve loop(RandomPoints& random, int) {
  const Vertices vertices = {Point(0, 0), Point(1.5, 1), Point(-0.5, 1), Point(1, 0)};
  return placed(random, moved_slightly(random, vertices, 0.1));
}

/// B' = 3 ((1-t)^2 a + 2 t (1-t) b + t^2 c) vanishes at a chosen t: c follows from a and b.
Curve cusp(RandomPoints& random, int) {
  const double t = random.between(0.3, 0.7), s = 1.0 - t;
  const Point a = random.between(0.5, 1.0) * random.direction();
  const Point b = random.between(0.5, 1.0) * random.direction();
  const Point c = -(s * s * a + 2.0 * t * s * b) / (t * t);
  const Point start = random.point(0.0, 1.0);
  return {{start, start + a, start + a + b, start + a + b + c}};
}

/// In order, folded back, or beyond its own ends; a third of them parallel to an axis, where they are exact.
Curve collinear(RandomPoints& random, int i) {
  std::array<double, 4> at;
  for (double& value : at) value = random.between(-1.0, 1.0);
  if (i % 2 == 0) std::sort(at.begin(), at.end());
  const Point along = i % 3 == 0 ? Point(1.0, 0.0) : random.direction();
  const Point start = random.point(-1.0, 1.0);
  return {{start + at[0] * along, start + at[1] * along, start + at[2] * along, start + at[3] * along}};
}

/// Each pair of control points equal, then both handles, three of them, and all of them.
Curve degenerate(RandomPoints& random, int i) {
  Vertices v = random_curve(random, i).control_points;
  constexpr std::size_t pairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  const int kind = i % 10;
  if (kind < 6) v[pairs[kind][1]] = v[pairs[kind][0]];
  if (kind == 6) v[1] = v[0], v[2] = v[3];
  if (kind == 7) v[1] = v[2] = v[0];
  if (kind == 8) v[1] = v[2] = v[3];
  if (kind == 9) v[1] = v[2] = v[3] = v[0];
  return {v};
}

/// Bowed by 1e-2 to 1e-14.
Curve near_straight(RandomPoints& random, int i) {
  const double bow = power_of_ten(-2 - i % 13);
  return placed(random, {Point(0, 0), Point(random.between(0.2, 0.45), bow * random.between(-1.0, 1.0)),
                         Point(random.between(0.55, 0.8), bow), Point(1, 0)});
}

/// Arches that are their own mirror image about x = 0, to the last bit.
Curve symmetric(RandomPoints& random, int) {
  const double foot = random.between(0.2, 1.0), shoulder = random.between(-1.0, 1.0), height = random.between(0.3, 1.5);
  return {{Point(-foot, 0), Point(-shoulder, height), Point(shoulder, height), Point(foot, 0)}};
}

/// Its own image when turned by half a turn about the origin, to the last bit.
Curve symmetric_s(RandomPoints& random, int) {
  const Point end = random.point(0.3, 1.0);
  const double up = random.between(0.2, 1.5);
  const Point handle(random.between(-1.5, -0.2), up);
  return {{-end, -handle, handle, end}};
}

/// The usual cubic for an arc round the origin, 25 to 180 degrees. With T = tan(angle / 4) everything is rational.
Curve arc(RandomPoints& random, int) {
  const double tangent = random.between(0.11, 1.0), square = tangent * tangent;
  const double cosine = (1.0 - square) / (1.0 + square), sine = 2.0 * tangent / (1.0 + square);
  const double handle = 4.0 / 3.0 * tangent;
  const Point along = random.between(0.5, 2.0) * random.direction(), across = perpendicular(along);
  const auto at = [&](double x, double y) { return Point(x * along + y * across); };
  return {{at(cosine, -sine), at(cosine + handle * sine, -sine + handle * cosine),
           at(cosine + handle * sine, sine - handle * cosine), at(cosine, sine)}};
}

Curve scaled(Curve curve, double factor, const Point& offset) {
  for (Point& vertex : curve.control_points) vertex = offset + factor * vertex;
  return curve;
}

Curve large(RandomPoints& random, int i) { return scaled(random_curve(random, i), 1e8, Point::Zero()); }
Curve distant(RandomPoints& random, int i) { return scaled(random_curve(random, i), 1.0, {1e8, -1e8}); }
Curve small(RandomPoints& random, int i) { return scaled(random_curve(random, i), 1e-12, Point::Zero()); }

// Queries.

/// In the box of the control points, widened by a quarter of the size on each side.
Point in_box(RandomPoints& random, const Target& target) {
  const Eigen::AlignedBox2d box = box_of(target.curve);
  const Point margin = Point::Constant(0.25 * target.size);
  const Point share = random.point(0.0, 1.0);
  return (box.min() - margin) + share.cwiseProduct(box.sizes() + 2.0 * margin);
}

/// Within a tenth of the size.
Point near(RandomPoints& random, const Target& target) {
  const Point on = target.curve.point(random.next());
  return on + 0.1 * target.size * random.in_disc();
}

Point near_or_in_box(RandomPoints& random, const Target& target) {
  return random.index(2) == 0 ? near(random, target) : in_box(random, target);
}

/// 1 to 5 mm from a point of the curve.
Point of_pen(RandomPoints& random, const Target& target) {
  const Point on = target.curve.point(random.next());
  return on + random.between(0.001, 0.005) * random.direction();
}

Point on_curve(RandomPoints& random, const Target& target) {
  const std::uint64_t choice = random.index(32);
  const double t = random.next();
  return target.curve.point(choice == 0 ? 0.0 : choice == 1 ? 1.0 : t);
}

/// On the straight line through the curve, also beyond it, or anywhere.
Point along_line(RandomPoints& random, const Target& target) {
  if (random.index(2) == 0) return in_box(random, target);
  const Point from = target.curve.point(random.next()), to = target.curve.point(random.next());
  return from + random.between(-2.0, 3.0) * (to - from);
}

/// On the axis x = 0, where two closest points are equally near, or slightly beside it.
Point near_axis(RandomPoints& random, const Target& target) {
  if (random.index(4) == 0) return in_box(random, target);
  const double y = random.between(-1.5, 1.5) * target.size;
  return {slight(random) * target.size * random.between(-1.0, 1.0), y};
}

/// At the origin or slightly beside it.
Point near_origin(RandomPoints& random, const Target& target) {
  if (random.index(4) == 0) return in_box(random, target);
  return slight(random) * target.size * random.in_disc();
}

/// At a centre of curvature no further than ten sizes, or slightly beside it: three closest points coincide there.
Point near_centre_of_curvature(RandomPoints& random, const Target& target) {
  const Bezier<2> first = target.curve.hodograph();
  const Bezier<1> second = first.hodograph();
  for (int attempt = 0; attempt < 16; ++attempt) {
    const double t = random.next();
    const Point slope = first.point(t), bend = second.point(t);
    const double turn = slope.x() * bend.y() - slope.y() * bend.x();
    const Point radius = perpendicular(slope) * slope.squaredNorm();
    if (radius.norm() > 10.0 * target.size * std::abs(turn)) continue;
    return target.curve.point(t) + radius / turn + slight(random) * target.size * random.in_disc();
  }
  return in_box(random, target);
}

/// 1 to 1e6 sizes away, each power of ten equally often.
Point far(RandomPoints& random, const Target& target) {
  const double sizes = power_of_ten(static_cast<int>(random.index(6))) * random.between(1.0, 10.0);
  return target.curve.point(0.5) + sizes * target.size * random.direction();
}

struct Recipe {
  const char* name;
  Curve (*curve)(RandomPoints&, int);  ///< null: one of the real curves
  Point (*query)(RandomPoints&, const Target&);
  double allowed_error = 1e-9;
};

constexpr Recipe recipes[] = {
    {"random box", random_curve, in_box},
    {"random near", random_curve, near},
    {"real strokes near", nullptr, of_pen},
    {"real strokes box", nullptr, in_box},
    {"hook", hook, near_or_in_box},
    {"loop", loop, near_or_in_box},
    {"cusp", cusp, near_or_in_box},
    {"collinear", collinear, along_line},
    {"degenerate", degenerate, near_or_in_box},
    {"near straight", near_straight, near_or_in_box},
    {"symmetric", symmetric, near_axis},
    {"symmetric S", symmetric_s, near_origin},
    {"centre of curvature", random_curve, near_centre_of_curvature},
    {"arc centre", arc, near_origin},
    {"coordinates x 1e8", large, near_or_in_box},
    {"offset 1e8", distant, near_or_in_box, 1e-6},
    {"size 1e-12", small, near_or_in_box},
    {"far", random_curve, far},
    {"on the curve", random_curve, on_curve},
};

Curve as_cubic(const std::vector<Point>& points) {
  if (points.size() != 4) {
    throw ValueError("nearest_point_workloads: a real curve has " + std::to_string(points.size()) +
                     " control points, expected the 4 of a cubic");
  }
  return {{points[0], points[1], points[2], points[3]}};
}

}  // namespace

std::vector<NearestPointWorkload> nearest_point_workloads(std::span<const std::vector<Point>> real_curves, int queries,
                                                          std::uint64_t seed) {
  require_above_zero("queries", queries, "");
  if (real_curves.empty()) throw ValueError("nearest_point_workloads: no real curves");
  std::vector<NearestPointWorkload> workloads;
  RandomPoints seeds(seed);
  const int curve_count = std::min(queries, curves_per_workload);
  for (const Recipe& recipe : recipes) {
    NearestPointWorkload workload{recipe.name, {}, recipe.allowed_error};
    RandomPoints random(seeds.bits());
    for (int i = 0; i < curve_count; ++i) {
      const Target target(recipe.curve != nullptr ? recipe.curve(random, i)
                                                  : as_cubic(real_curves[random.index(real_curves.size())]));
      CurveQueries asked{{target.curve.control_points.begin(), target.curve.control_points.end()}, {}};
      const int count = queries / curve_count + (i < queries % curve_count ? 1 : 0);
      for (int k = 0; k < count; ++k) asked.queries.push_back(recipe.query(random, target));
      workload.curves.push_back(std::move(asked));
    }
    workloads.push_back(std::move(workload));
  }
  return workloads;
}

std::vector<std::vector<Point>> curve_control_points(std::span<const Character> characters, double em) {
  std::vector<std::vector<Point>> curves;
  for (const Character& character : characters) {
    if (character.curve_degree != 3) continue;
    for (const Stroke& stroke : strokes(character)) {
      for (std::vector<Point>& element : elements_of(stroke, em)) {
        if (element.size() == 4) curves.push_back(std::move(element));
      }
    }
  }
  return curves;
}

}  // namespace calligraphy
