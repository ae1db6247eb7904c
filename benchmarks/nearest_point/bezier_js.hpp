// bezier.js (npm bezier-js) in its own process: queries, times and answers are exchanged through files.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/nearest_point_workload.hpp"
#include "method.hpp"

namespace nearest_point_benchmark {

inline constexpr const char* bezier_js_name = "bezier.js project";

struct BezierJsRun {
  std::vector<double> nanoseconds;  ///< per query, by round
  std::vector<Answer> answers;
};

/// `package`: the unpacked npm package. Preparation (its table of 100 points) is not timed, as for the others.
/// @throws calligraphy::Error when node cannot be run or fails
BezierJsRun run_bezier_js(const std::string& package, std::span<const calligraphy::CurveQueries> curves, int rounds);

}  // namespace nearest_point_benchmark
