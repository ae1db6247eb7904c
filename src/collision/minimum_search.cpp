#include "minimum_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "binomial.hpp"
#include "candidate.hpp"
#include "polish.hpp"
#include "slope_signs.hpp"

namespace calligraphy {
namespace {

constexpr double unit_rounding = std::numeric_limits<double>::epsilon();

double larger_coordinate(Pair vector) { return std::max(std::abs(vector[0]), std::abs(vector[1])); }

/// The search for one query on one curve. Half the slope of the squared distance is the polynomial
/// g(t) = (B(t) - q) . B'(t), of degree 2 n - 1. Its Bernstein ordinates over an interval bound it there, and the
/// number of their sign changes bounds the number of its zeros (variation diminishing), so every minimum can be
/// isolated: bisect until an interval shows no sign change (none inside) or one (Newton's method cannot leave it).
template <int Degree>
class MinimumSearch {
 public:
  MinimumSearch(const CurveElement& curve, Pair query, double tolerance, const ParameterRange& range)
      : curve_(curve), query_(query), tolerance_(tolerance), range_(range), polynomial_(curve, query) {}

  NearestPoint run() {
    best_ = candidate<Degree>(curve_, query_, range_.begin);
    best_square_ = dot(best_.offset, best_.offset);
    offer(range_.end);
    search_cells();
    return curve_answer(curve_, best_,
                        intervals_ <= interval_limit ? NearestPointStatus::certified : NearestPointStatus::approximate);
  }

 private:
  static constexpr int slope_degree = 2 * Degree - 1;
  static constexpr int interval_limit = 256;
  static constexpr int stack_limit = 64;
  static constexpr double narrowest = 1e-11;
  using Terms = std::array<double, slope_degree + 1>;
  using Controls = std::array<Pair, Degree + 1>;

  struct Interval {
    double begin, end;
    double begin_square, end_square;  ///< squared distances
    Controls controls;                ///< relative to the query
  };

  double offer(double t) {
    const Candidate next = candidate<Degree>(curve_, query_, t);
    const double square = dot(next.offset, next.offset);
    if (nearer(next, best_)) {
      best_ = next;
      best_square_ = square;
    }
    return square;
  }

  /// Only inspects cells whose ordinates all have certain signs.
  void search_cells() {
    const CertainSigns signs = certain_signs(curve_.ordinates, query_);
    const double width = 1.0 / curve_.cells;
    constexpr std::uint64_t all = (1U << (slope_degree + 1)) - 1;
    unsigned unclear = 0;
    for (int cell = 0; cell < curve_.cells; ++cell) {
      const std::uint64_t negative = (signs.negative >> (slope_degree * cell)) & all;
      const std::uint64_t positive = (signs.positive >> (slope_degree * cell)) & all;
      if (negative == all || positive == all) continue;
      const double begin = cell * width, end = begin + width;
      const bool whole = begin >= range_.begin && end <= range_.end;
      // An uncertain sign between differing certain ones leaves one change, whichever it is.
      if (whole && starts_and_ends(positive, negative, all)) continue;  // from + to -: a maximum
      if (whole && starts_and_ends(negative, positive, all)) {
        const int last = std::countr_one(negative) - 1, next = std::countr_zero(positive);
        descend(begin, end, begin + width * (last + next) / (2 * slope_degree));
        continue;
      }
      unclear |= 1U << cell;
    }
    while (unclear != 0) {
      const int cell = std::countr_zero(unclear);
      unclear &= unclear - 1;
      isolate({std::max(cell * width, range_.begin), std::min((cell + 1) * width, range_.end)});
    }
  }

  /// Whether the bits of `first` are the lowest ones and those of `second` the highest ones of `all`, with at most one
  /// bit between them that is in neither.
  static bool starts_and_ends(std::uint64_t first, std::uint64_t second, std::uint64_t all) {
    const std::uint64_t not_second = all & ~second, between = not_second & ~first;
    return first != 0 && second != 0 && (first & (first + 1)) == 0 && (not_second & (not_second + 1)) == 0 &&
           (between & (between - 1)) == 0;
  }

  /// Control points of a part of the curve, relative to the query.
  Controls controls(const ParameterRange& part) const {
    // For the whole curve: from the power basis to the Bernstein basis, then de Casteljau's algorithm at both ends.
    // Coordinates relative to the query keep their precision where control points and query lie close together.
    Controls row;
    row[0] = -query_;
    for (std::size_t k = 1; k <= Degree; ++k) row[k] = pair(curve_.coefficients[k - 1]) / binomial[Degree][k];
    for (std::size_t k = 1; k <= Degree; ++k) {
      for (std::size_t i = Degree; i >= k; --i) row[i] += row[i - 1];
    }
    if (part.end < 1.0) {
      for (std::size_t k = 1; k <= Degree; ++k) {
        for (std::size_t i = Degree; i >= k; --i) row[i] = row[i - 1] + (row[i] - row[i - 1]) * part.end;
      }
    }
    if (part.begin > 0.0) {
      const double share = part.begin / part.end;
      for (std::size_t k = 1; k <= Degree; ++k) {
        for (std::size_t i = 0; i + k <= Degree; ++i) row[i] += (row[i + 1] - row[i]) * share;
      }
    }
    return row;
  }

  /// Bernstein ordinates of g over an interval: the product of B - q and B' in Bernstein's basis.
  static Terms ordinates(const Interval& interval) {
    Controls velocity;
    const double per_width = Degree / (interval.end - interval.begin);
    for (std::size_t j = 0; j < Degree; ++j) {
      velocity[j] = (interval.controls[j + 1] - interval.controls[j]) * per_width;
    }
    Terms terms = {};
    for (std::size_t i = 0; i <= Degree; ++i) {
      for (std::size_t j = 0; j < Degree; ++j) {
        const double share = binomial[Degree][i] * binomial[Degree - 1][j] / binomial[slope_degree][i + j];
        terms[i + j] += share * dot(interval.controls[i], velocity[j]);
      }
    }
    return terms;
  }

  void isolate(const ParameterRange& part) {
    if (!(part.end > part.begin)) return;
    std::array<Interval, stack_limit> stack;
    std::size_t depth = 0;
    stack[depth++] = {part.begin, part.end, offer(part.begin), offer(part.end), controls(part)};
    while (depth > 0 && ++intervals_ <= interval_limit) {
      const Interval interval = stack[--depth];
      if (!examine(interval) || depth + 2 > stack_limit) continue;
      const double middle = 0.5 * (interval.begin + interval.end);
      const double middle_square = offer(middle);
      if (interval.end - interval.begin < narrowest) continue;
      Interval left{interval.begin, middle, interval.begin_square, middle_square, {}};
      Interval right{middle, interval.end, middle_square, interval.end_square, interval.controls};
      for (std::size_t k = 0; k <= Degree; ++k) {
        left.controls[k] = right.controls[0];
        for (std::size_t i = 0; i + k < Degree; ++i) {
          right.controls[i] = (right.controls[i] + right.controls[i + 1]) * 0.5;
        }
      }
      const bool left_first = interval.begin_square <= interval.end_square;
      stack[depth++] = left_first ? right : left;
      stack[depth++] = left_first ? left : right;
    }
  }

  /// Whether the interval has to be bisected. Its ends have already been considered.
  bool examine(const Interval& interval) {
    const Terms g = ordinates(interval);
    const auto [lowest, highest] = std::minmax_element(g.begin(), g.end());
    if (*lowest >= 0.0 || *highest <= 0.0) return false;  // monotone: nothing nearer inside than at the ends
    // An improvement below a thousandth of the tolerance, or below rounding, does not justify bisection.
    const double slack = 2e-3 * tolerance_ * larger_coordinate(best_.offset) + 2.0 * unit_rounding * best_square_;
    if (min_square(interval, *lowest, *highest) >= best_square_ - slack) return false;
    // A sign within rounding of zero leaves one change between differing signs, whichever it is; at an end it can only
    // hide a minimum as near as the end itself.
    const double noise = 16.0 * unit_rounding * max_product(interval);
    int changes = 0, change = 0, last = -1;
    bool doubtful = false;
    for (int i = 0; i <= slope_degree; ++i) {
      const double value = g[static_cast<std::size_t>(i)];
      if (std::abs(value) <= noise) continue;
      if (last >= 0) {
        const bool differs = (value < 0.0) != (g[static_cast<std::size_t>(last)] < 0.0);
        changes += differs;
        if (differs) change = last;
        doubtful = doubtful || i > last + (differs ? 2 : 1);
      }
      last = i;
    }
    if (doubtful || changes > 1) return true;
    if (changes == 0) {
      if (last < 0) offer(0.5 * (interval.begin + interval.end));
      return false;
    }
    const double before = g[static_cast<std::size_t>(change)], after = g[static_cast<std::size_t>(change + 1)];
    if (before > 0.0) return false;  // from + to -: a maximum
    const double width = interval.end - interval.begin;
    const double share = before / (before - after);
    descend(interval.begin, interval.end, interval.begin + width * (change + share) / slope_degree);
    return false;
  }

  /// Bound on the terms whose sum is g.
  static double max_product(const Interval& interval) {
    double offset = 0.0, velocity = 0.0;
    for (std::size_t i = 0; i <= Degree; ++i) {
      offset = std::max(offset, larger_coordinate(interval.controls[i]));
      if (i > 0) velocity = std::max(velocity, larger_coordinate(interval.controls[i] - interval.controls[i - 1]));
    }
    return offset * velocity * Degree / (interval.end - interval.begin);
  }

  /// No point of the interval is nearer: the squared distance decreases from its ends by at most twice the ordinates.
  static double min_square(const Interval& interval, double lowest, double highest) {
    const double width = interval.end - interval.begin;
    return (interval.begin_square * highest - interval.end_square * lowest + 2.0 * width * lowest * highest) /
           (highest - lowest);
  }

  /// The only zero of g within the interval, where it changes from - to +: Newton's method, safeguarded by bisection.
  void descend(double low, double high, double t) {
    Residue residue;
    const double polished = polish<Degree>(curve_, polynomial_, query_, t, residue).t;
    if (residue.converged(curve_, allowed_error<Degree>(tolerance_)) && polished >= low && polished <= high) {
      offer(polished);
      return;
    }
    for (int step = 0; step < 64; ++step) {
      const Candidate at = candidate<Degree>(curve_, query_, t);
      const double value = dot(at.offset, at.velocity);
      if (std::abs(value) <= noise(at)) {
        if (zero_is_here(t, low, high)) break;
        t = 0.5 * (low + high);
        continue;
      }
      (value < 0.0 ? low : high) = t;
      const Pair half_second = half_second_derivative<Degree>(curve_, t);
      const double slope = dot(at.velocity, at.velocity) + 2.0 * dot(at.offset, half_second);
      double next = t - value / slope;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      const double moved = std::abs(next - t);
      t = next;
      // Newton's method doubles the digits, so a step of the square root of the tolerance would suffice; bisection does
      // not.
      if (moved <= tolerance_ * 1e-3 || high - low <= 4.0 * unit_rounding) break;
    }
    offer(t);
  }

  /// For a t where rounding decides the sign of g: whether the zero is here, or else on which side it lies, according
  /// to the nearest positions on both sides where the sign is certain.
  bool zero_is_here(double t, double& low, double& high) const {
    for (double aside = narrowest;; aside *= 4.0) {
      const double left = std::max(t - aside, low), right = std::min(t + aside, high);
      const int left_sign = certain_sign(left), right_sign = certain_sign(right);
      if (right_sign < 0) low = right;
      if (left_sign > 0) high = left;
      if (right_sign < 0 || left_sign > 0) return false;
      if ((left_sign < 0 && right_sign > 0) || (left <= low && right >= high)) return true;
    }
  }

  int certain_sign(double t) const {
    const Candidate at = candidate<Degree>(curve_, query_, t);
    const double value = dot(at.offset, at.velocity);
    return std::abs(value) <= noise(at) ? 0 : value < 0.0 ? -1 : 1;
  }

  /// Rounding error of g: from the position, relative to the size, and from the velocity, relative to the terms of its
  /// sum.
  double noise(const Candidate& at) const {
    double speed = 0.0;
    for (std::size_t k = 0; k < Degree; ++k) {
      speed += static_cast<double>(k + 1) * larger_coordinate(pair(curve_.coefficients[k]));
    }
    return 4.0 * unit_rounding * (larger_coordinate(at.offset) * speed + larger_coordinate(at.velocity));
  }

  const CurveElement& curve_;
  const Pair query_;
  const double tolerance_;
  const ParameterRange range_;
  const SlopePolynomial<Degree> polynomial_;
  Candidate best_;
  double best_square_ = 0.0;
  int intervals_ = 0;
};

}  // namespace

NearestPoint search_minima(const CurveElement& curve, Pair query, double tolerance,
                           const ParameterRange& range) noexcept {
  switch (curve.degree) {
    case 2:
      return MinimumSearch<2>(curve, query, tolerance, range).run();
    case 3:
      return MinimumSearch<3>(curve, query, tolerance, range).run();
    default:
      return MinimumSearch<4>(curve, query, tolerance, range).run();
  }
}

}  // namespace calligraphy
