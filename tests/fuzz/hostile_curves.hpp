// Families of curves that break nearest-point methods, of every degree, drawn at random.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <calligraphy/model/point.hpp>

#include "model/random_points.hpp"

namespace calligraphy_test {

using calligraphy::RandomPoints;
using calligraphy::Point;

struct CurveFamily {
  const char* name;
  /// Control points of a curve of the degree (2 to 4; a family may choose another), about as large as the unit square.
  std::vector<Point> (*draw)(RandomPoints&, int degree);
};

std::span<const CurveFamily> curve_families();

/// 10^x with x between `low` and `high`.
double magnitude(RandomPoints& random, double low, double high);
/// Zero in one case out of two, otherwise 1e-16 to 1e-4.
double slight(RandomPoints& random);
/// True in one case out of `count`.
bool one_in(RandomPoints& random, int count);

/// Transformation of a curve: mostly none; otherwise scaled by 1e-12 to 1e8, rotated, translated by up to 1e8 sizes; in
/// one case out of two by powers of two and representable numbers, so that exact ties remain ties.
class Place {
 public:
  explicit Place(RandomPoints& random);
  Point operator()(const Point& point) const;

 private:
  double scale_ = 1.0;
  Point along_ = {1.0, 0.0};
  Point offset_ = {0.0, 0.0};
};

}  // namespace calligraphy_test
