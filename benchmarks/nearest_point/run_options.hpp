// Options of the benchmark.
#pragma once

#include <cstddef>
#include <string>

namespace nearest_point_benchmark {

struct RunOptions {
  int queries = 16000;                ///< per workload
  int rounds = 21;                    ///< each round times every method once
  int characters = 0;                 ///< number of characters whose strokes are written whole; 0: all
  std::size_t reference_stride = 16;  ///< one of this many queries is checked
  std::size_t tick_stride = 128;      ///< one of this many ticks of a stroke is checked
  std::string bezier_js;              ///< unpacked npm package bezier-js; empty: omitted
  std::size_t swept_elements = 20000;
  std::size_t sweep_bytes = std::size_t{32} << 20;  ///< read between two calls, to empty the caches near the core
};

}  // namespace nearest_point_benchmark
