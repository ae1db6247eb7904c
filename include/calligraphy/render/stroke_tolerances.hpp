// How exactly a stroke must be written to count as the one that is due.
#pragma once

#include <numbers>

namespace calligraphy {

/// Tolerances of the renderer and of match_strokes(), relative to the character's square and to the stroke, so that
/// they mean the same at every size. match_strokes() judges whole pen-downs after the event, so it needs only
/// `direction` and `distinction`. The default is normal().
struct StrokeTolerances {
  /// A stroke begins within this distance of its start [em].
  double start_distance = 0.2;
  /// Its first stretch runs within this angle of the stroke's own [rad].
  double direction = std::numbers::pi / 3.0;
  /// Length over which that direction is judged, at most a quarter of the stroke [em]; more where it contradicts what
  /// follows (docs/capture.md). Until then guidance acts across
  /// it only, so that the pen cannot be led along a stroke that it was not to write. 0: only the place counts, as
  /// printed.
  double first_stretch = 0.04;
  /// A later stroke of the character is meant when its start fits better by this factor; infinite: no other stroke is
  /// considered, as printed.
  double distinction = 2.0;
  /// Half the width of the corridor about the stroke, beyond what the writer is off by anyway [em].
  double corridor = 0.06;
  /// Share of the length that must be written in order before the stroke is finished: at its end, or where the pen is
  /// lifted. 0: the feature planes finish it, as printed.
  double coverage = 0.9;
  /// Length that may be missing besides, so that short strokes are taken too [em].
  double slack = 0.04;

  /// For beginners and for large devices held loosely.
  static constexpr StrokeTolerances lenient() noexcept {
    return {0.25, std::numbers::pi / 2.5, 0.04, 3.0, 0.08, 0.8, 0.06};
  }
  /// The default.
  static constexpr StrokeTolerances normal() noexcept { return {}; }
  /// For examinations.
  static constexpr StrokeTolerances strict() noexcept {
    return {0.1, std::numbers::pi / 4.0, 0.04, 1.5, 0.05, 0.95, 0.02};
  }
};

/// @throws ValueError naming the tolerance and its value when one is out of range or not finite; only `distinction` may
/// be infinite
void validate(const StrokeTolerances& tolerances);

}  // namespace calligraphy
