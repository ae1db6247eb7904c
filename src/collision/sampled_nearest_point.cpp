#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "approximate_nearest_point.hpp"
#include "curve_answer.hpp"
#include "refused_query.hpp"

namespace calligraphy {
namespace {

constexpr int max_samples = 64;
constexpr int max_refinements = 8;

/// Index of the sample that is nearest to the query. The squares of the distances compare like their bits, as they are
/// not negative; the index takes the place of their last ones.
template <int Degree>
std::uint32_t nearest_sample(const CurveElement& curve, const Point& query, const ParameterRange& range, int samples) {
  std::array<float, Degree> x, y;
  for (std::size_t k = 0; k < Degree; ++k) {
    x[k] = static_cast<float>(curve.coefficients[k].x());
    y[k] = static_cast<float>(curve.coefficients[k].y());
  }
  const float query_x = static_cast<float>(query.x()), query_y = static_cast<float>(query.y());
  const float begin = static_cast<float>(range.begin);
  const float step = static_cast<float>((range.end - range.begin) / (samples - 1));
  std::uint32_t nearest = ~std::uint32_t{0};
  for (int i = 0; i < samples; ++i) {
    const float t = begin + step * static_cast<float>(i);
    float at_x = x[Degree - 1] * t, at_y = y[Degree - 1] * t;
    for (std::size_t k = Degree - 1; k-- > 0;) {
      at_x = (at_x + x[k]) * t;
      at_y = (at_y + y[k]) * t;
    }
    const float square = (at_x - query_x) * (at_x - query_x) + (at_y - query_y) * (at_y - query_y);
    const std::uint32_t key =
        (std::bit_cast<std::uint32_t>(square) & ~std::uint32_t{max_samples - 1}) | static_cast<std::uint32_t>(i);
    nearest = std::min(nearest, key);
  }
  return nearest & (max_samples - 1);
}

template <int Degree>
NearestPoint sampled(const CurveElement& curve, const Point& query, const NearestPointOptions& options,
                     const ParameterRange& range) {
  const Coefficients& c = curve.coefficients;
  const int samples = std::clamp(options.samples, 2, max_samples);
  double t = range.begin + (range.end - range.begin) / (samples - 1) *
                               static_cast<double>(nearest_sample<Degree>(curve, query, range, samples));
  for (int k = 0; k < std::min(options.refinements, max_refinements); ++k) {
    const Point offset = place<Degree>(c, t) - query, velocity = first_derivative<Degree>(c, t),
                acceleration = second_derivative<Degree>(c, t);
    const double g = offset.dot(velocity), slope = velocity.squaredNorm() + offset.dot(acceleration);
    const double bend = 3.0 * velocity.dot(acceleration) + offset.dot(third_derivative<Degree>(c, t));
    const double moved = t - 2.0 * g * slope / (2.0 * slope * slope - g * bend);
    if (!(slope > 0.0 && std::isfinite(moved))) break;  // not towards a minimum
    t = std::clamp(moved, range.begin, range.end);
  }
  return curve_answer<Degree>(curve, std::clamp(t, range.begin, range.end), query, NearestPointStatus::approximate);
}

}  // namespace

NearestPoint sampled_nearest_point(const CurveElement& curve, const Point& query, const NearestPointOptions& options,
                                   const ParameterRange& range) noexcept {
  const Point relative = (query - curve.origin) * curve.per_size;
  if (!within_reach(relative)) return refused_query(curve, range);
  switch (curve.degree) {
    case 2:
      return sampled<2>(curve, relative, options, range);
    case 3:
      return sampled<3>(curve, relative, options, range);
    default:
      return sampled<4>(curve, relative, options, range);
  }
}

}  // namespace calligraphy
