// The 19 workloads: all methods on the same queries, in turn.
#include <numeric>

#include <benchmark/benchmark.h>

#include <calligraphy/model/character_list.hpp>

#include "bezier_js.hpp"
#include "experiments/nearest_point_workload.hpp"
#include "runs.hpp"

namespace nearest_point_benchmark {
namespace {

using calligraphy::CurveQueries;
using calligraphy::NearestPointWorkload;

void answer_all(Method& method, const NearestPointWorkload& workload, std::span<Answer> answers) {
  std::size_t first = 0;
  for (std::size_t k = 0; k < workload.curves.size(); ++k) {
    const auto& queries = workload.curves[k].queries;
    method.answer(k, queries, answers.subspan(first, queries.size()));
    first += queries.size();
  }
}

Reference reference_of(const NearestPointWorkload& workload, std::size_t stride) {
  Reference reference;
  for (const CurveQueries& asked : workload.curves) {
    reference.add(std::span(&asked.control_points, 1), asked.queries, stride);
  }
  return reference;
}

void run_workload(benchmark::State& state, const NearestPointWorkload& workload,
                  std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
                  std::vector<Measurement>& results) {
  std::vector<ControlPoints> curves;
  std::size_t count = 0;
  for (const CurveQueries& asked : workload.curves) {
    curves.push_back(asked.control_points);
    count += asked.queries.size();
  }
  const Reference reference = reference_of(workload, options.reference_stride);
  std::vector<Answer> answers(count);
  std::vector<Errors> errors;
  for (auto& method : methods) {
    method->prepare(curves);
    answer_all(*method, workload, answers);
    errors.push_back(reference.errors(answers, workload.allowed_error));
  }
  const RoundRobin times = time_in_turn(state, methods.size(), count, [&](std::size_t m) {
    answer_all(*methods[m], workload, answers);
    benchmark::DoNotOptimize(answers.data());
  });
  for (std::size_t m = 0; m < methods.size(); ++m) {
    results.push_back({workload.name, methods[m]->name(), spread(times.of(m)), errors[m], workload.allowed_error});
    state.counters[methods[m]->name()] = results.back().nanoseconds.p50;
  }
  if (!options.bezier_js.empty()) {
    const BezierJsRun peer = run_bezier_js(options.bezier_js, workload.curves, options.rounds / 4 + 1);
    results.push_back({workload.name, bezier_js_name, spread(peer.nanoseconds),
                       reference.errors(peer.answers, workload.allowed_error), workload.allowed_error});
    state.counters[bezier_js_name] = results.back().nanoseconds.p50;
  }
}

}  // namespace

void register_workloads(std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
                        std::vector<Measurement>& results) {
  static std::vector<NearestPointWorkload> workloads;
  workloads = calligraphy::nearest_point_workloads(
      calligraphy::curve_control_points(calligraphy::built_in_characters().characters), options.queries);
  for (const NearestPointWorkload& workload : workloads) {
    benchmark::RegisterBenchmark(
        ("workload/" + workload.name).c_str(),
        [&](benchmark::State& state) { run_workload(state, workload, methods, options, results); })
        ->Iterations(options.rounds)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace nearest_point_benchmark
