#include "method.hpp"

namespace nearest_point_benchmark {
namespace {

void append(std::vector<std::unique_ptr<Method>>& methods, std::vector<std::unique_ptr<Method>> more) {
  for (auto& method : more) methods.push_back(std::move(method));
}

void append_others(std::vector<std::unique_ptr<Method>>& methods) {
  append(methods, paper_methods());
  append(methods, kurbo_methods());
  append(methods, lib2geom_methods());
}

}  // namespace

std::vector<std::unique_ptr<Method>> workload_methods() {
  std::vector<std::unique_ptr<Method>> methods = library_methods();
  append_others(methods);
  return methods;
}

std::vector<std::unique_ptr<Method>> stroke_methods() {
  std::vector<std::unique_ptr<Method>> methods = library_stroke_methods();
  append_others(methods);
  return methods;
}

}  // namespace nearest_point_benchmark
