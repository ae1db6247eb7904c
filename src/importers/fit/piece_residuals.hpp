// Pieces of a path as lines and curves of constant speed; private to the importers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

/// Residuals of pieces of a path from their least-squares polynomials, each in constant time from prefix sums. The
/// points of the path are evenly spaced, and the polynomials are functions of arc length, so that a piece that doubles
/// back is not a line, although all of it lies on one.
class PieceResiduals {
 public:
  explicit PieceResiduals(std::span<const Point> path);

  /// Sum of squared distances of points `first` to `last`, both included, from their polynomial of degree 1 or 3
  /// [em^2].
  double residual(std::size_t first, std::size_t last, int degree) const;

 private:
  /// Sums of the coordinates times powers of the position, and of the squared norms.
  struct Moments {
    Point of_power[4] = {Point::Zero(), Point::Zero(), Point::Zero(), Point::Zero()};
    double squared = 0.0;
  };
  double count_;
  std::vector<Moments> before_;  ///< of all points before an index
};

}  // namespace calligraphy::recognition
