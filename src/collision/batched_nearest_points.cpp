#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "candidate.hpp"
#include "certified_nearest_point.hpp"
#include "polish.hpp"
#include "slope_cells.hpp"
#include "slope_signs.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t block_size = 64;
constexpr std::size_t lanes = 4;  // doubles in the widest SIMD register used

using Signs = SlopeSigns<CurveElement::max_ordinates>;

/// Minima to be refined, one array per quantity: loops over them vectorise.
template <int Degree>
struct alignas(64) Minima {
  static constexpr std::size_t capacity = Degree * block_size;  ///< g has no more minima than that
  using Quantity = std::array<double, capacity>;

  std::size_t count = 0;
  Quantity query_x, query_y, t, bend;
  Quantity place_x, place_y, offset_x, offset_y, velocity_x, velocity_y;
  Quantity point_x, point_y, distance, tangent_x, tangent_y;
  Quantity refined;  ///< 1 or 0: converged within the curve, where the velocity shows a direction

  /// `ordinate`: the first one after the minimum.
  [[gnu::always_inline]] void set(std::size_t i, Pair query, int ordinate) {
    query_x[i] = query[0];
    query_y[i] = query[1];
    t[i] = middles<Degree>[static_cast<std::size_t>(ordinate)];
  }

  [[gnu::always_inline]] Candidate candidate(std::size_t i) const {
    return {t[i], Pair{place_x[i], place_y[i]}, Pair{offset_x[i], offset_y[i]}, Pair{}};
  }
  [[gnu::always_inline]] void write(std::size_t i, NearestPoint& result) const {
    result.parameter = t[i];
    result.point = Point(point_x[i], point_y[i]);
    result.distance = distance[i];
    result.tangent = Point(tangent_x[i], tangent_y[i]);
    result.status = NearestPointStatus::certified;
  }
};

/// Performs the operations of a single query in the same order, so the results are the same to the last bit.
template <int Degree>
[[gnu::always_inline]] inline void refine(const CurveElement& curve, double tolerance, Minima<Degree>& minima) {
  const double allowed = allowed_error<Degree>(tolerance);
  const std::size_t count = (minima.count + lanes - 1) / lanes * lanes;
  for (std::size_t i = minima.count; i < count; ++i) {  // fills the last register
    minima.query_x[i] = minima.query_x[0];
    minima.query_y[i] = minima.query_y[0];
    minima.t[i] = minima.t[0];
  }
  // Three short loops, so that a processor overlaps many of their iterations.
  for (std::size_t i = 0; i < count; ++i) {
    const Coordinates query = {minima.query_x[i], minima.query_y[i]};
    minima.t[i] = approach<Degree>(SlopePolynomial<Degree>(curve, query), minima.t[i], minima.bend[i]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Coordinates query = {minima.query_x[i], minima.query_y[i]};
    Residue residue;
    const auto at =
        settle<Degree>(curve, SlopePolynomial<Degree>(curve, query), query, minima.t[i], minima.bend[i], residue);
    minima.t[i] = at.t;
    minima.place_x[i] = at.place.x;
    minima.place_y[i] = at.place.y;
    minima.offset_x[i] = at.offset.x;
    minima.offset_y[i] = at.offset.y;
    minima.velocity_x[i] = at.velocity.x;
    minima.velocity_y[i] = at.velocity.y;
    const bool converged = residue.converged_without_branches(curve, allowed);
    const bool inside = (at.t >= 0.0) & (at.t <= 1.0);
    minima.refined[i] = (converged & inside) ? 1.0 : 0.0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Coordinates place = {minima.place_x[i], minima.place_y[i]}, offset = {minima.offset_x[i], minima.offset_y[i]},
                      velocity = {minima.velocity_x[i], minima.velocity_y[i]};
    const double square = dot(velocity, velocity), speed = std::sqrt(square);
    const Coordinates point = vector_of<Coordinates>(curve.origin) + place * curve.size;
    const Coordinates tangent = velocity * (speed * (1.0 / square));
    minima.point_x[i] = point.x;
    minima.point_y[i] = point.y;
    minima.distance[i] = curve.size * std::sqrt(dot(offset, offset));
    minima.tangent_x[i] = tangent.x;
    minima.tangent_y[i] = tangent.y;
    minima.refined[i] = speed > min_speed ? minima.refined[i] : 0.0;
  }
}

/// An end of the curve.
struct End {
  Candidate candidate;
  NearestPoint answer;  ///< except the distance

  [[gnu::always_inline]] void move_to(Pair query) { candidate.offset = candidate.place - query; }
  [[gnu::always_inline]] void write(const CurveElement& curve, NearestPoint& result) const {
    result = answer;
    result.distance = curve.size * std::sqrt(dot(candidate.offset, candidate.offset));
  }
};

template <int Degree>
[[gnu::always_inline]] inline End end_at(const CurveElement& curve, double t) {
  const Candidate at = candidate<Degree>(curve, Pair{}, t);
  return {at, curve_answer(curve, at, NearestPointStatus::certified)};
}

/// At most `block_size` queries, sorted by their signs without a branch, which a processor would often predict wrongly.
template <int Degree>
struct Block {
  std::array<Pair, block_size> queries;
  std::array<Signs, block_size> signs;
  std::array<std::uint32_t, block_size> single;  ///< queries with one minimum, in the order of `minima`
  std::array<std::uint32_t, block_size> rest;
  Minima<Degree> minima;

  /// Returns whether the query has a single minimum, after `singles` others.
  [[gnu::always_inline]] bool set(std::size_t i, std::size_t singles, Pair query, const Signs& its_signs) {
    queries[i] = query;
    signs[i] = its_signs;
    minima.set(singles, query, its_signs.first_negatives());
    single[singles] = static_cast<std::uint32_t>(i);
    rest[i - singles] = static_cast<std::uint32_t>(i);
    return its_signs.certain & its_signs.one_minimum();
  }
};

/// The nearest of the ends and those minima from `first` to `last` - 1 wins.
struct Contest {
  std::uint32_t query, first, last;
};

/// Returns whether the result is known: all of the minima were refined.
template <int Degree>
[[gnu::always_inline]] inline bool answer_contest(const CurveElement& curve, const Block<Degree>& block,
                                                  const Contest& contest, End& start, End& end, NearestPoint& result) {
  const Minima<Degree>& minima = block.minima;
  const Signs& signs = block.signs[contest.query];
  start.move_to(block.queries[contest.query]);
  end.move_to(block.queries[contest.query]);
  if (signs.changes() == 0) {
    (signs.first_negative() ? end : start).write(curve, result);
    return true;
  }
  Candidate best = start.candidate;
  std::size_t nearest = minima.count;  // none of them
  bool refined = true;
  std::uint64_t left = signs.minima();
  for (std::size_t k = contest.first; k < contest.last; ++k, left &= left - 1) {
    const Candidate found = minima.candidate(k);
    refined = refined && minima.refined[k] != 0.0 && in_cell<Degree>(std::countr_zero(left), found.t);
    if (nearer(found, best)) {
      best = found;
      nearest = k;
    }
  }
  if (!refined) return false;
  if (signs.last_negative() && nearer(end.candidate, best)) {
    end.write(curve, result);
  } else if (nearest < minima.count) {
    minima.write(nearest, result);
  } else {
    start.write(curve, result);
  }
  return true;
}

template <int Degree>
[[gnu::always_inline]] inline void answer_block(const CurveElement& curve, Block<Degree>& block,
                                                std::size_t singles, std::span<const Point> queries,
                                                std::span<NearestPoint> results, double tolerance) {
  Minima<Degree>& minima = block.minima;
  minima.count = singles;
  const auto answer_alone = [&](std::size_t i) {
    results[i] = certified_nearest_point(curve, queries[i], tolerance, {});
  };
  std::array<Contest, block_size> contests;
  std::size_t contest_count = 0;
  for (const std::uint32_t i : std::span(block.rest).first(queries.size() - singles)) {
    const Signs& signs = block.signs[i];
    std::uint64_t left = signs.minima();
    if (!(signs.certain && one_change_per_cell<Degree>(signs.changes()) && std::popcount(left) <= Degree)) {
      answer_alone(i);
      continue;
    }
    const std::size_t first = minima.count;
    for (; left != 0; left &= left - 1) {
      minima.set(minima.count++, block.queries[i], std::countr_zero(left) + 1);
    }
    contests[contest_count++] = {i, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(minima.count)};
  }
  refine<Degree>(curve, tolerance, minima);

  for (std::size_t k = 0; k < singles; ++k) {
    const std::uint32_t i = block.single[k];
    if (minima.refined[k] != 0.0) [[likely]] {
      minima.write(k, results[i]);
    } else {
      answer_alone(i);
    }
  }
  if (contest_count == 0) return;
  End start = end_at<Degree>(curve, 0.0), end = end_at<Degree>(curve, 1.0);
  for (const Contest& contest : std::span(contests).first(contest_count)) {
    if (!answer_contest<Degree>(curve, block, contest, start, end, results[contest.query])) {
      answer_alone(contest.query);
    }
  }
}

using Method = void (*)(const CurveElement&, std::span<const Point>, std::span<NearestPoint>, double);

template <int Degree>
void answer_baseline(const CurveElement& curve, std::span<const Point> queries, std::span<NearestPoint> results,
                     double tolerance) {
  Block<Degree> block;
  for (std::size_t first = 0; first < queries.size(); first += block_size) {
    const std::size_t count = std::min(block_size, queries.size() - first);
    std::size_t singles = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Pair query = in_sizes(curve, queries[first + i]);
      singles += block.set(i, singles, query, slope_signs(curve.ordinates, query));
    }
    answer_block<Degree>(curve, block, singles, queries.subspan(first, count), results.subspan(first, count),
                         tolerance);
  }
}

#if defined(__SSE2__)
template <int Degree>
[[gnu::target("avx2")]] void answer_avx2(const CurveElement& curve, std::span<const Point> queries,
                                         std::span<NearestPoint> results, double tolerance) {
  Block<Degree> block;
  for (std::size_t first = 0; first < queries.size(); first += block_size) {
    const std::size_t count = std::min(block_size, queries.size() - first);
    std::size_t singles = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Pair query = in_sizes(curve, queries[first + i]);
      singles += block.set(i, singles, query, slope_signs_avx2(curve.ordinates, query));
    }
    answer_block<Degree>(curve, block, singles, queries.subspan(first, count), results.subspan(first, count),
                         tolerance);
  }
}
#endif

/// Indexed by degree minus 2. Holds the baseline until the processor has been detected at program start.
constinit std::array<Method, 3> methods = {answer_baseline<2>, answer_baseline<3>, answer_baseline<4>};

#if defined(__SSE2__)
[[maybe_unused]] const bool chosen = [] {
  if (__builtin_cpu_supports("avx2")) methods = {answer_avx2<2>, answer_avx2<3>, answer_avx2<4>};
  return true;
}();
#endif

}  // namespace

void certified_nearest_points(const CurveElement& curve, std::span<const Point> queries,
                              std::span<NearestPoint> results, double tolerance) noexcept {
  methods[static_cast<std::size_t>(curve.degree - 2)](curve, queries, results, tolerance);
}

}  // namespace calligraphy
