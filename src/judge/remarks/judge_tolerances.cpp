#include <calligraphy/judge/judge_tolerances.hpp>

#include "base/require.hpp"

namespace calligraphy {

void validate(const JudgeTolerances& tolerances) {
  require_above_zero("tolerances.evidence", tolerances.evidence, "");
}

}  // namespace calligraphy
