// The tables printed at the end of the benchmark.
#pragma once

#include <cstdio>
#include <span>

#include "runs.hpp"

namespace nearest_point_benchmark {

/// Method x nanoseconds on selected workloads, the geometric mean of all, and the errors; then the ratios of `exact` to
/// each method, with their targets.
void print_workloads(std::FILE* out, std::span<const Measurement> results);
/// Every workload x method: p50, with p10 to p90.
void print_details(std::FILE* out, std::span<const Measurement> results);
void print_strokes(std::FILE* out, std::span<const Measurement> results);
void print_swept(std::FILE* out, std::span<const Measurement> results);
void print_calls(std::FILE* out, std::span<const CallTimes> results);
void print_elements(std::FILE* out, std::span<const ElementCost> results);

}  // namespace nearest_point_benchmark
