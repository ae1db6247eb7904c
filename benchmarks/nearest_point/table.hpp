// The tables that the benchmark prints at its end.
#pragma once

#include <cstdio>
#include <span>

#include "runs.hpp"

namespace nearest_point_benchmark {

/// Method x nanoseconds on the workloads that stand out, the geometric mean of all, and the errors; then the ratios to
/// `exact` and the marks set for them.
void print_workloads(std::FILE* out, std::span<const Measurement> results);
/// Every workload x method: p50, and p10 to p90 beside.
void print_details(std::FILE* out, std::span<const Measurement> results);
void print_strokes(std::FILE* out, std::span<const Measurement> results);
void print_swept(std::FILE* out, std::span<const Measurement> results);
void print_calls(std::FILE* out, std::span<const CallTimes> results);
void print_elements(std::FILE* out, std::span<const ElementCost> results);

}  // namespace nearest_point_benchmark
