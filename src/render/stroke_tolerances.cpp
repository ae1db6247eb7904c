#include <calligraphy/render/stroke_tolerances.hpp>

#include <numbers>

#include "base/require.hpp"

namespace calligraphy {

void validate(const StrokeTolerances& tolerances) {
  require_above_zero("tolerances.start_distance", tolerances.start_distance, "em");
  require_above_zero("tolerances.direction", tolerances.direction, "rad", std::numbers::pi);
  require_not_negative("tolerances.first_stretch", tolerances.first_stretch, "em");
  require(tolerances.distinction >= 1.0, "tolerances.distinction", tolerances.distinction, "", "at least 1");
  require_above_zero("tolerances.corridor", tolerances.corridor, "em");
  require_within("tolerances.coverage", tolerances.coverage, "", 0.0, 1.0);
  require_not_negative("tolerances.slack", tolerances.slack, "em");
  require_above_zero("tolerances.evidence", tolerances.evidence, "");
}

}  // namespace calligraphy
