// Runs one method on one workload for callgrind, which counts only within `measured`. See instructions.py.
#include <cstdio>

#include <CLI/CLI.hpp>

#include <calligraphy/model/character_list.hpp>

#include "experiments/nearest_point_workload.hpp"
#include "method.hpp"

using namespace nearest_point_benchmark;

/// The name at which callgrind toggles collection.
extern "C" __attribute__((noinline)) void measured(Method& method, std::size_t element, std::span<const Point> queries,
                                                   std::span<Answer> answers) {
  method.answer(element, queries, answers);
}

int main(int argc, char** argv) {
  CLI::App app("Run one nearest-point method on one workload, for callgrind");
  std::string method_name, workload_name;
  int queries = 2048;
  bool list = false;
  app.add_option("--method", method_name);
  app.add_option("--workload", workload_name);
  app.add_option("--queries", queries)->check(CLI::PositiveNumber);
  app.add_flag("--list", list, "List the names of the methods");
  CLI11_PARSE(app, argc, argv);

  for (const auto& method : workload_methods()) {
    if (list) std::puts(method->name().c_str());
    if (method->name() != method_name) continue;
    for (const auto& workload : calligraphy::nearest_point_workloads(
             calligraphy::curve_control_points(calligraphy::built_in_characters().characters), queries)) {
      if (workload.name != workload_name) continue;
      std::vector<ControlPoints> curves;
      for (const auto& asked : workload.curves) curves.push_back(asked.control_points);
      method->prepare(curves);
      double sum = 0.0;
      std::vector<Answer> answers(static_cast<std::size_t>(queries));
      for (std::size_t k = 0; k < curves.size(); ++k) {
        measured(*method, k, workload.curves[k].queries, answers);
        sum += answers[0].distance;
      }
      std::printf("%d queries, sum of some distances %g\n", queries, sum);
      return 0;
    }
  }
  return list ? 0 : 1;
}
