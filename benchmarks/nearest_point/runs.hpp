// The parts of the benchmark; each registers its runs and stores its findings in `results`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "measurement.hpp"
#include "run_options.hpp"

namespace nearest_point_benchmark {

/// Times [ns per query] by method and round.
class RoundRobin {
 public:
  explicit RoundRobin(std::size_t methods) : times_(methods) {}
  void add(std::size_t method, double nanoseconds) { times_[method].push_back(nanoseconds); }
  const std::vector<double>& of(std::size_t method) const { return times_[method]; }

 private:
  std::vector<std::vector<double>> times_;
};

/// Each iteration of `state` is a round in which every method runs once, starting with a different one each time, so
/// that disturbances of the machine affect all alike.
template <typename Run>
RoundRobin time_in_turn(benchmark::State& state, std::size_t methods, std::size_t queries, Run run) {
  RoundRobin times(methods);
  std::size_t round = 0;
  for (auto _ : state) {
    double sum = 0.0;
    for (std::size_t k = 0; k < methods; ++k) {
      const std::size_t method = (k + round) % methods;
      const double start = computed_nanoseconds();
      run(method);
      const double time = computed_nanoseconds() - start;
      times.add(method, time / static_cast<double>(queries));
      sum += time;
    }
    state.SetIterationTime(1e-9 * sum);
    ++round;
  }
  return times;
}

/// The 19 workloads, ns per query.
void register_workloads(std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
                        std::vector<Measurement>& results);
/// Whole strokes, ns per tick.
void register_strokes(const RunOptions& options, std::vector<Measurement>& results);
/// Elements out of the caches, ns per query; nothing is checked.
void register_swept(std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
                    std::vector<Measurement>& results);

/// Single calls, each timed individually.
struct CallTimes {
  std::string method;
  double p50, p99, p999;                       ///< over all calls, including disturbances of the machine [ns]
  double steady_p50, steady_p99, steady_p999;  ///< over the medians of each query over the rounds [ns]
};
void register_calls(std::vector<std::unique_ptr<Method>>& methods, const RunOptions& options,
                    std::vector<CallTimes>& results);

/// Time to prepare an element, and its size.
struct ElementCost {
  std::string kind;
  Spread nanoseconds;  ///< to prepare one
  std::size_t bytes;
};
void register_elements(const RunOptions& options, std::vector<ElementCost>& results);

}  // namespace nearest_point_benchmark
