// The methods of this library.
#include <calligraphy/collision/nearest_stroke_point.hpp>
#include <calligraphy/collision/stroke_tracker.hpp>

#include "method.hpp"

namespace nearest_point_benchmark {
namespace {

using calligraphy::NearestPoint;
using calligraphy::NearestPointMethod;
using calligraphy::NearestPointOptions;
using calligraphy::StrokeElement;

Answer answer_of(const NearestPoint& closest) { return {closest.parameter, closest.point, closest.distance}; }

/// One call per query.
struct LibraryKernel {
  using Element = StrokeElement;
  NearestPointOptions options;

  Element prepare(const ControlPoints& points) const { return calligraphy::prepare_element(points); }
  void restart() {}
  Answer operator()(const Element& element, const Point& query) const {
    return answer_of(calligraphy::nearest_point(element, query, options));
  }
};

/// Each query starts from the answer to the one before.
struct TrackedKernel : LibraryKernel {
  double start = 0.5;

  void restart() { start = 0.5; }
  Answer operator()(const Element& element, const Point& query) {
    const Answer answer = answer_of(calligraphy::nearest_point(element, query, options, {}, start));
    start = answer.parameter;
    return answer;
  }
};

/// All queries to an element, or to a stroke, in one call.
class Batched : public MethodOf<LibraryKernel> {
 public:
  using MethodOf::MethodOf;
  void answer(std::size_t element, std::span<const Point> queries, std::span<Answer> answers) override {
    feet_.resize(queries.size());
    calligraphy::nearest_points(elements_[element], queries, feet_, kernel_.options);
    for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = answer_of(feet_[i]);
  }
  void follow(std::size_t first, std::size_t last, std::span<const Point> path, std::span<Answer> answers) override {
    feet_on_stroke_.resize(path.size());
    calligraphy::nearest_points(std::span(elements_).subspan(first, last - first), path, feet_on_stroke_,
                                kernel_.options);
    for (std::size_t i = 0; i < path.size(); ++i) answers[i] = answer_of(feet_on_stroke_[i].closest);
  }

 private:
  std::vector<NearestPoint> feet_;
  std::vector<calligraphy::StrokePoint> feet_on_stroke_;
};

/// Over the elements of a stroke.
class Tracker : public MethodOf<LibraryKernel> {
 public:
  using MethodOf::MethodOf;
  void follow(std::size_t first, std::size_t last, std::span<const Point> path, std::span<Answer> answers) override {
    calligraphy::StrokeTracker tracker{std::span(elements_).subspan(first, last - first)};
    for (std::size_t i = 0; i < path.size(); ++i) answers[i] = answer_of(tracker.update(path[i]).closest);
  }
};

LibraryKernel sampled(int samples, int refinements) {
  return {{.method = NearestPointMethod::sampled, .samples = samples, .refinements = refinements}};
}

LibraryKernel wang2006(double epsilon) { return {{.method = NearestPointMethod::wang2006, .tolerance = epsilon}}; }

std::vector<std::unique_ptr<Method>> approximate_methods() {
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(method_of("sampled 16 + 1", sampled(16, 1)));
  methods.push_back(method_of("sampled 16 + 2", sampled(16, 2)));
  methods.push_back(method_of("sampled 32 + 2", sampled(32, 2)));
  methods.push_back(method_of("wang2006 1e-3", wang2006(1e-3)));
  methods.push_back(method_of("wang2006 1e-6", wang2006(1e-6)));
  methods.push_back(method_of("wang2006 1e-9", wang2006(1e-9)));
  return methods;
}

}  // namespace

std::vector<std::unique_ptr<Method>> library_methods() {
  const NearestPointOptions tracked{.method = NearestPointMethod::tracked};
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(method_of("exact", LibraryKernel{}));
  methods.push_back(std::make_unique<Batched>("exact, batched", LibraryKernel{}));
  methods.push_back(method_of("tracked", TrackedKernel{{tracked}}));
  for (auto& method : approximate_methods()) methods.push_back(std::move(method));
  return methods;
}

std::vector<std::unique_ptr<Method>> library_stroke_methods() {
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(std::make_unique<Tracker>("StrokeTracker", LibraryKernel{}));
  methods.push_back(method_of("exact", LibraryKernel{}));
  methods.push_back(std::make_unique<Batched>("exact, batched", LibraryKernel{}));
  for (auto& method : approximate_methods()) methods.push_back(std::move(method));
  return methods;
}

}  // namespace nearest_point_benchmark
