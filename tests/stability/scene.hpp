// The page on which the stability of the guidance is judged: one character, and the path of its first stroke.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "independent_hand.hpp"
#include "pen_path.hpp"

namespace calligraphy_test {

inline constexpr double page_width = 0.16, page_height = 0.12;  // [m]

/// One character in the middle of the page, its attraction factors multiplied.
inline calligraphy::PlacedCharacter in_the_middle(calligraphy::Character character, double attraction = 1.0) {
  for (double& factor : character.physics.attraction_factors) factor *= attraction;
  constexpr double em = 0.04;
  return {std::move(character), {{0.5 * (page_width - em), 0.5 * (page_height - em)}, em}};
}

/// A curve by arc length.
class StrokePath {
 public:
  StrokePath() = default;
  explicit StrokePath(const std::vector<Point>& points) : points_(points), arcs_{0.0} {
    for (std::size_t i = 1; i < points.size(); ++i) arcs_.push_back(arcs_.back() + (points[i] - points[i - 1]).norm());
  }
  StrokePath(const calligraphy::PlacedCharacter& placed, std::size_t stroke)
      : StrokePath(path_of(calligraphy::strokes(placed.character).at(stroke), placed.placement, 0.0002)) {}

  double length() const { return arcs_.back(); }
  Point at(double arc) const {
    if (points_.size() == 1) return points_.front();
    const auto above = std::upper_bound(arcs_.begin() + 1, arcs_.end() - 1, arc);
    const auto i = static_cast<std::size_t>(above - arcs_.begin());
    const double way = arcs_[i] - arcs_[i - 1];
    const double share = way > 0.0 ? std::clamp((arc - arcs_[i - 1]) / way, 0.0, 1.0) : 1.0;
    return points_[i - 1] + share * (points_[i] - points_[i - 1]);
  }

 private:
  std::vector<Point> points_;
  std::vector<double> arcs_;
};

/// Progress from 0 to 1 with minimum jerk.
inline double smooth_step(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * s * (10.0 - s * (15.0 - 6.0 * s));
}
/// Its derivative.
inline double smooth_slope(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return 30.0 * s * s * (1.0 - s) * (1.0 - s);
}

/// Smallest and largest value along each axis.
struct Extent {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vector3d& value) {
    low = low.cwiseMin(value);
    high = high.cwiseMax(value);
  }
  Vector3d size() const { return high.x() < low.x() ? Vector3d(Vector3d::Zero()) : Vector3d(high - low); }
};

}  // namespace calligraphy_test
