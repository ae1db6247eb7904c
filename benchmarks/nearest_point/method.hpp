// A nearest-point method, in a form that the benchmark can run uniformly.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace nearest_point_benchmark {

using calligraphy::Point;

using ControlPoints = std::vector<Point>;  ///< two, a line, or four, a cubic

/// The result that every method must store for each query.
struct Answer {
  double parameter;
  Point point;
  double distance;
};

/// Prepared for some elements outside the timing, then queried. A call answers many queries, which makes the cost of
/// the virtual call negligible.
class Method {
 public:
  explicit Method(std::string name) : name_(std::move(name)) {}
  virtual ~Method() = default;
  const std::string& name() const { return name_; }

  virtual void prepare(std::span<const ControlPoints> elements) = 0;
  /// Every query to one element.
  virtual void answer(std::size_t element, std::span<const Point> queries, std::span<Answer> answers) = 0;
  /// Query i to elements[i].
  virtual void answer_each(std::span<const std::size_t> elements, std::span<const Point> queries,
                           std::span<Answer> answers) = 0;
  /// The path of the pen along a stroke made of the elements first to last - 1: the nearest point of all of them at
  /// each tick.
  virtual void follow(std::size_t first, std::size_t last, std::span<const Point> path, std::span<Answer> answers) = 0;

 private:
  std::string name_;
};

/// A method from a kernel: `Element prepare(const ControlPoints&)`, `Answer operator()(const Element&, const Point&)`,
/// and `restart()` before a series of queries. Every call of the kernel can be inlined.
template <typename Kernel>
class MethodOf : public Method {
 public:
  MethodOf(std::string name, Kernel kernel) : Method(std::move(name)), kernel_(std::move(kernel)) {}

  void prepare(std::span<const ControlPoints> elements) override {
    elements_.clear();
    elements_.reserve(elements.size());
    for (const ControlPoints& points : elements) elements_.push_back(kernel_.prepare(points));
  }
  void answer(std::size_t element, std::span<const Point> queries, std::span<Answer> answers) override {
    kernel_.restart();
    for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = kernel_(elements_[element], queries[i]);
  }
  void answer_each(std::span<const std::size_t> elements, std::span<const Point> queries,
                   std::span<Answer> answers) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      kernel_.restart();
      answers[i] = kernel_(elements_[elements[i]], queries[i]);
    }
  }
  void follow(std::size_t first, std::size_t last, std::span<const Point> path, std::span<Answer> answers) override {
    kernel_.restart();
    for (std::size_t i = 0; i < path.size(); ++i) {
      answers[i] = kernel_(elements_[first], path[i]);
      for (std::size_t element = first + 1; element < last; ++element) {
        const Answer other = kernel_(elements_[element], path[i]);
        if (other.distance < answers[i].distance) answers[i] = other;
      }
    }
  }

 protected:
  Kernel kernel_;
  std::vector<typename Kernel::Element> elements_;
};

template <typename Kernel>
std::unique_ptr<Method> method_of(std::string name, Kernel kernel) {
  return std::make_unique<MethodOf<Kernel>>(std::move(name), std::move(kernel));
}

/// The methods of this library, in the order of the table: for queries to one curve, and for whole strokes.
std::vector<std::unique_ptr<Method>> library_methods();
std::vector<std::unique_ptr<Method>> library_stroke_methods();
/// The paper's rule with de Casteljau's algorithm, as printed.
std::vector<std::unique_ptr<Method>> paper_methods();
/// Empty where the peer was not built in.
std::vector<std::unique_ptr<Method>> kurbo_methods();
std::vector<std::unique_ptr<Method>> lib2geom_methods();

/// All available methods.
std::vector<std::unique_ptr<Method>> workload_methods();
std::vector<std::unique_ptr<Method>> stroke_methods();

}  // namespace nearest_point_benchmark
