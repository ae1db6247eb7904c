// kurbo's nearest point on a line and on a cubic (crate kurbo, through peers/kurbo).
#include "../method.hpp"

#ifdef CALLIGRAPHY_KURBO

#include <array>
#include <cmath>

extern "C" {
// peers/kurbo/src/lib.rs; `answer`: parameter, x, y, squared distance.
void calligraphy_kurbo_line(const double* control_points, double x, double y, double accuracy, double* answer);
void calligraphy_kurbo_cubic(const double* control_points, double x, double y, double accuracy, double* answer);
}

namespace nearest_point_benchmark {
namespace {

struct KurboElement {
  bool curve;
  std::array<double, 8> control_points;
};

struct Kurbo {
  using Element = KurboElement;
  double accuracy;  ///< of the parameter, as kurbo 0.13 understands it

  Element prepare(const ControlPoints& points) const {
    Element element{points.size() == 4, {}};
    for (std::size_t i = 0; i < points.size(); ++i) {
      element.control_points[2 * i] = points[i].x();
      element.control_points[2 * i + 1] = points[i].y();
    }
    return element;
  }
  void restart() {}
  Answer operator()(const Element& element, const Point& query) const {
    double answer[4];
    const auto nearest = element.curve ? calligraphy_kurbo_cubic : calligraphy_kurbo_line;
    nearest(element.control_points.data(), query.x(), query.y(), accuracy, answer);
    return {answer[0], {answer[1], answer[2]}, std::sqrt(answer[3])};
  }
};

}  // namespace

std::vector<std::unique_ptr<Method>> kurbo_methods() {
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(method_of("kurbo nearest 1e-9", Kurbo{1e-9}));
  methods.push_back(method_of("kurbo nearest 1e-12", Kurbo{1e-12}));
  return methods;
}

}  // namespace nearest_point_benchmark

#else

namespace nearest_point_benchmark {
std::vector<std::unique_ptr<Method>> kurbo_methods() { return {}; }
}  // namespace nearest_point_benchmark

#endif
