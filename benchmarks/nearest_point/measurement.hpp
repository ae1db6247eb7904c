// Times and errors of one method on one workload.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <span>
#include <string>
#include <vector>

#include "../timing.hpp"
#include "method.hpp"

namespace nearest_point_benchmark {

using timing::Clock, timing::nanoseconds, timing::percentile;

/// Processor time of this thread [ns]: unaffected by other programs while it waits. Too expensive for a single call.
inline double computed_nanoseconds() {
#ifdef CLOCK_THREAD_CPUTIME_ID
  std::timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
#else
  return 1e9 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
#endif
}

/// Over the rounds of a run.
struct Spread {
  double p10 = 0.0, p50 = 0.0, p90 = 0.0;
};

inline Spread spread(std::vector<double> values) {
  return {percentile(values, 0.1), percentile(values, 0.5), percentile(values, 0.9)};
}

/// Errors of distances, relative to the size of the element, against a reference in long double.
struct Errors {
  double largest = 0.0;
  double wrong = 0.0;   ///< fraction of queries off by more than 1e-3: usually another branch
  double beyond = 0.0;  ///< fraction of queries off by more than the workload permits
};

struct Measurement {
  std::string workload;
  std::string method;
  Spread nanoseconds;  ///< per query, or per tick of a whole stroke
  Errors errors;
  double allowed = 1e-9;  ///< maximum permitted error
};

/// The nearest distances of every `stride`-th query, by dense sampling in long double.
class Reference {
 public:
  /// Queries to one element, or to the nearest of several (a stroke).
  void add(std::span<const ControlPoints> elements, std::span<const Point> queries, std::size_t stride);
  /// Compares the answers to the queries added, in order.
  Errors errors(std::span<const Answer> answers, double allowed) const;

 private:
  struct Entry {
    std::size_t query;
    Point at;
    long double distance;
    double size;
  };
  std::vector<Entry> entries_;
  std::size_t queries_ = 0;
};

}  // namespace nearest_point_benchmark
