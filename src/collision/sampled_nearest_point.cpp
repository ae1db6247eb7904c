#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "approximate_nearest_point.hpp"
#include "candidate.hpp"
#include "polish.hpp"
#include "refused_query.hpp"

namespace calligraphy {
namespace {

constexpr int max_samples = 64;
constexpr int block = 8;  // samples in parallel
using Lanes = float __attribute__((vector_size(4 * block)));
constexpr int max_refinements = 8;

/// Keeps the nearer sample of each lane.
[[gnu::always_inline]] inline void take_nearer(Lanes& least, Lanes& nearest, const Lanes& square, const Lanes& index) {
  const auto nearer = square < least;
  least = nearer ? square : least;
  nearest = nearer ? index : nearest;
}

/// Index of the sample nearest to the query, by |B|^2 - 2 q . B: the squared distance minus the square of the query, so
/// that a distant query loses no precision. Single precision makes this method fast.
template <int Degree>
[[gnu::always_inline]] inline int nearest_sample(const CurveElement& curve, Pair query, const ParameterRange& range,
                                                 int samples) {
  const float step = static_cast<float>((range.end - range.begin) / (samples - 1));
  const float twice_x = 2.0F * static_cast<float>(query[0]), twice_y = 2.0F * static_cast<float>(query[1]);
  const Lanes last = static_cast<float>(samples - 1) + Lanes{};
  Lanes index = {0, 1, 2, 3, 4, 5, 6, 7};
  Lanes least = std::numeric_limits<float>::infinity() + Lanes{}, nearest = {};
  for (int first = 0; first < samples; first += block, index += block) {
    const Lanes i = index < last ? index : last;  // beyond the last sample, repeats it
    const Lanes t = static_cast<float>(range.begin) + step * i;
    Lanes x = static_cast<float>(curve.coefficients[Degree - 1].x()) * t;
    Lanes y = static_cast<float>(curve.coefficients[Degree - 1].y()) * t;
    for (std::size_t k = Degree - 1; k-- > 0;) {
      x = (x + static_cast<float>(curve.coefficients[k].x())) * t;
      y = (y + static_cast<float>(curve.coefficients[k].y())) * t;
    }
    const Lanes square = x * (x - twice_x) + y * (y - twice_y);
    take_nearer(least, nearest, square, i);
  }
  // Compares halves without branches, which would be unpredictable.
  take_nearer(least, nearest, __builtin_shufflevector(least, least, 4, 5, 6, 7, 0, 1, 2, 3),
              __builtin_shufflevector(nearest, nearest, 4, 5, 6, 7, 0, 1, 2, 3));
  take_nearer(least, nearest, __builtin_shufflevector(least, least, 2, 3, 0, 1, 6, 7, 4, 5),
              __builtin_shufflevector(nearest, nearest, 2, 3, 0, 1, 6, 7, 4, 5));
  take_nearer(least, nearest, __builtin_shufflevector(least, least, 1, 0, 3, 2, 5, 4, 7, 6),
              __builtin_shufflevector(nearest, nearest, 1, 0, 3, 2, 5, 4, 7, 6));
  return static_cast<int>(nearest[0]);
}

/// Halley's method, kept between the neighbours of the sample; a step that does not come nearer is rejected.
template <int Degree>
[[gnu::always_inline]] inline NearestPoint refined(const CurveElement& curve, Pair query,
                                                   const NearestPointOptions& options, const ParameterRange& range) {
  const int samples = std::clamp(options.samples, 2, max_samples);
  const double spacing = (range.end - range.begin) / (samples - 1);
  const double sample = range.begin + spacing * nearest_sample<Degree>(curve, query, range, samples);
  const double low = std::max(sample - spacing, range.begin), high = std::min(sample + spacing, range.end);
  Candidate best = candidate<Degree>(curve, query, std::min(sample, range.end));
  if (options.refinements <= 0) return curve_answer(curve, best, NearestPointStatus::approximate);
  const SlopePolynomial<Degree> polynomial(curve, query);
  double t = best.t;
  for (int k = 0; k < std::min(options.refinements, max_refinements); ++k) {
    const auto value = polynomial.at(t);
    const double slope_square = value.slope * value.slope;
    t = std::clamp(t - value.g * value.slope / (slope_square - 0.5 * value.g * value.bend), low, high);
  }
  const Candidate next = candidate<Degree>(curve, query, t);
  if (dot(next.offset, next.offset) <= dot(best.offset, best.offset)) best = next;
  return curve_answer(curve, best, NearestPointStatus::approximate);
}

using RefinedMethod = NearestPoint (*)(const CurveElement&, Pair, const NearestPointOptions&, const ParameterRange&);

template <int Degree>
NearestPoint refined_baseline(const CurveElement& curve, Pair query, const NearestPointOptions& options,
                              const ParameterRange& range) {
  return refined<Degree>(curve, query, options, range);
}

#if defined(__SSE2__)
template <int Degree>
[[gnu::target("avx2")]] NearestPoint refined_avx2(const CurveElement& curve, Pair query,
                                                  const NearestPointOptions& options, const ParameterRange& range) {
  return refined<Degree>(curve, query, options, range);
}
#endif

/// Indexed by degree minus 2. Holds the baseline until the processor has been detected at program start.
constinit std::array<RefinedMethod, 3> refined_methods = {refined_baseline<2>, refined_baseline<3>,
                                                          refined_baseline<4>};

#if defined(__SSE2__)
[[maybe_unused]] const bool refined_chosen = [] {
  if (__builtin_cpu_supports("avx2")) refined_methods = {refined_avx2<2>, refined_avx2<3>, refined_avx2<4>};
  return true;
}();
#endif

}  // namespace

NearestPoint sampled_nearest_point(const CurveElement& curve, const Point& query, const NearestPointOptions& options,
                                   const ParameterRange& range) noexcept {
  const Pair relative = in_sizes(curve, query);
  if (!within_reach(relative)) return refused_query(curve, range);
  return refined_methods[static_cast<std::size_t>(curve.degree - 2)](curve, relative, options, range);
}

}  // namespace calligraphy
