#include <limits>

#include "measurement.hpp"
#include "reference_curve.hpp"

namespace nearest_point_benchmark {

void Reference::add(std::span<const ControlPoints> elements, std::span<const Point> queries, std::size_t stride) {
  Point low = elements[0][0], high = low;
  std::vector<calligraphy_test::ReferenceCurve> curves;
  for (const ControlPoints& points : elements) {
    curves.emplace_back(points);
    for (const Point& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  }
  // A point has no size; its workload is generated at a scale of 1.
  const double size = high != low ? (high - low).norm() : 1.0;
  for (std::size_t i = (stride - queries_ % stride) % stride; i < queries.size(); i += stride) {
    long double distance = std::numeric_limits<long double>::infinity();
    for (const auto& curve : curves) distance = std::min(distance, curve.nearest(queries[i]).distance);
    entries_.push_back({queries_ + i, queries[i], distance, size});
  }
  queries_ += queries.size();
}

Errors Reference::errors(std::span<const Answer> answers, double allowed) const {
  Errors errors;
  for (const Entry& entry : entries_) {
    const Point& closest = answers[entry.query].point;
    const long double distance = std::hypot(static_cast<long double>(closest.x()) - entry.at.x(),
                                            static_cast<long double>(closest.y()) - entry.at.y());
    double error = static_cast<double>(std::abs(distance - entry.distance) / entry.size);
    if (!std::isfinite(error)) error = std::numeric_limits<double>::infinity();
    errors.largest = std::max(errors.largest, error);
    errors.wrong += error > 1e-3 ? 1.0 : 0.0;
    errors.beyond += error > allowed ? 1.0 : 0.0;
  }
  errors.wrong /= static_cast<double>(entries_.size());
  errors.beyond /= static_cast<double>(entries_.size());
  return errors;
}

}  // namespace nearest_point_benchmark
