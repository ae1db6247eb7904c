#include <algorithm>
#include <array>
#include <cstddef>

#include "approximate_nearest_point.hpp"
#include "candidate.hpp"
#include "polish.hpp"
#include "refused_query.hpp"

namespace calligraphy {
namespace {

constexpr int max_samples = 64;
constexpr int block = 8;  // samples side by side
constexpr int max_refinements = 8;

/// Index of the sample that is nearest to the query, by |B|^2 - 2 q . B: the square of the distance less that of the
/// query, so that a far query loses no digits. In single precision, which is what is fast about this method; plain
/// loops that the compiler turns into wide instructions.
template <int Degree>
[[gnu::always_inline]] inline int nearest_sample(const CurveElement& curve, Pair query, const ParameterRange& range,
                                                 int samples) {
  const float step = static_cast<float>((range.end - range.begin) / (samples - 1));
  const float begin = static_cast<float>(range.begin);
  const float query_x = static_cast<float>(query[0]), query_y = static_cast<float>(query[1]);
  std::array<float, Degree> x, y;
  for (std::size_t k = 0; k < Degree; ++k) {
    x[k] = static_cast<float>(curve.coefficients[k].x());
    y[k] = static_cast<float>(curve.coefficients[k].y());
  }
  std::array<float, max_samples> squares;
  for (int first = 0; first < samples; first += block) {
    for (int i = first; i < first + block; ++i) {
      const float t = begin + step * static_cast<float>(i);
      float at_x = x[Degree - 1] * t, at_y = y[Degree - 1] * t;
      for (std::size_t k = Degree - 1; k-- > 0;) {
        at_x = (at_x + x[k]) * t;
        at_y = (at_y + y[k]) * t;
      }
      squares[static_cast<std::size_t>(i)] = at_x * (at_x - 2.0F * query_x) + at_y * (at_y - 2.0F * query_y);
    }
  }
  int nearest = 0;
  float least = squares[0];
  for (int i = 1; i < samples; ++i) {
    const float square = squares[static_cast<std::size_t>(i)];
    nearest = square < least ? i : nearest;
    least = square < least ? square : least;
  }
  return nearest;
}

/// Halley's method, kept between the neighbours of the sample; a step that does not come nearer is not taken.
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
    t = std::clamp(t - value.g * value.slope / (slope_square - value.g * value.half_bend), low, high);
  }
  const Candidate next = candidate<Degree>(curve, query, t);
  if (dot(next.offset, next.offset) <= dot(best.offset, best.offset)) best = next;
  return curve_answer(curve, best, NearestPointStatus::approximate);
}

using Method = NearestPoint (*)(const CurveElement&, Pair, const NearestPointOptions&, const ParameterRange&);

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

/// By degree less 2. The baseline until the processor has been asked, when the program starts.
constinit std::array<Method, 3> methods = {refined_baseline<2>, refined_baseline<3>, refined_baseline<4>};

#if defined(__SSE2__)
[[maybe_unused]] const bool chosen = [] {
  if (__builtin_cpu_supports("avx2")) methods = {refined_avx2<2>, refined_avx2<3>, refined_avx2<4>};
  return true;
}();
#endif

}  // namespace

NearestPoint sampled_nearest_point(const CurveElement& curve, const Point& query, const NearestPointOptions& options,
                                   const ParameterRange& range) noexcept {
  const Pair relative = in_sizes(curve, query);
  if (!within_reach(relative)) return refused_query(curve, range);
  return methods[static_cast<std::size_t>(curve.degree - 2)](curve, relative, options, range);
}

}  // namespace calligraphy
