// The paper's rule as printed, by plain subdivision (Wang 2006, sec. 4.3.2, Figs. 20 and 21): the baseline.
//
// The library's own `wang2006` makes the same decisions with cheaper arithmetic. Here each child segment is computed by
// de Casteljau's algorithm, as the figures show.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "method.hpp"

namespace nearest_point_benchmark {
namespace {

struct PaperElement {
  bool curve;
  std::array<Point, 4> control;  ///< a line: the first two
  double size;                   ///< diagonal of the bounding box of the control points
};

using Cubic = std::array<Point, 4>;

Point middle(const Point& a, const Point& b) { return 0.5 * (a + b); }

/// De Casteljau's algorithm at the midpoint, Fig. 21.
std::pair<Cubic, Cubic> halves(const Cubic& p) {
  const Point a = middle(p[0], p[1]), b = middle(p[1], p[2]), c = middle(p[2], p[3]);
  const Point ab = middle(a, b), bc = middle(b, c);
  const Point on_curve = middle(ab, bc);
  return {{p[0], a, ab, on_curve}, {on_curve, bc, c, p[3]}};
}

Point middle_of(const Cubic& p) {
  const Point b = middle(p[1], p[2]);
  return middle(middle(middle(p[0], p[1]), b), middle(b, middle(p[2], p[3])));
}

class PaperRule {
 public:
  using Element = PaperElement;
  explicit PaperRule(double epsilon) : epsilon_(epsilon) {}

  Element prepare(const ControlPoints& points) const {
    Element element{points.size() == 4, {}, 0.0};
    Point low = points[0], high = low;
    for (std::size_t i = 0; i < points.size(); ++i) {
      element.control[i] = points[i];
      low = low.cwiseMin(points[i]);
      high = high.cwiseMax(points[i]);
    }
    element.size = (high - low).norm();
    return element;
  }
  void restart() {}
  Answer operator()(const Element& element, const Point& query) const {
    return element.curve ? on_curve(element, query) : on_line(element, query);
  }

 private:
  static Answer on_line(const Element& element, const Point& query) {
    const auto& p = element.control;
    const Point along = p[1] - p[0];
    const double square = along.squaredNorm();
    const double t = square > 0.0 ? std::clamp(along.dot(query - p[0]) / square, 0.0, 1.0) : 0.0;
    const Point closest = p[0] + t * along;
    return {t, closest, (query - closest).norm()};
  }

  /// What the text leaves open: a tie goes to the child with the nearer midpoint, and subdivision stops at rounding or
  /// after 64 steps.
  Answer on_curve(const Element& element, const Point& query) const {
    const double coordinates =
        std::max({element.control[0].cwiseAbs().maxCoeff(), element.size, query.cwiseAbs().maxCoeff()});
    const double epsilon =
        std::max(epsilon_ * element.size, 4.0 * std::numeric_limits<double>::epsilon() * coordinates);
    const auto distance = [&](const Point& point) { return (query - point).norm(); };
    Cubic parent = element.control;
    double begin = 0.0, end = 1.0;
    Point left_middle, right_middle;
    for (int step = 0; step < 64; ++step) {
      const auto [left, right] = halves(parent);
      left_middle = middle_of(left);
      right_middle = middle_of(right);
      const double to_left = distance(left_middle), to_right = distance(right_middle);
      if (std::abs(to_left - to_right) < epsilon) break;
      const double to_shared = distance(right[0]);
      const double left_min = std::min({distance(left[0]), to_left, to_shared});
      const double right_min = std::min({to_shared, to_right, distance(right[3])});
      const double half = 0.5 * (begin + end);
      if (left_min < right_min || (left_min == right_min && to_left <= to_right)) {
        parent = left;
        end = half;
      } else {
        parent = right;
        begin = half;
      }
    }
    const Point solution = middle(left_middle, right_middle);
    return {0.5 * (begin + end), solution, distance(solution)};
  }

  double epsilon_;
};

}  // namespace

std::vector<std::unique_ptr<Method>> paper_methods() {
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(method_of("paper, plain 1e-3", PaperRule(1e-3)));
  methods.push_back(method_of("paper, plain 1e-6", PaperRule(1e-6)));
  methods.push_back(method_of("paper, plain 1e-9", PaperRule(1e-9)));
  return methods;
}

}  // namespace nearest_point_benchmark
