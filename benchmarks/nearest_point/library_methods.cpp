// The library's own methods.
#include <calligraphy/collision/nearest_point.hpp>

#include "method.hpp"

namespace nearest_point_benchmark {
namespace {

using calligraphy::NearestPoint;
using calligraphy::NearestPointMethod;
using calligraphy::NearestPointOptions;
using calligraphy::StrokeElement;

Answer answer_of(const NearestPoint& foot) { return {foot.parameter, foot.point, foot.distance}; }

/// One call a query.
struct LibraryKernel {
  using Element = StrokeElement;
  NearestPointOptions options;

  Element prepare(const ControlPoints& points) const { return calligraphy::prepare_element(points); }
  void restart() {}
  Answer operator()(const Element& element, const Point& query) const {
    return answer_of(calligraphy::nearest_point(element, query, options));
  }
};

}  // namespace

std::vector<std::unique_ptr<Method>> library_methods() {
  const auto wang2006 = [](double epsilon) {
    return LibraryKernel{{.method = NearestPointMethod::wang2006, .tolerance = epsilon}};
  };
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(method_of("exact", LibraryKernel{}));
  methods.push_back(method_of("wang2006 1e-3", wang2006(1e-3)));
  methods.push_back(method_of("wang2006 1e-6", wang2006(1e-6)));
  methods.push_back(method_of("wang2006 1e-9", wang2006(1e-9)));
  return methods;
}

std::vector<std::unique_ptr<Method>> library_stroke_methods() { return library_methods(); }

}  // namespace nearest_point_benchmark
