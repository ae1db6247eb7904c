#include "shoulder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "direction_range.hpp"

namespace calligraphy::recognition {
namespace {

constexpr double max_shoulder = 0.1;  // [em], along the path: maximum length of a heng's press
constexpr double farthest_corner =
    0.04;                               // [em], from the path: half a brush width, so that the corner is within the ink
constexpr double limb_length = 0.12;    // [em], over which the direction of a limb is measured
constexpr double min_limb = 0.03;       // [em]
constexpr double slightest_turn = 8.0;  // [degree]; a vertex that turns by less belongs to a limb
constexpr double price_of_length = 400.0;   // [degree/em], of a shoulder
constexpr Range right_turn{-165.0, -60.0};  // [degree]

/// Directions of the limbs before and after a shoulder [degree].
struct Limbs {
  Range before;
  Range after;
};
constexpr Limbs heng_turning_down{{-18.0, 35.0}, {-175.0, -60.0}};
constexpr Limbs shu_turning_to_hook{{-120.0, -70.0}, {125.0, 195.0}};

/// The first and last vertex of a turn, and its merit as a shoulder.
struct Shoulder {
  std::size_t first;
  std::size_t last;
  double merit;  ///< its turn, minus a penalty for its length [degree]
};

/// Turn at an inner vertex [degree], left positive.
double turn_at(const Path& path, std::size_t i) {
  return wrapped(direction_of(path[i + 1] - path[i]) - direction_of(path[i] - path[i - 1]));
}

/// The best shoulder that starts at a vertex: one that turns right throughout.
Shoulder shoulder_from(const Path& path, std::size_t first) {
  double length = 0.0;
  double turned = 0.0;
  Shoulder shoulder{first, first, 0.0};
  for (std::size_t i = first; i + 1 < path.size(); ++i) {
    if (i > first) length += (path[i] - path[i - 1]).norm();
    const double turn = turn_at(path, i);
    if (length > max_shoulder || turn > slightest_turn) break;
    if (turn < -slightest_turn) turned -= turn;
    const double merit = turned - length * price_of_length;
    if (merit > shoulder.merit) shoulder = {first, i, merit};
  }
  return shoulder;
}

/// Intersection of the limbs before and after, if they are the limbs of a shoulder.
std::optional<Point> corner_of(const Path& path, const Shoulder& shoulder) {
  const Point& first = path[shoulder.first];
  const Point& last = path[shoulder.last];
  const Point before = first - point_before(path, shoulder.first, limb_length);
  const Point after = point_after(path, shoulder.last, limb_length) - last;
  if (before.norm() < min_limb || after.norm() < min_limb) return std::nullopt;
  if (!contains(right_turn, wrapped(direction_of(after) - direction_of(before)))) return std::nullopt;
  const auto joins = [&](const Limbs& limbs) {
    return contains(limbs.before, direction_of(before)) && contains(limbs.after, direction_of(after));
  };
  if (!joins(heng_turning_down) && !joins(shu_turning_to_hook)) return std::nullopt;
  Eigen::Matrix2d directions;
  directions << before.normalized(), after.normalized();
  const Point lengths = directions.inverse() * (last - first);
  // The extended limbs meet after the first and before the second.
  if (lengths.minCoeff() < 0.0 || lengths.maxCoeff() > 0.3) return std::nullopt;
  const Point corner = first + lengths.x() * before.normalized();
  Point nearest = first;
  for (std::size_t i = shoulder.first; i < shoulder.last; ++i) {
    const Point closest = nearest_on_segment(corner, path[i], path[i + 1]);
    if ((corner - closest).norm() < (corner - nearest).norm()) nearest = closest;
  }
  const double distance = (corner - nearest).norm();
  return distance <= farthest_corner ? corner : Point(nearest + farthest_corner / distance * (corner - nearest));
}

}  // namespace

Path without_shoulders(const Path& path) {
  std::vector<Shoulder> shoulders;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    if (turn_at(path, i) >= -slightest_turn) continue;
    const Shoulder shoulder = shoulder_from(path, i);
    if (shoulder.last == shoulder.first) continue;
    if (shoulders.empty() || shoulders.back().last < shoulder.first) {
      shoulders.push_back(shoulder);
    } else if (shoulders.back().merit < shoulder.merit) {
      shoulders.back() = shoulder;  // the best of those that overlap
    }
  }
  Path result;
  std::size_t at = 0;
  for (const Shoulder& shoulder : shoulders) {
    const std::optional<Point> corner = corner_of(path, shoulder);
    if (!corner) continue;
    while (at < shoulder.first) result.push_back(path[at++]);
    result.push_back(*corner);
    at = shoulder.last + 1;
  }
  while (at < path.size()) result.push_back(path[at++]);
  return result;
}

}  // namespace calligraphy::recognition
