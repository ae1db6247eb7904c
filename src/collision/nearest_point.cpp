#include <calligraphy/collision/nearest_point.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace calligraphy {
namespace {

/// Beyond this many sizes squares overflow; such a query is answered like one that is not finite.
constexpr double furthest_query = 1e100;

NearestPoint at_parameter(const StrokeElement& element, const Point& query, double t, bool certified) {
  const Point point = element.point(t);
  const Point offset = query - point;
  return {t, point, std::hypot(offset.x(), offset.y()), element.tangent(t), certified};
}

NearestPoint on_line(const StrokeElement& element, const Point& query, const ParameterRange& range) {
  const Point& direction = element.coefficients[0];
  const double t = direction.dot((query - element.origin) / element.size) / direction.squaredNorm();
  return at_parameter(element, query, std::clamp(t, range.begin, range.end), true);
}

/// The search of one query on one curve. Half the slope of the squared distance is the polynomial
/// g(t) = (B(t) - q) . B'(t), of degree 2 n - 1. Its Bernstein ordinates over an interval bound it there, and the
/// number of their sign changes bounds the number of its zeros (variation diminishing), so that every minimum can be
/// isolated: halve until an interval shows no change (none inside), or one (Newton's method cannot leave it).
class CurveSearch {
 public:
  CurveSearch(const StrokeElement& element, const Point& query, const ParameterRange& range, double tolerance)
      : element_(element),
        query_((query - element.origin) / element.size),
        degree_(static_cast<std::size_t>(2 * element.degree - 1)),
        tolerance_(tolerance),
        range_(range) {}

  NearestPoint run(const Point& query) {
    set_up_polynomial();
    best_ = range_.begin;
    best_square_ = square(range_.begin);
    const double end_square = square(range_.end);
    offer(range_.end, end_square);

    stack_[0] = {range_.begin, range_.end, square(range_.begin), ordinates(range_)};
    depth_ = 1;
    int intervals = 0;
    while (depth_ > 0 && ++intervals <= interval_limit) examine(stack_[--depth_]);
    return at_parameter(element_, query, best_, depth_ == 0);
  }

 private:
  static constexpr std::size_t max_terms = 2 * max_curve_degree;
  static constexpr int interval_limit = 256;
  static constexpr int stack_limit = 48;
  static constexpr double narrowest = 1e-11;
  using Terms = std::array<double, max_terms>;

  struct Interval {
    double begin, end;
    double begin_square;  ///< squared distance at `begin`
    Terms ordinates;
  };

  void set_up_polynomial() {
    power_ = element_.slope_of_square;
    double scale = 0.0;
    for (int k = 1; k <= element_.degree; ++k) {
      const auto i = static_cast<std::size_t>(k - 1);
      power_[i] -= k * query_.dot(element_.coefficients[i]);
    }
    for (std::size_t i = 0; i <= degree_; ++i) scale += std::abs(power_[i]);
    noise_ = 16.0 * std::numeric_limits<double>::epsilon() * scale;
  }

  /// Bernstein ordinates over a part of [0, 1]: shift and scale the power basis, then divide by binomials.
  Terms ordinates(const ParameterRange& part) const {
    Terms terms = power_;
    if (part.begin != 0.0) {
      for (std::size_t k = 0; k < degree_; ++k) {
        for (std::size_t i = degree_; i-- > k;) terms[i] += part.begin * terms[i + 1];
      }
    }
    double scale = 1.0, binomial = 1.0;
    for (std::size_t i = 1; i <= degree_; ++i) {
      scale *= part.end - part.begin;
      binomial *= static_cast<double>(degree_ - i + 1) / static_cast<double>(i);
      terms[i] *= scale / binomial;
    }
    for (std::size_t k = 1; k <= degree_; ++k) {
      for (std::size_t i = degree_; i >= k; --i) terms[i] += terms[i - 1];
    }
    return terms;
  }

  double square(double t) const {
    Point sum = Point::Zero();
    for (int k = element_.degree; k >= 1; --k) sum = (sum + element_.coefficients[static_cast<std::size_t>(k - 1)]) * t;
    return (sum - query_).squaredNorm();
  }

  /// Ties stay with the smaller parameter.
  void offer(double t, double value) {
    if (value < best_square_ || (value == best_square_ && t < best_)) {
      best_square_ = value;
      best_ = t;
    }
  }

  void examine(const Interval interval) {
    const auto& g = interval.ordinates;
    double lowest = g[0], highest = g[0];
    int changes = 0;
    bool zero = g[0] == 0.0;
    for (std::size_t i = 1; i <= degree_; ++i) {
      lowest = std::min(lowest, g[i]);
      highest = std::max(highest, g[i]);
      changes += (g[i] < 0.0) != (g[i - 1] < 0.0);
      zero = zero || g[i] == 0.0;
    }
    if (lowest >= 0.0 || highest <= 0.0) return;  // monotone: nothing nearer inside than at the ends
    const double width = interval.end - interval.begin;
    if (interval.begin_square + 2.0 * width * lowest >= best_square_) return;  // cannot fall below the best
    const bool distinct = std::max(-lowest, highest) > noise_;
    if (changes == 1 && !zero && distinct) {
      if (g[0] < 0.0) descend(interval);
      return;  // from + to -: a maximum
    }
    const double middle = 0.5 * (interval.begin + interval.end);
    const double middle_square = square(middle);
    offer(middle, middle_square);
    if (!distinct || width < narrowest) return;
    halve(interval, middle, middle_square);
  }

  void halve(const Interval& interval, double middle, double middle_square) {
    Interval left{interval.begin, middle, interval.begin_square, {}};
    Interval right{middle, interval.end, middle_square, interval.ordinates};
    for (std::size_t k = 0; k <= degree_; ++k) {
      left.ordinates[k] = right.ordinates[0];
      for (std::size_t i = 0; i + k < degree_; ++i) {
        right.ordinates[i] = 0.5 * (right.ordinates[i] + right.ordinates[i + 1]);
      }
    }
    if (depth_ + 2 > stack_limit) return;
    stack_[static_cast<std::size_t>(depth_++)] = right;
    stack_[static_cast<std::size_t>(depth_++)] = left;
  }

  /// The only zero of g within the interval, where it changes from - to +: Newton's method, kept inside by halving.
  void descend(const Interval& interval) {
    double low = interval.begin, high = interval.end;
    double t = 0.5 * (low + high);
    for (std::size_t i = 0; i < degree_; ++i) {
      const double before = interval.ordinates[i], after = interval.ordinates[i + 1];
      if (before < 0.0 && after >= 0.0) {
        t = low + (high - low) * (static_cast<double>(i) + before / (before - after)) / static_cast<double>(degree_);
        break;
      }
    }
    for (int step = 0; step < 64; ++step) {
      double value = 0.0, slope = 0.0;
      for (std::size_t i = degree_ + 1; i-- > 0;) {
        slope = slope * t + value;
        value = value * t + power_[i];
      }
      (value < 0.0 ? low : high) = t;
      double next = t - value / slope;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      const double moved = std::abs(next - t);
      t = next;
      // Newton's method doubles the digits, so a step of the root of the tolerance would do; halving does not.
      if (moved <= tolerance_ * 1e-3 || high - low <= 4.0 * std::numeric_limits<double>::epsilon()) break;
    }
    offer(t, square(t));
  }

  const StrokeElement& element_;
  const Point query_;
  const std::size_t degree_;
  const double tolerance_;
  const ParameterRange range_;
  Terms power_ = {};
  double noise_ = 0.0;
  double best_ = 0.0;
  double best_square_ = 0.0;
  std::array<Interval, stack_limit> stack_;
  int depth_ = 0;
};

/// Wang 2006, sec. 4.3.2, as printed. The printed text names no rule for a tie, which is generic: the point between the
/// children belongs to both. Here it goes to the child with the nearer middle. Never certified.
NearestPoint by_subdivision(const StrokeElement& element, const Point& query, const ParameterRange& range,
                            double tolerance) {
  const double coordinates =
      std::max({element.origin.cwiseAbs().maxCoeff(), element.size, query.cwiseAbs().maxCoeff()});
  const double epsilon = std::max(tolerance * element.size, 4.0 * std::numeric_limits<double>::epsilon() * coordinates);
  const auto distance = [&](const Point& point) { return (query - point).norm(); };

  double begin = range.begin, end = range.end;
  double begin_distance = distance(element.point(begin)), end_distance = distance(element.point(end));
  double middle = 0.5 * (begin + end);
  double middle_distance = distance(element.point(middle));
  Point left_middle, right_middle;
  for (int step = 0; step < 64; ++step) {
    left_middle = element.point(0.5 * (begin + middle));
    right_middle = element.point(0.5 * (middle + end));
    const double left = distance(left_middle), right = distance(right_middle);
    if (std::abs(left - right) < epsilon) break;
    const double left_smallest = std::min({begin_distance, left, middle_distance});
    const double right_smallest = std::min({middle_distance, right, end_distance});
    if (left_smallest < right_smallest || (left_smallest == right_smallest && left <= right)) {
      end = middle;
      end_distance = middle_distance;
      middle_distance = left;
    } else {
      begin = middle;
      begin_distance = middle_distance;
      middle_distance = right;
    }
    middle = 0.5 * (begin + end);
  }
  const Point solution = 0.5 * (left_middle + right_middle);
  return {middle, solution, distance(solution), element.tangent(middle), false};
}

}  // namespace

NearestPoint nearest_point(const StrokeElement& element, const Point& query, const NearestPointOptions& options,
                           const ParameterRange& range) noexcept {
  const double reach = furthest_query * element.size;
  const bool in_reach =
      query.allFinite() && (!(element.size > 0.0) || (query - element.origin).cwiseAbs().maxCoeff() <= reach);
  if (!in_reach) {
    return {range.begin, element.point(range.begin), std::numeric_limits<double>::infinity(),
            element.tangent(range.begin), false};
  }
  if (!(element.size > 0.0)) return at_parameter(element, query, range.begin, true);
  if (element.degree == 1) return on_line(element, query, range);
  if (options.method == NearestPointMethod::wang2006) {
    return by_subdivision(element, query, range, options.tolerance);
  }
  return CurveSearch(element, query, range, options.tolerance).run(query);
}

}  // namespace calligraphy
