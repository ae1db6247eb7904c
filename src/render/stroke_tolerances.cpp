#include <calligraphy/render/stroke_tolerances.hpp>

#include <numbers>

#include "base/require.hpp"

namespace calligraphy {

void validate(const StrokeTolerances& tolerances) {
  constexpr const char* resolution = "the pen is looked at each 0.01 em";
  require_within("tolerances.start_distance", tolerances.start_distance, "em", 0.01, 2.0, resolution);
  require_above_zero("tolerances.direction", tolerances.direction, "rad", std::numbers::pi);
  require(tolerances.direction >= 0.1, "tolerances.direction", tolerances.direction, "rad",
          "at least 0.1: no hand sets out so exactly");
  require_within("tolerances.first_stretch", tolerances.first_stretch, "em", 0.0, 1.0);
  require(tolerances.distinction >= 1.0, "tolerances.distinction", tolerances.distinction, "", "at least 1");
  require_within("tolerances.corridor", tolerances.corridor, "em", 0.01, 0.5, resolution);
  require_within("tolerances.coverage", tolerances.coverage, "", 0.0, 1.0);
  require_within("tolerances.slack", tolerances.slack, "em", 0.0, 0.5, "more is longer than most strokes");
}

}  // namespace calligraphy
