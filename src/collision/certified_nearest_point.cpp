#include "certified_nearest_point.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "candidate.hpp"
#include "follow.hpp"
#include "minimum_search.hpp"
#include "polish.hpp"
#include "refused_query.hpp"
#include "slope_cells.hpp"
#include "slope_signs.hpp"

namespace calligraphy {
namespace {

[[gnu::noinline]] NearestPoint search_or_refuse(const CurveElement& curve, Pair query, double tolerance,
                                                const ParameterRange& range) {
  if (!within_reach(query)) return refused_query(curve, range);
  return search_minima(curve, query, tolerance, range);
}

/// For a distance that falls, or grows, all along the curve.
template <int Degree>
[[gnu::always_inline]] inline NearestPoint end_of(const CurveElement& curve, bool falls, Pair query,
                                                  const ParameterRange& range) {
  return curve_answer(curve, candidate<Degree>(curve, query, falls ? range.end : range.begin),
                      NearestPointStatus::certified);
}

/// For a single minimum on the whole curve: the result is that minimum if it lies within the range, otherwise the
/// nearer end of the range.
template <int Degree>
[[gnu::always_inline]] inline NearestPoint answer_within(const CurveElement& curve, const Candidate& minimum,
                                                         Pair query, double tolerance, const ParameterRange& range) {
  const double t = minimum.t;
  if (t >= range.begin && t <= range.end) [[likely]] {
    return curve_answer(curve, minimum, NearestPointStatus::certified);
  }
  if (!(t >= 0.0 && t <= 1.0)) return search_or_refuse(curve, query, tolerance, range);
  const Candidate end = candidate<Degree>(curve, query, t < range.begin ? range.begin : range.end);
  return curve_answer(curve, end, NearestPointStatus::certified);
}

/// For a minimum that the first steps missed: the same steps from where they ended, or from the end of its cell.
template <int Degree>
[[gnu::always_inline]] inline Candidate polish_again(const CurveElement& curve,
                                                     const SlopePolynomial<Degree>& polynomial, Pair query, int change,
                                                     double t, Residue& residue) {
  const ParameterRange cell = cell_of<Degree>(change);
  return polish<Degree>(curve, polynomial, query, std::clamp(t, cell.begin, cell.end), residue);
}

/// The result of that for a single minimum on the whole curve.
template <int Degree>
[[gnu::noinline]] NearestPoint second_attempt(const CurveElement& curve, Pair query, int change, double t,
                                              double tolerance, const ParameterRange& range) {
  Residue residue;
  const SlopePolynomial<Degree> polynomial(curve, query);
  const Candidate found = polish_again<Degree>(curve, polynomial, query, change, t, residue);
  if (!residue.converged(curve, allowed_error<Degree>(tolerance))) {
    return search_or_refuse(curve, query, tolerance, range);
  }
  return answer_within<Degree>(curve, found, query, tolerance, range);
}

/// For several sign changes on the whole curve, all certain: each cell with one change from - to + contains one
/// minimum. The result is the nearest of these and the ends.
template <int Degree>
[[gnu::noinline]] NearestPoint nearest_of_several(const CurveElement& curve,
                                                  SlopeSigns<CurveElement::max_ordinates> signs, Pair query,
                                                  double tolerance, const ParameterRange& range) {
  const double allowed = allowed_error<Degree>(tolerance);
  if (!one_change_per_cell<Degree>(signs.changes())) return search_minima(curve, query, tolerance, range);
  const SlopePolynomial<Degree> polynomial(curve, query);
  Candidate best = candidate<Degree>(curve, query, 0.0);
  for (std::uint64_t left = signs.minima(); left != 0; left &= left - 1) {
    const int change = std::countr_zero(left);
    const double start = middles<Degree>[static_cast<std::size_t>(change + 1)];
    Residue residue;
    Candidate found = polish<Degree>(curve, polynomial, query, start, residue);
    if (!residue.converged(curve, allowed)) {
      found = polish_again<Degree>(curve, polynomial, query, change, found.t, residue);
    }
    if (!(residue.converged(curve, allowed) && in_cell<Degree>(change, found.t))) {
      return search_minima(curve, query, tolerance, range);
    }
    if (nearer(found, best)) best = found;
  }
  if (signs.last_negative()) {
    const Candidate end = candidate<Degree>(curve, query, 1.0);
    if (nearer(end, best)) best = end;
  }
  return curve_answer(curve, best, NearestPointStatus::certified);
}

/// With all signs certain, one change from - to + means that there is one minimum, between these ordinates; no change
/// means that an end is nearest.
template <int Degree>
[[gnu::always_inline]] inline NearestPoint from_signs(const CurveElement& curve,
                                                      SlopeSigns<CurveElement::max_ordinates> signs, Pair query,
                                                      double tolerance, const ParameterRange& range) {
  if (signs.certain) {
    if (signs.ascending()) {
      if (!signs.differ()) return end_of<Degree>(curve, signs.first_negative(), query, range);
      const double start = middles<Degree>[static_cast<std::size_t>(signs.first_negatives())];
      const double allowed = allowed_error<Degree>(tolerance);
      Residue residue;
      const Candidate found = polish<Degree>(curve, SlopePolynomial<Degree>(curve, query), query, start, residue);
      if (residue.converged(curve, allowed)) [[likely]] {
        return answer_within<Degree>(curve, found, query, tolerance, range);
      }
      return second_attempt<Degree>(curve, query, signs.first_negatives() - 1, found.t, tolerance, range);
    } else if (range.begin <= 0.0 && range.end >= 1.0) {
      return nearest_of_several<Degree>(curve, signs, query, tolerance, range);
    }
  }
  return search_or_refuse(curve, query, tolerance, range);
}

/// `query` is in metres in all of the following.
using CertifiedMethod = NearestPoint (*)(const CurveElement&, const Point&, double, const ParameterRange&);

template <int Degree>
NearestPoint certified_baseline(const CurveElement& curve, const Point& query, double tolerance,
                                const ParameterRange& range) {
  const Pair relative = in_sizes(curve, query);
  return from_signs<Degree>(curve, slope_signs(curve.ordinates, relative), relative, tolerance, range);
}

#if defined(__SSE2__)
template <int Degree>
[[gnu::target("avx2")]] NearestPoint certified_avx2(const CurveElement& curve, const Point& query, double tolerance,
                                                    const ParameterRange& range) {
  const Pair relative = in_sizes(curve, query);
  return from_signs<Degree>(curve, slope_signs_avx2(curve.ordinates, relative), relative, tolerance, range);
}
#endif

/// A second step, for a pen that moves fast.
template <int Degree>
[[gnu::noinline]] NearestPoint followed_again(const CurveElement& curve, const Point& query, double tolerance,
                                              const ParameterRange& range, double start) {
  const Pair relative = in_sizes(curve, query);
  Candidate found;
  if (follow<Degree>(curve, relative, start, allowed_error<Degree>(tolerance), found)) {
    return answer_within<Degree>(curve, found, relative, tolerance, range);
  }
  return certified_nearest_point(curve, query, tolerance, range);
}

/// From the signs of the whole curve.
template <int Degree>
[[gnu::always_inline]] inline NearestPoint tracked(const CurveElement& curve,
                                                   SlopeSigns<CurveElement::whole_ordinates> signs, const Point& query,
                                                   Pair relative, double tolerance, const ParameterRange& range,
                                                   double start) {
  if (signs.certain) {
    const std::uint64_t changes = signs.changes();
    if (changes == 0) return end_of<Degree>(curve, signs.first_negative(), relative, range);
    if (signs.first_negative() && (changes & (changes - 1)) == 0) {
      Candidate found;
      if (follow<Degree>(curve, relative, start, allowed_error<Degree>(tolerance), found)) {
        return answer_within<Degree>(curve, found, relative, tolerance, range);
      }
      if (std::abs(found.t - start) <= furthest_step) {
        return followed_again<Degree>(curve, query, tolerance, range, found.t);
      }
    }
  }
  return certified_nearest_point(curve, query, tolerance, range);
}

using TrackedMethod = NearestPoint (*)(const CurveElement&, const Point&, double, const ParameterRange&, double);

template <int Degree>
NearestPoint tracked_baseline(const CurveElement& curve, const Point& query, double tolerance,
                              const ParameterRange& range, double start) {
  const Pair relative = in_sizes(curve, query);
  return tracked<Degree>(curve, slope_signs(curve.whole, relative), query, relative, tolerance, range, start);
}

#if defined(__SSE2__)
template <int Degree>
[[gnu::target("avx2")]] NearestPoint tracked_avx2(const CurveElement& curve, const Point& query, double tolerance,
                                                  const ParameterRange& range, double start) {
  const Pair relative = in_sizes(curve, query);
  return tracked<Degree>(curve, slope_signs_avx2(curve.whole, relative), query, relative, tolerance, range, start);
}
#endif

// Indexed by degree minus 2. They hold the baseline until the processor has been detected at program start.
constinit std::array<CertifiedMethod, 3> certified_methods = {certified_baseline<2>, certified_baseline<3>,
                                                              certified_baseline<4>};
constinit std::array<TrackedMethod, 3> tracked_methods = {tracked_baseline<2>, tracked_baseline<3>,
                                                          tracked_baseline<4>};

#if defined(__SSE2__)
[[maybe_unused]] const bool certified_chosen = [] {
  if (__builtin_cpu_supports("avx2")) {
    certified_methods = {certified_avx2<2>, certified_avx2<3>, certified_avx2<4>};
    tracked_methods = {tracked_avx2<2>, tracked_avx2<3>, tracked_avx2<4>};
  }
  return true;
}();
#endif

}  // namespace

NearestPoint certified_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                     const ParameterRange& range) noexcept {
  return certified_methods[static_cast<std::size_t>(curve.degree - 2)](curve, query, tolerance, range);
}

NearestPoint tracked_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                   const ParameterRange& range, double start) noexcept {
  return tracked_methods[static_cast<std::size_t>(curve.degree - 2)](curve, query, tolerance, range, start);
}

}  // namespace calligraphy
