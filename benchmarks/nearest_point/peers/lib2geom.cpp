// lib2geom's nearest time on a line and on a cubic.
#include "../method.hpp"

#ifdef CALLIGRAPHY_LIB2GEOM

#include <limits>

#include <2geom/bezier-curve.h>

namespace nearest_point_benchmark {
namespace {

struct Lib2geom {
  using Element = std::unique_ptr<Geom::Curve>;

  Element prepare(const ControlPoints& points) const {
    const auto at = [&](std::size_t i) { return Geom::Point(points[i].x(), points[i].y()); };
    if (points.size() == 2) return std::make_unique<Geom::LineSegment>(at(0), at(1));
    return std::make_unique<Geom::CubicBezier>(at(0), at(1), at(2), at(3));
  }
  void restart() {}
  Answer operator()(const Element& element, const Point& query) const {
    try {
      const double t = element->nearestTime({query.x(), query.y()});
      const Geom::Point point = element->pointAt(t);
      const Point foot(point.x(), point.y());
      return {t, foot, (query - foot).norm()};
    } catch (const std::exception&) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      return {none, {none, none}, none};
    }
  }
};

}  // namespace

std::vector<std::unique_ptr<Method>> lib2geom_methods() {
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(method_of("lib2geom nearest_time", Lib2geom{}));
  return methods;
}

}  // namespace nearest_point_benchmark

#else

namespace nearest_point_benchmark {
std::vector<std::unique_ptr<Method>> lib2geom_methods() { return {}; }
}  // namespace nearest_point_benchmark

#endif
