// The choice between the paper's printed rules and the revised ones.
#pragma once

namespace calligraphy {

/// Six rules of the paper and their details, all as revised or all as printed (docs/wang2006.md).
enum class Rules {
  /// The force acts towards the stroke and out of the paper, the pen tip stays on the paper (Table 2), positions are
  /// mapped directly, a feature plane counts within the constraint space and near the feature point, the attraction
  /// factor is linear between feature points, and the constraint space is a tube (ConstraintSpace). The nearest point
  /// is searched for near the last one.
  revised,
  /// The pen tip is at the device, eq. (5); positions are integrated from velocities, eq. (3); a feature plane counts
  /// anywhere, eq. (6); the attraction factor is that of the last feature point; the constraint space is the half disc
  /// of sec. 4.3.1, whatever ConstraintSpace says. The nearest point is searched for on the whole element, and contact
  /// and box have no hysteresis. The force acts towards the stroke and out of the paper.
  wang2006
};

/// Whether the rules are the printed ones.
constexpr bool is_printed(Rules rules) noexcept { return rules != Rules::revised; }

}  // namespace calligraphy
