#include "minimum_search.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "candidate.hpp"
#include "curve_answer.hpp"
#include "polish.hpp"
#include "refused_query.hpp"
#include "slope_signs.hpp"

namespace calligraphy {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The search of one query on one curve. Half the slope of the squared distance is the polynomial
/// g(t) = (B(t) - q) . B'(t), of degree 2 n - 1. Its Bernstein ordinates over an interval bound it there, and the
/// number of their sign changes bounds the number of its zeros (variation diminishing), so that every minimum can be
/// isolated: halve until an interval shows no change (none inside), or one (Newton's method cannot leave it).
template <int Degree>
class MinimumSearch {
 public:
  MinimumSearch(const CurveElement& curve, const Point& query, double tolerance, const ParameterRange& range)
      : curve_(curve), query_(query), tolerance_(tolerance), range_(range) {}

  NearestPoint run() {
    best_ = candidate<Degree>(curve_, query_, range_.begin);
    offer(range_.end);
    if (within(query_, furthest_for_signs)) {
      search_cells();
    } else {
      isolate(range_);
    }
    return curve_answer(curve_, best_.t, best_.place, best_.offset, best_.velocity,
                        intervals_ <= interval_limit ? NearestPointStatus::certified : NearestPointStatus::approximate);
  }

 private:
  static constexpr int slope_degree = 2 * Degree - 1;
  static constexpr int interval_limit = 256;
  static constexpr int stack_limit = 64;
  static constexpr double narrowest = 1e-11;
  using Terms = std::array<double, slope_degree + 1>;

  struct Interval {
    double begin, end;
    double begin_square, end_square;  ///< squared distances
    Terms ordinates;
  };

  double offer(double t) {
    const Candidate next = candidate<Degree>(curve_, query_, t);
    if (nearer(next, best_)) best_ = next;
    return next.square;
  }

  /// Cells whose ordinates have certain signs need no more than a look at them.
  void search_cells() {
    const CertainSigns signs =
        certain_signs(curve_.ordinates, static_cast<float>(query_.x()), static_cast<float>(query_.y()));
    const double width = 1.0 / curve_.cells;
    constexpr std::uint64_t all = (1U << (slope_degree + 1)) - 1;
    unsigned unclear = 0;
    for (int cell = 0; cell < curve_.cells; ++cell) {
      const std::uint64_t negative = (signs.negative >> (slope_degree * cell)) & all;
      const std::uint64_t positive = (signs.positive >> (slope_degree * cell)) & all;
      if (negative == all || positive == all) continue;
      const double begin = cell * width, end = begin + width;
      const bool whole = begin >= range_.begin && end <= range_.end;
      if (whole && (negative | positive) == all) {
        const std::uint64_t changes = (negative ^ (negative >> 1)) & (all >> 1);
        if (std::has_single_bit(changes)) {
          if (negative & 1U) descend(begin, end, start_in_cell(cell, std::countr_zero(changes)));
          continue;
        }
      }
      unclear |= 1U << cell;
    }
    while (unclear != 0) {
      const int cell = std::countr_zero(unclear);
      unclear &= unclear - 1;
      isolate({std::max(cell * width, range_.begin), std::min((cell + 1) * width, range_.end)});
    }
  }

  /// Zero of the control polygon between ordinates `change` and the next of a cell.
  double start_in_cell(int cell, int change) const {
    const auto i = static_cast<std::size_t>(slope_degree * cell + change);
    const float x = static_cast<float>(query_.x()), y = static_cast<float>(query_.y());
    const double before = slope_ordinate(curve_.ordinates, i, x, y),
                 after = slope_ordinate(curve_.ordinates, i + 1, x, y);
    return (static_cast<double>(i) + before / (before - after)) / (slope_degree * curve_.cells);
  }

  void set_up_polynomial() {
    power_.fill(0.0);
    for (std::size_t k = 1; k <= Degree; ++k) {
      const Point& factor = curve_.coefficients[k - 1];
      for (std::size_t i = 1; i <= Degree; ++i) {
        power_[i + k - 1] += static_cast<double>(k) * curve_.coefficients[i - 1].dot(factor);
      }
      power_[k - 1] -= static_cast<double>(k) * query_.dot(factor);
    }
    double scale = 0.0;
    for (const double term : power_) scale += std::abs(term);
    noise_ = 16.0 * epsilon * scale;
  }

  /// Bernstein ordinates over a part of [0, 1]: shift and scale the power basis, then divide by binomials.
  Terms ordinates(const ParameterRange& part) const {
    constexpr std::size_t degree = slope_degree;
    Terms terms = power_;
    for (std::size_t k = 0; k < degree; ++k) {
      for (std::size_t i = degree; i-- > k;) terms[i] += part.begin * terms[i + 1];
    }
    double scale = 1.0, binomial = 1.0;
    for (std::size_t i = 1; i <= degree; ++i) {
      scale *= part.end - part.begin;
      binomial *= static_cast<double>(degree - i + 1) / static_cast<double>(i);
      terms[i] *= scale / binomial;
    }
    for (std::size_t k = 1; k <= degree; ++k) {
      for (std::size_t i = degree; i >= k; --i) terms[i] += terms[i - 1];
    }
    return terms;
  }

  void isolate(const ParameterRange& part) {
    if (!(part.end > part.begin)) return;
    if (intervals_ == 0) set_up_polynomial();
    std::array<Interval, stack_limit> stack;
    std::size_t depth = 0;
    stack[depth++] = {part.begin, part.end, offer(part.begin), offer(part.end), ordinates(part)};
    while (depth > 0 && ++intervals_ <= interval_limit) {
      const Interval interval = stack[--depth];
      if (!examine(interval) || depth + 2 > stack_limit) continue;
      const double middle = 0.5 * (interval.begin + interval.end);
      const double middle_square = offer(middle);
      if (interval.end - interval.begin < narrowest) continue;
      Interval left{interval.begin, middle, interval.begin_square, middle_square, {}};
      Interval right{middle, interval.end, middle_square, interval.end_square, interval.ordinates};
      for (std::size_t k = 0; k <= slope_degree; ++k) {
        left.ordinates[k] = right.ordinates[0];
        for (std::size_t i = 0; i + k < slope_degree; ++i) {
          right.ordinates[i] = 0.5 * (right.ordinates[i] + right.ordinates[i + 1]);
        }
      }
      const bool left_first = interval.begin_square <= interval.end_square;
      stack[depth++] = left_first ? right : left;
      stack[depth++] = left_first ? left : right;
    }
  }

  /// Whether the interval has to be halved. Its ends have been offered.
  bool examine(const Interval& interval) {
    const auto& g = interval.ordinates;
    const auto [lowest, highest] = std::minmax_element(g.begin(), g.end());
    if (*lowest >= 0.0 || *highest <= 0.0) return false;  // monotone: nothing nearer inside than at the ends
    const double width = interval.end - interval.begin;
    if (least_square(interval, *lowest, *highest) >= best_.square) return false;
    if (std::max(-*lowest, *highest) <= noise_) {
      offer(0.5 * (interval.begin + interval.end));
      return false;
    }
    // Signs within rounding of zero: between different ones they leave one change whatever they are; at an end they
    // can only hide a minimum as near as the end itself.
    int changes = 0, change = 0, last = -1;
    bool doubtful = false;
    for (int i = 0; i <= slope_degree; ++i) {
      const double value = g[static_cast<std::size_t>(i)];
      if (std::abs(value) <= noise_) continue;
      if (last >= 0) {
        const bool differs = (value < 0.0) != (g[static_cast<std::size_t>(last)] < 0.0);
        changes += differs;
        if (differs) change = last;
        doubtful = doubtful || (!differs && i > last + 1);
      }
      last = i;
    }
    if (doubtful || changes > 1) return true;
    if (changes == 0) return false;
    const double before = g[static_cast<std::size_t>(change)], after = g[static_cast<std::size_t>(change + 1)];
    if (before > 0.0) return false;  // from + to -: a maximum
    descend(interval.begin, interval.end, interval.begin + width * (change + before / (before - after)) / slope_degree);
    return false;
  }

  /// No point of the interval is nearer: the squared distance falls from its ends by at most twice the ordinates.
  static double least_square(const Interval& interval, double lowest, double highest) {
    const double width = interval.end - interval.begin;
    return (interval.begin_square * highest - interval.end_square * lowest + 2.0 * width * lowest * highest) /
           (highest - lowest);
  }

  /// The only zero of g within the interval, where it changes from - to +: Newton's method, kept inside by halving.
  void descend(double low, double high, double t) {
    const Polished polished = polish<Degree>(curve_, query_, t, tolerance_);
    if (polished.converged && polished.t >= low && polished.t <= high) {
      offer(polished.t);
      return;
    }
    for (int step = 0; step < 64; ++step) {
      const Point offset = place<Degree>(curve_.coefficients, t) - query_;
      const Point velocity = first_derivative<Degree>(curve_.coefficients, t);
      const double value = offset.dot(velocity);
      const double slope = velocity.squaredNorm() + offset.dot(second_derivative<Degree>(curve_.coefficients, t));
      (value < 0.0 ? low : high) = t;
      double next = t - value / slope;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      const double moved = std::abs(next - t);
      t = next;
      // Newton's method doubles the digits, so a step of the root of the tolerance would do; halving does not.
      if (moved <= tolerance_ * 1e-3 || high - low <= 4.0 * epsilon) break;
    }
    offer(t);
  }

  const CurveElement& curve_;
  const Point query_;
  const double tolerance_;
  const ParameterRange range_;
  Terms power_;
  double noise_ = 0.0;
  Candidate best_;
  int intervals_ = 0;
};

}  // namespace

NearestPoint search_minima(const CurveElement& curve, const Point& query, double tolerance,
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
