// Writing for hours or days in virtual time, with random faults, while every guarantee of the loop is checked.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy_test {

struct SoakOptions {
  std::uint64_t ticks = 1'000'000;
  std::uint64_t seed = 1;                  ///< of the hand and of the faults
  std::string composition = "everything";  ///< or "default"
  std::string device = "omni";
  bool faults = true;

  calligraphy::RendererOptions renderer_options() const;
};

/// What was seen, tick by tick.
struct Watched {
  std::uint64_t faults = 0, bad_ticks = 0, not_finite = 0, above_peak = 0, steps_too_large = 0, strokes = 0,
                allocations = 0;
  std::uint64_t felt_late = 0;  ///< ticks of the last tenth with a force above 0.1 N
  double max_force = 0.0, max_step = 0.0;
  double given = 0.0, max_given = 0.0, min_given = 0.0;  ///< net work of the force actually applied [J]
  bool page_was_too_short = false;
};

/// Writes. `progress`, if any, is told the share that is done, now and then.
Watched soak(const SoakOptions& options, const std::function<void(double)>& progress = nullptr);

struct Guarantee {
  const char* text;
  bool kept;
};

std::vector<Guarantee> guarantees(const SoakOptions& options, const Watched& watched);

}  // namespace calligraphy_test
