// Curves and queries that break nearest-point methods, shared by all tests of geometry.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <calligraphy/model/point.hpp>

#include "model/random_points.hpp"

namespace calligraphy_test {

using calligraphy::Point;
using Sequence = calligraphy::RandomPoints;

struct HardCurve {
  std::string name;
  std::vector<Point> control_points;
  double tolerance = 1e-9;  ///< allowed error of a distance, relative to the size
};

inline double size_of(const std::vector<Point>& points) {
  Point low = points[0], high = points[0];
  for (const Point& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm();
}

inline std::vector<Point> moved(std::vector<Point> points, double scale, const Point& offset) {
  for (Point& point : points) point = offset + scale * point;
  return points;
}

/// Degrees 1 to 4, sizes from 1e-12 to 1e8, offsets to 1e8.
inline std::vector<HardCurve> hard_curves() {
  std::vector<HardCurve> curves = {
      {"line", {{0.1, 0.2}, {0.9, 0.7}}},
      {"horizontal line", {{0, 0}, {1, 0}}},
      {"point as a line", {{0.3, 0.4}, {0.3, 0.4}}},
      {"parabola", {{0, 0}, {0.5, 1}, {1, 0}}},
      {"hairpin quadratic", {{0, 0}, {1, 0.01}, {0, 0.02}}},
      {"folded line as a quadratic", {{0, 0}, {1, 0}, {0.2, 0}}},
      {"point as a quadratic", {{1, 1}, {1, 1}, {1, 1}}},
      {"arch", {{0, 0}, {0, 1}, {1, 1}, {1, 0}}},
      {"hook", {{0, 0}, {1.2, 0}, {1.3, 0.1}, {0.9, 0.15}}},
      {"strong bend", {{0.4, 0.9}, {0.7, 0.05}, {0.75, 0.35}, {0.7, 0.65}}},
      {"loop", {{0, 0}, {1.5, 1}, {-0.5, 1}, {1, 0}}},
      {"cusp", {{0, 0}, {1, 1}, {0, 1}, {1, 0}}},
      {"cusp of a hairpin", {{0, 0}, {1, 0}, {1, 0}, {0, 1e-3}}},
      {"collinear", {{0, 0}, {1, 0}, {2, 0}, {3, 0}}},
      {"collinear, uneven", {{0, 0}, {0.9, 0.45}, {0.1, 0.05}, {1, 0.5}}},
      {"collinear, beyond its ends", {{0.3, 0.3}, {-1, -1}, {2, 2}, {0.7, 0.7}}},
      {"all control points equal", {{0.3, 0.7}, {0.3, 0.7}, {0.3, 0.7}, {0.3, 0.7}}},
      {"P0 = P1", {{0, 0}, {0, 0}, {1, 1}, {1, 0}}},
      {"P2 = P3", {{0, 0}, {0.2, 1}, {1, 0}, {1, 0}}},
      {"P0 = P1 and P2 = P3", {{0, 0}, {0, 0}, {1, 0.5}, {1, 0.5}}},
      {"P0 = P1 = P2", {{0, 0}, {0, 0}, {0, 0}, {1, 0.5}}},
      {"P1 = P2 = P3", {{0, 0}, {1, 0.5}, {1, 0.5}, {1, 0.5}}},
      {"closed", {{0, 0}, {1, 1}, {-1, 1}, {0, 0}}},
      {"there and back", {{0, 0}, {1, 0}, {1, 0}, {0, 0}}},
      {"symmetric S", {{0, 0}, {1, 0}, {0, 1}, {1, 1}}},
      {"quarter of a circle", {{1, 0}, {1, 0.5522847498307936}, {0.5522847498307936, 1}, {0, 1}}},
      {"quartic", {{0, 0}, {0.3, 1}, {0.5, -1}, {0.8, 1}, {1, 0}}},
      {"quartic loop", {{0, 0}, {2, 1}, {0.5, 2}, {-1, 1}, {1, 0}}},
      {"quartic that is a cubic", {{0, 0}, {0, 0.75}, {0.5, 1}, {1, 0.75}, {1, 0}}},
      {"quartic, P0 = P1, P3 = P4", {{0, 0}, {0, 0}, {0.5, 1}, {1, 0}, {1, 0}}},
      {"point as a quartic", {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}},
  };
  for (const double bow : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    curves.push_back({"near straight " + std::to_string(std::log10(bow)), {{0, 0}, {0.3, bow}, {0.7, -bow}, {1, 0}}});
  }
  Sequence random(2006);
  for (const std::size_t count : {3u, 4u, 4u, 4u, 4u, 4u, 4u, 5u, 5u}) {
    HardCurve curve{"random " + std::to_string(curves.size()), {}};
    for (std::size_t i = 0; i < count; ++i) curve.control_points.push_back(random.point(0.0, 1.0));
    curves.push_back(curve);
  }
  const std::vector<HardCurve> plain = curves;
  for (const HardCurve& curve : plain) {
    if (curve.name.starts_with("random") || curve.name == "hook" || curve.name == "loop" || curve.name == "line") {
      curves.push_back({curve.name + ", size 1e-12", moved(curve.control_points, 1e-12, {0, 0})});
      curves.push_back({curve.name + ", size 1e8", moved(curve.control_points, 1e8, {0, 0})});
      curves.push_back({curve.name + ", offset 1e8", moved(curve.control_points, 1.0, {1e8, -1e8}), 1e-6});
    }
  }
  return curves;
}

/// Near, far, on the control polygon, and where many distances are equal: centres, axes of symmetry, control points.
inline std::vector<Point> hard_queries(const HardCurve& curve, int random_count = 24) {
  const auto& points = curve.control_points;
  const double size = std::max(size_of(points), 1e-12);
  Point centre = Point::Zero();
  for (const Point& point : points) centre += point / static_cast<double>(points.size());
  std::vector<Point> queries(points.begin(), points.end());
  queries.push_back(centre);
  queries.push_back(0.5 * (points.front() + points.back()));
  queries.push_back(points.front() + Point(0.0, 0.4 * size));
  queries.push_back(centre + Point(0.0, -0.25 * size));
  for (const double far : {3.0, 1e3, 1e6}) {
    queries.push_back(centre + far * size * Point(0.6, -0.8));
    queries.push_back(centre + far * size * Point(0.0, 1.0));
  }
  Sequence random(points.size());
  for (int i = 0; i < random_count; ++i) queries.push_back(centre + size * random.point(-0.8, 0.8));
  return queries;
}

}  // namespace calligraphy_test
