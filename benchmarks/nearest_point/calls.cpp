// Single calls, each timed individually: percentiles, and the cost with cold caches.
#include <algorithm>
#include <numeric>

#include <calligraphy/model/character_list.hpp>

#include "experiments/nearest_point_workload.hpp"
#include "runs.hpp"

namespace nearest_point_benchmark {
namespace {

using calligraphy::CurveQueries;

std::vector<ControlPoints> real_curves() {
  return calligraphy::curve_control_points(calligraphy::built_in_characters().characters);
}

/// The pen near real strokes.
std::vector<CurveQueries> real_queries(int queries) {
  for (const auto& workload : calligraphy::nearest_point_workloads(real_curves(), queries)) {
    if (workload.name == "real strokes near") return workload.curves;
  }
  return {};
}

/// Time of one call, including reading the clock.
double time_call(Method& method, std::size_t element, const Point& query) {
  Answer answer;
  const auto start = Clock::now();
  method.answer(element, std::span(&query, 1), std::span(&answer, 1));
  const double time = nanoseconds(Clock::now() - start);
  benchmark::DoNotOptimize(answer);
  return time;
}

double time_clock() {
  const auto start = Clock::now();
  return nanoseconds(Clock::now() - start);
}

struct Call {
  std::size_t element;
  Point query;
};

CallTimes summary(const std::string& name, std::vector<std::vector<double>>& by_query) {
  std::vector<double> all, medians;
  for (std::vector<double>& times : by_query) {
    all.insert(all.end(), times.begin(), times.end());
    medians.push_back(percentile(times, 0.5));
  }
  return {name,
          percentile(all, 0.5),
          percentile(all, 0.99),
          percentile(all, 0.999),
          percentile(medians, 0.5),
          percentile(medians, 0.99),
          percentile(medians, 0.999)};
}

void run_calls(benchmark::State& state, std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
               std::vector<CallTimes>& results) {
  std::vector<ControlPoints> curves;
  std::vector<Call> calls;
  for (const CurveQueries& asked : real_queries(options.queries)) {
    for (const Point& query : asked.queries) calls.push_back({curves.size(), query});
    curves.push_back(asked.control_points);
  }
  for (auto& method : methods) method->prepare(curves);
  std::vector<std::vector<std::vector<double>>> times(methods.size() + 1,
                                                      std::vector<std::vector<double>>(calls.size()));
  const RoundRobin rounds = time_in_turn(state, methods.size() + 1, calls.size(), [&](std::size_t m) {
    for (std::size_t i = 0; i < calls.size(); ++i) {
      times[m][i].push_back(m < methods.size() ? time_call(*methods[m], calls[i].element, calls[i].query)
                                               : time_clock());
    }
  });
  for (std::size_t m = 0; m < methods.size(); ++m) results.push_back(summary(methods[m]->name(), times[m]));
  results.push_back(summary("(the clock alone)", times.back()));
}

/// So many elements that each has left the near caches when its turn comes; one query each, in random order.
void run_many_elements(benchmark::State& state, std::vector<std::unique_ptr<Method>>& methods,
                       const RunOptions& options, std::vector<Measurement>& results) {
  const auto asked = real_queries(static_cast<int>(options.swept_elements));
  std::vector<ControlPoints> elements;
  std::vector<Point> queries;
  for (const CurveQueries& curve : asked) {
    elements.insert(elements.end(), curve.queries.size(), curve.control_points);
    queries.insert(queries.end(), curve.queries.begin(), curve.queries.end());
  }
  // A full cycle through all of them: step and count are coprime.
  std::size_t step = elements.size() * 5 / 8 + 1;
  while (std::gcd(step, elements.size()) != 1) ++step;
  std::vector<std::size_t> order;
  std::vector<Point> ordered;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    order.push_back(i * step % elements.size());
    ordered.push_back(queries[order.back()]);
  }
  std::vector<Answer> answers(order.size());
  for (auto& method : methods) {
    method->prepare(elements);
    method->answer_each(order, ordered, answers);
  }
  const RoundRobin times = time_in_turn(state, methods.size(), order.size(), [&](std::size_t m) {
    methods[m]->answer_each(order, ordered, answers);
    benchmark::DoNotOptimize(answers.data());
  });
  for (std::size_t m = 0; m < methods.size(); ++m) {
    results.push_back({"many elements", methods[m]->name(), spread(times.of(m)), {}});
  }
}

/// One call at a time after reading more memory than the near caches hold: code and data come from farther away, as in
/// a servo loop that shares its core.
void run_swept(benchmark::State& state, std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
               std::vector<Measurement>& results) {
  std::vector<ControlPoints> curves;
  std::vector<Point> queries;
  for (const CurveQueries& asked : real_queries(64)) {
    curves.push_back(asked.control_points);
    queries.push_back(asked.queries.front());
  }
  for (auto& method : methods) method->prepare(curves);
  std::vector<std::uint64_t> memory(options.sweep_bytes / sizeof(std::uint64_t), 1);
  std::vector<std::vector<double>> times(methods.size());
  std::size_t call = 0;
  for (auto _ : state) {
    double sum = 0.0;
    for (std::size_t k = 0; k < methods.size(); ++k) {
      benchmark::DoNotOptimize(std::accumulate(memory.begin(), memory.end(), std::uint64_t{0}));
      time_clock();  // warms up the code of the clock
      const std::size_t m = (k + call) % methods.size(), at = call % curves.size();
      times[m].push_back(time_call(*methods[m], at, queries[at]));
      sum += times[m].back();
    }
    state.SetIterationTime(1e-9 * sum);
    ++call;
  }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    results.push_back({"after a sweep", methods[m]->name(), spread(times[m]), {}});
  }
}

}  // namespace

void register_calls(std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
                    std::vector<CallTimes>& results) {
  benchmark::RegisterBenchmark("single calls",
                               [&](benchmark::State& state) { run_calls(state, methods, options, results); })
      ->Iterations(options.rounds)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

void register_swept(std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
                    std::vector<Measurement>& results) {
  benchmark::RegisterBenchmark("swept caches/many elements",
                               [&](benchmark::State& state) { run_many_elements(state, methods, options, results); })
      ->Iterations(options.rounds)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("swept caches/after a sweep",
                               [&](benchmark::State& state) { run_swept(state, methods, options, results); })
      ->Iterations(4 * options.rounds)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace nearest_point_benchmark
