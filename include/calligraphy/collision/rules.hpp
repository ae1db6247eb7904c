// Which rules hold where the paper's printed ones were revised.
#pragma once

namespace calligraphy {

/// The rules of the paper that decide what a pen feels: all as revised, or all as printed (docs/wang2006.md lists them
/// side by side). What they are about is, in this order, the sign of eq. (8) and (9), the pen tip below the paper, the
/// motion mapping, the feature planes, the attraction between feature points and the constraint space.
enum class Rules {
  /// Towards the stroke and out of the paper; on the paper (Table 2); the map that eq. (3) integrates to; crossed
  /// within
  /// the constraint space and near the feature point; linear in arc length; a tube with a smooth edge.
  revised,
  /// As in the first; at the device, eq. (5); eq. (3) tick by tick; crossed anywhere, eq. (6); that of the last feature
  /// point passed, so that the force steps at each; sec. 4.3.1 (a)-(d). Nor is there a hysteresis anywhere.
  wang2006,
  /// As wang2006, with the signs of eq. (8) and (9) as in the available text, which may have lost them: away from the
  /// stroke and into the paper. Nothing can be written with them.
  wang2006_signs
};

/// Whether the rules are the printed ones, whatever their signs.
constexpr bool is_printed(Rules rules) noexcept { return rules != Rules::revised; }

}  // namespace calligraphy
