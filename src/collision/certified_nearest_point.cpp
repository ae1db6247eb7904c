#include "certified_nearest_point.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "candidate.hpp"
#include "curve_answer.hpp"
#include "minimum_search.hpp"
#include "polish.hpp"
#include "refused_query.hpp"
#include "slope_signs.hpp"

namespace calligraphy {
namespace {

__attribute__((noinline)) NearestPoint search_or_refuse(const CurveElement& curve, const Point& query, double tolerance,
                                                        const ParameterRange& range) {
  if (!within_reach(query)) return refused_query(curve, range);
  return search_minima(curve, query, tolerance, range);
}

/// Parameter between neighbouring ordinates of the cells.
template <int Degree>
constexpr double cell_ordinates = 1.0 / ((2 * Degree - 1) * (Degree < 4 ? 8 : 4));

/// Zero of the control polygon between an ordinate and the next.
template <int Count>
inline __attribute__((always_inline)) double polygon_zero(const SlopeOrdinates<Count>& ordinates, int change,
                                                          double per_ordinate, const Point& query) {
  const auto i = static_cast<std::size_t>(change);
  const float x = static_cast<float>(query.x()), y = static_cast<float>(query.y());
  const double before = slope_ordinate(ordinates, i, x, y), after = slope_ordinate(ordinates, i + 1, x, y);
  return (static_cast<double>(change) + before / (before - after)) * per_ordinate;
}

template <int Degree>
inline __attribute__((always_inline)) NearestPoint answer_within(const CurveElement& curve, const Polished& found,
                                                                 const Point& query, const ParameterRange& range) {
  if (found.t >= range.begin && found.t <= range.end) {
    return curve_answer(curve, found.t, found.place, found.offset, found.velocity, NearestPointStatus::certified);
  }
  return curve_answer<Degree>(curve, std::clamp(found.t, range.begin, range.end), query, NearestPointStatus::certified);
}

/// Several changes of sign, all certain, on the whole curve: each cell with one change from - to + holds one minimum.
/// The nearest of them and of the ends is the answer.
template <int Degree>
inline __attribute__((always_inline)) bool nearest_of_several(const CurveElement& curve, const SlopeSigns& signs,
                                                              std::uint64_t changes, const Point& query,
                                                              double tolerance, Candidate& best) {
  constexpr int per_cell = 2 * Degree - 1;
  best = candidate<Degree>(curve, query, 0.0);
  const std::uint64_t last = std::uint64_t{1} << (CurveElement::max_ordinates - 1);
  int cell = -1;
  while (changes != 0) {
    const int change = std::countr_zero(changes);
    changes &= changes - 1;
    if (change / per_cell == cell) return false;  // two in one cell
    cell = change / per_cell;
    if (!((signs.negative >> change) & 1U)) continue;  // from + to -: a maximum
    const Polished found =
        polish<Degree>(curve, query, polygon_zero(curve.ordinates, change, cell_ordinates<Degree>, query), tolerance);
    constexpr double width = per_cell * cell_ordinates<Degree>;
    if (!(found.converged && found.t >= cell * width && found.t <= (cell + 1) * width)) return false;
    const Candidate next{found.t, found.place, found.offset, found.velocity, found.offset.squaredNorm()};
    if (nearer(next, best)) best = next;
  }
  if (signs.negative & last) {
    const Candidate end = candidate<Degree>(curve, query, 1.0);
    if (nearer(end, best)) best = end;
  }
  return true;
}

/// With every sign certain, no change says that the nearest point is an end; one change from - to +, that there is one
/// minimum, between these ordinates.
template <int Degree>
inline __attribute__((always_inline)) NearestPoint from_signs(const CurveElement& curve, const SlopeSigns& signs,
                                                              const Point& query, double tolerance,
                                                              const ParameterRange& range) {
  if (signs.certain) {
    constexpr std::uint64_t all_changes = (std::uint64_t{1} << (CurveElement::max_ordinates - 1)) - 1;
    const std::uint64_t changes = (signs.negative ^ (signs.negative >> 1)) & all_changes;
    if ((changes & (changes - 1)) == 0 && (signs.negative & 1U) && changes != 0) {
      const Polished found = polish<Degree>(
          curve, query, polygon_zero(curve.ordinates, std::countr_zero(changes), cell_ordinates<Degree>, query),
          tolerance);
      if (found.converged && found.t >= 0.0 && found.t <= 1.0) {
        return answer_within<Degree>(curve, found, query, range);
      }
    } else if (changes == 0) {
      return curve_answer<Degree>(curve, (signs.negative & 1U) ? range.end : range.begin, query,
                                  NearestPointStatus::certified);
    } else if (range.begin <= 0.0 && range.end >= 1.0) {
      Candidate best;
      if (nearest_of_several<Degree>(curve, signs, changes, query, tolerance, best)) {
        return curve_answer(curve, best.t, best.place, best.offset, best.velocity, NearestPointStatus::certified);
      }
    }
  }
  return search_or_refuse(curve, query, tolerance, range);
}

struct Baseline {
  template <int Count>
  static SlopeSigns signs(const SlopeOrdinates<Count>& ordinates, float x, float y) {
#if defined(__SSE2__)
    return slope_signs_sse2(ordinates, x, y);
#else
    return slope_signs_portable(ordinates, x, y);
#endif
  }
};

using Query = NearestPoint (*)(const CurveElement&, const Point&, double, const ParameterRange&);

template <int Degree>
NearestPoint query_baseline(const CurveElement& curve, const Point& query, double tolerance,
                            const ParameterRange& range) {
  const SlopeSigns signs =
      Baseline::signs(curve.ordinates, static_cast<float>(query.x()), static_cast<float>(query.y()));
  return from_signs<Degree>(curve, signs, query, tolerance, range);
}

#if defined(__SSE2__)
template <int Degree>
__attribute__((target("avx2"))) NearestPoint query_avx2(const CurveElement& curve, const Point& query, double tolerance,
                                                        const ParameterRange& range) {
  const SlopeSigns signs =
      slope_signs_avx2(curve.ordinates, static_cast<float>(query.x()), static_cast<float>(query.y()));
  return from_signs<Degree>(curve, signs, query, tolerance, range);
}
#endif

/// By degree less 2. The baseline until the processor has been asked, when the program starts.
constinit std::array<Query, 3> queries = {query_baseline<2>, query_baseline<3>, query_baseline<4>};

#if defined(__SSE2__)
[[maybe_unused]] const bool chosen = [] {
  if (__builtin_cpu_supports("avx2")) queries = {query_avx2<2>, query_avx2<3>, query_avx2<4>};
  return true;
}();
#endif

/// `query` in sizes.
NearestPoint certified(const CurveElement& curve, const Point& query, double tolerance, const ParameterRange& range) {
  if (!within(query, furthest_for_signs)) return search_or_refuse(curve, query, tolerance, range);
  return queries[static_cast<std::size_t>(curve.degree - 2)](curve, query, tolerance, range);
}

template <int Degree>
NearestPoint tracked(const CurveElement& curve, const Point& query, double tolerance, const ParameterRange& range,
                     double start) {
  if (!within(query, furthest_for_signs)) return search_or_refuse(curve, query, tolerance, range);
  const SlopeSigns signs = Baseline::signs(curve.whole, static_cast<float>(query.x()), static_cast<float>(query.y()));
  constexpr std::uint64_t all_changes = (1U << (2 * Degree - 1)) - 1;
  const std::uint64_t changes = (signs.negative ^ (signs.negative >> 1)) & all_changes;
  if (signs.certain && (signs.negative & 1U) && changes != 0 && (changes & (changes - 1)) == 0) {
    const Polished found = polish<Degree>(curve, query, start, tolerance);
    if (found.converged && found.t >= 0.0 && found.t <= 1.0) return answer_within<Degree>(curve, found, query, range);
  }
  return certified(curve, query, tolerance, range);
}

}  // namespace

NearestPoint certified_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                     const ParameterRange& range) noexcept {
  return certified(curve, (query - curve.origin) * curve.per_size, tolerance, range);
}

NearestPoint tracked_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                   const ParameterRange& range, double start) noexcept {
  const Point relative = (query - curve.origin) * curve.per_size;
  switch (curve.degree) {
    case 2:
      return tracked<2>(curve, relative, tolerance, range, start);
    case 3:
      return tracked<3>(curve, relative, tolerance, range, start);
    default:
      return tracked<4>(curve, relative, tolerance, range, start);
  }
}

}  // namespace calligraphy
