#include <algorithm>
#include <cmath>
#include <limits>

#include "approximate_nearest_point.hpp"
#include "certified_nearest_point.hpp"
#include "curve_derivatives.hpp"
#include "refused_query.hpp"

namespace calligraphy {
namespace {

/// Whether an interval of the curve may contain a point nearer than `distance` by more than epsilon. The squared
/// distance falls below the minimum of five equally spaced samples by at most its maximum second derivative times the
/// square of their spacing over 8; all in sizes.
bool may_hide_nearer(const CurveElement& curve, const ParameterRange& part, double least, double distance,
                     double epsilon) {
  double speed = 0.0, acceleration = 0.0;
  for (int k = 1; k <= curve.degree; ++k) {
    const double magnitude = curve.coefficients[static_cast<std::size_t>(k - 1)].norm();
    speed += k * magnitude;
    acceleration += k * (k - 1) * magnitude;
  }
  const double width = part.end - part.begin;
  const double furthest = distance + speed * width;
  const double dip = 2.0 * (speed * speed + furthest * acceleration) * width * width / (16.0 * 8.0);
  const double allowed = std::max(distance - epsilon, 0.0);
  return least * least - dip < allowed * allowed;
}

/// A point on the curve and its distance from the query.
struct RecordedSample {
  Pair point;
  double distance;
};

template <int Degree>
NearestPoint subdivided(const CurveElement& curve, const Point& query, double tolerance, const ParameterRange& range) {
  const Pair relative = in_sizes(curve, query);
  const double coordinates = std::max({curve.origin.cwiseAbs().maxCoeff(), curve.size, query.cwiseAbs().maxCoeff()});
  const double epsilon =
      std::max(tolerance, 4.0 * std::numeric_limits<double>::epsilon() * coordinates * curve.per_size);
  const auto distance_to = [&](Pair point) { return std::sqrt(dot(point - relative, point - relative)); };
  const auto sample = [&](double t) {
    const Pair point = place<Degree>(curve, t);
    return RecordedSample{point, distance_to(point)};
  };

  ParameterRange part = range;
  double t = 0.5 * (part.begin + part.end);
  RecordedSample begin = sample(part.begin), middle = sample(t), end = sample(part.end), left, right;
  bool stopped = false;
  for (int step = 0; step < 64; ++step) {
    left = sample(0.5 * (part.begin + t));
    right = sample(0.5 * (t + part.end));
    stopped = std::abs(left.distance - right.distance) < epsilon;
    if (stopped) break;
    const double left_min = std::min({begin.distance, left.distance, middle.distance});
    const double right_min = std::min({middle.distance, right.distance, end.distance});
    if (left_min < right_min || (left_min == right_min && left.distance <= right.distance)) {
      part.end = t;
      end = middle;
      middle = left;
    } else {
      part.begin = t;
      begin = middle;
      middle = right;
    }
    t = 0.5 * (part.begin + part.end);
  }
  const Pair solution = (left.point + right.point) * 0.5;
  const double distance = distance_to(solution);
  const double least = std::min({begin.distance, left.distance, middle.distance, right.distance, end.distance});
  // The bound decides most stops at low cost; where it does not, the interval is searched.
  const bool unsafe = !stopped || (may_hide_nearer(curve, part, least, distance, epsilon) &&
                                   certified_nearest_point(curve, query, tolerance, part).distance * curve.per_size <
                                       distance - epsilon);
  NearestPoint answer;
  answer.parameter = t;
  answer.point = curve.origin + curve.size * Point(solution[0], solution[1]);
  answer.distance = curve.size * distance;
  answer.tangent = curve.tangent(t);
  answer.status = unsafe ? NearestPointStatus::unsafe_stop : NearestPointStatus::approximate;
  return answer;
}

}  // namespace

/// Wang 2006, sec. 4.3.2, as printed. The paper gives no rule for a tie, which is the generic case: the point between
/// the children belongs to both. Here it goes to the child with the nearer midpoint. Never certified.
NearestPoint subdivided_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                      const ParameterRange& range) noexcept {
  if (!within_reach(in_sizes(curve, query))) return refused_query(curve, range);
  switch (curve.degree) {
    case 2:
      return subdivided<2>(curve, query, tolerance, range);
    case 3:
      return subdivided<3>(curve, query, tolerance, range);
    default:
      return subdivided<4>(curve, query, tolerance, range);
  }
}

}  // namespace calligraphy
