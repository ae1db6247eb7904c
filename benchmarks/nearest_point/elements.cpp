// Time to prepare an element, and its size.
#include <calligraphy/collision/stroke_element.hpp>
#include <calligraphy/model/character_list.hpp>

#include "experiments/nearest_point_workload.hpp"
#include "experiments/stroke_queries.hpp"
#include "runs.hpp"

namespace nearest_point_benchmark {
namespace {

using calligraphy::StrokeElement;

struct Kind {
  std::string name;
  std::size_t control_points;
  std::size_t bytes;
};

std::vector<ControlPoints> real_elements(std::size_t control_points) {
  std::vector<ControlPoints> elements;
  for (const auto& stroke : calligraphy::stroke_queries(calligraphy::built_in_characters().characters)) {
    for (const ControlPoints& points : stroke.elements) {
      if (points.size() == control_points) elements.push_back(points);
    }
  }
  return elements;
}

void run_kind(benchmark::State& state, const Kind& kind, std::vector<ElementCost>& results) {
  const std::vector<ControlPoints> elements = real_elements(kind.control_points);
  StrokeElement prepared;
  const RoundRobin times = time_in_turn(state, 1, elements.size(), [&](std::size_t) {
    for (const ControlPoints& points : elements) {
      prepared = calligraphy::prepare_element(points);
      benchmark::DoNotOptimize(prepared);
    }
  });
  results.push_back({kind.name, spread(times.of(0)), kind.bytes});
}

}  // namespace

void register_elements(const RunOptions& options, std::vector<ElementCost>& results) {
  static const std::vector<Kind> kinds = {{"LSE", 2, sizeof(calligraphy::detail::LineElement)},
                                          {"CSE", 4, sizeof(calligraphy::detail::CurveElement)}};
  for (const Kind& kind : kinds) {
    benchmark::RegisterBenchmark(("preparing/" + kind.name).c_str(),
                                 [&](benchmark::State& state) { run_kind(state, kind, results); })
        ->Iterations(10 * options.rounds)
        ->UseManualTime()
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace nearest_point_benchmark
