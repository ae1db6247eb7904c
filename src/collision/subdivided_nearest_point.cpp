#include <algorithm>
#include <cmath>
#include <limits>

#include "approximate_nearest_point.hpp"
#include "refused_query.hpp"

namespace calligraphy {
namespace {

/// Whether an interval of the curve may hold a point whose distance is less than `distance` by more than epsilon. The
/// squared distance dips below the least of five even samples by at most its largest second derivative times the square
/// of their spacing over 8; all in sizes.
bool may_hide_nearer(const CurveElement& curve, double begin, double end, double least, double distance,
                     double epsilon) {
  double speed = 0.0, acceleration = 0.0;
  for (int k = 1; k <= curve.degree; ++k) {
    const double magnitude = curve.coefficients[static_cast<std::size_t>(k - 1)].norm();
    speed += k * magnitude;
    acceleration += k * (k - 1) * magnitude;
  }
  const double spacing = 0.25 * (end - begin);
  const double furthest = distance + speed * (end - begin);
  const double dip = 2.0 * (speed * speed + furthest * acceleration) * spacing * spacing / 8.0;
  const double allowed = std::max(distance - epsilon, 0.0);
  return least * least - dip < allowed * allowed;
}

}  // namespace

/// Wang 2006, sec. 4.3.2, as printed. The printed text names no rule for a tie, which is generic: the point between the
/// children belongs to both. Here it goes to the child with the nearer middle. Never certified.
NearestPoint subdivided_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                      const ParameterRange& range) noexcept {
  if (!within_reach((query - curve.origin) * curve.per_size)) return refused_query(curve, range);
  const double coordinates = std::max({curve.origin.cwiseAbs().maxCoeff(), curve.size, query.cwiseAbs().maxCoeff()});
  const double epsilon = std::max(tolerance * curve.size, 4.0 * std::numeric_limits<double>::epsilon() * coordinates);
  const auto distance = [&](const Point& point) { return (query - point).norm(); };

  double begin = range.begin, end = range.end;
  double begin_distance = distance(curve.point(begin)), end_distance = distance(curve.point(end));
  double middle = 0.5 * (begin + end);
  double middle_distance = distance(curve.point(middle));
  double left_distance = 0.0, right_distance = 0.0;
  Point left_middle, right_middle;
  bool stopped = false;
  for (int step = 0; step < 64 && !stopped; ++step) {
    left_middle = curve.point(0.5 * (begin + middle));
    right_middle = curve.point(0.5 * (middle + end));
    left_distance = distance(left_middle);
    right_distance = distance(right_middle);
    stopped = std::abs(left_distance - right_distance) < epsilon;
    if (stopped) break;
    const double left_smallest = std::min({begin_distance, left_distance, middle_distance});
    const double right_smallest = std::min({middle_distance, right_distance, end_distance});
    if (left_smallest < right_smallest || (left_smallest == right_smallest && left_distance <= right_distance)) {
      end = middle;
      end_distance = middle_distance;
      middle_distance = left_distance;
    } else {
      begin = middle;
      begin_distance = middle_distance;
      middle_distance = right_distance;
    }
    middle = 0.5 * (begin + end);
  }
  NearestPoint solution;
  solution.parameter = middle;
  solution.point = 0.5 * (left_middle + right_middle);
  solution.distance = distance(solution.point);
  solution.tangent = curve.tangent(middle);
  const double least =
      std::min({begin_distance, left_distance, middle_distance, right_distance, end_distance, solution.distance});
  const double scale = curve.per_size;
  const bool unsafe =
      !stopped || may_hide_nearer(curve, begin, end, least * scale, solution.distance * scale, 2.0 * epsilon * scale);
  solution.status = unsafe ? NearestPointStatus::unsafe_stop : NearestPointStatus::approximate;
  return solution;
}

}  // namespace calligraphy
