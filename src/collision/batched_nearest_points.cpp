#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "candidate.hpp"
#include "certified_nearest_point.hpp"
#include "polish.hpp"
#include "slope_cells.hpp"
#include "slope_signs.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t block_size = 32;
constexpr std::size_t lanes = 4;  // doubles in the widest SIMD register used

/// Queries with one minimum each, one array per quantity: loops over them vectorise.
struct Block {
  std::size_t count = 0;
  std::array<std::size_t, block_size> index;  ///< of the query
  std::array<double, block_size> query_x, query_y, t;
  std::array<double, block_size> step, slope, bend;
  std::array<double, block_size> point_x, point_y, distance, tangent_x, tangent_y, speed;
};

/// Performs the operations of a single query in the same order, so the results are the same to the last bit.
template <int Degree>
[[gnu::always_inline]] inline void polish_block(const CurveElement& curve, Block& block) {
  const std::size_t count = (block.count + lanes - 1) / lanes * lanes;
  for (std::size_t i = block.count; i < count; ++i) {  // fills the last register
    block.query_x[i] = block.query_x[0];
    block.query_y[i] = block.query_y[0];
    block.t[i] = block.t[0];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Coordinates query = {block.query_x[i], block.query_y[i]};
    Residue residue;
    const auto at = polish<Degree>(curve, SlopePolynomial<Degree>(curve, query), query, block.t[i], residue);
    block.t[i] = at.t;
    block.step[i] = residue.step;
    block.slope[i] = residue.slope;
    block.bend[i] = residue.bend;
    const double speed = std::sqrt(dot(at.velocity, at.velocity));
    const Coordinates point = vector_of<Coordinates>(curve.origin) + at.place * curve.size;
    const Coordinates tangent = at.velocity * (1.0 / speed);
    block.point_x[i] = point.x;
    block.point_y[i] = point.y;
    block.distance[i] = curve.size * std::sqrt(dot(at.offset, at.offset));
    block.tangent_x[i] = tangent.x;
    block.tangent_y[i] = tangent.y;
    block.speed[i] = speed;
  }
}

using Signs = SlopeSigns<CurveElement::max_ordinates>;

/// Processes at most one block of queries whose signs are known.
template <int Degree>
[[gnu::always_inline]] inline void answer_block(const CurveElement& curve, const std::array<Signs, block_size>& signs,
                                                std::span<const Point> queries, std::span<NearestPoint> results,
                                                double tolerance) {
  Block block;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const std::uint64_t changes = signs[i].changes();
    if (!(signs[i].certain && signs[i].first_negative() && std::has_single_bit(changes))) {
      results[i] = certified_nearest_point(curve, queries[i], tolerance, {});
      continue;
    }
    const Pair query = in_sizes(curve, queries[i]);
    block.index[block.count] = i;
    block.query_x[block.count] = query[0];
    block.query_y[block.count] = query[1];
    block.t[block.count] = middles<Degree>[static_cast<std::size_t>(std::countr_zero(changes))];
    ++block.count;
  }
  polish_block<Degree>(curve, block);
  const double allowed = allowed_error<Degree>(tolerance);
  for (std::size_t i = 0; i < block.count; ++i) {
    const std::size_t to = block.index[i];
    const Residue residue{block.step[i], block.slope[i], block.bend[i]};
    const double t = block.t[i];
    if (residue.converged(curve, allowed) && t >= 0.0 && t <= 1.0 && block.speed[i] > min_speed) {
      results[to] = {t, Point(block.point_x[i], block.point_y[i]), block.distance[i],
                     Point(block.tangent_x[i], block.tangent_y[i]), NearestPointStatus::certified};
    } else {
      results[to] = certified_nearest_point(curve, queries[to], tolerance, {});
    }
  }
}

using Method = void (*)(const CurveElement&, std::span<const Point>, std::span<NearestPoint>, double);

template <int Degree>
void answer_baseline(const CurveElement& curve, std::span<const Point> queries, std::span<NearestPoint> results,
                     double tolerance) {
  for (std::size_t first = 0; first < queries.size(); first += block_size) {
    const std::size_t count = std::min(block_size, queries.size() - first);
    std::array<Signs, block_size> signs;
    for (std::size_t i = 0; i < count; ++i) {
      signs[i] = slope_signs(curve.ordinates, in_sizes(curve, queries[first + i]));
    }
    answer_block<Degree>(curve, signs, queries.subspan(first, count), results.subspan(first, count), tolerance);
  }
}

#if defined(__SSE2__)
template <int Degree>
[[gnu::target("avx2")]] void answer_avx2(const CurveElement& curve, std::span<const Point> queries,
                                         std::span<NearestPoint> results, double tolerance) {
  for (std::size_t first = 0; first < queries.size(); first += block_size) {
    const std::size_t count = std::min(block_size, queries.size() - first);
    std::array<Signs, block_size> signs;
    for (std::size_t i = 0; i < count; ++i) {
      signs[i] = slope_signs_avx2(curve.ordinates, in_sizes(curve, queries[first + i]));
    }
    answer_block<Degree>(curve, signs, queries.subspan(first, count), results.subspan(first, count), tolerance);
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
