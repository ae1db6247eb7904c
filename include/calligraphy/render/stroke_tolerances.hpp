// How exactly a stroke must be written to count as the one that is due.
#pragma once

#include <numbers>

namespace calligraphy {

/// Tolerances of the renderer, relative to the character's square and to the stroke, so that they mean the same at
/// every size. JudgeTolerances say what is remarked on whole pen-downs after the event. The default is normal().
struct StrokeTolerances {
  /// A stroke begins within this distance of its start [em].
  double start_distance = 0.2;
  /// Its first stretch runs within this angle of the stroke's own, from the first point to the farthest; otherwise it
  /// does not begin the stroke, until the pen goes back to the start and sets out again [rad].
  double direction = std::numbers::pi / 3.0;
  /// Length of that stretch, at most a quarter of the stroke; longer where the entry of a brush points elsewhere than
  /// what follows (docs/capture.md). Until the pen has gone so far, guidance pulls it across the direction of the
  /// stroke only, not to its start or on along it: it could write another one. 0: only the place counts, as printed
  /// [em].
  double first_stretch = 0.04;
  /// A later stroke of the character is meant, and the due one not begun, when the pen fits that one's start, in place
  /// and direction, better by this factor. Infinite: no other stroke is considered, as printed [1].
  double distinction = 2.0;
  /// Half the width of the corridor about the stroke: only what is written within it counts as covered, and guidance
  /// lets go of a hand that means to be elsewhere. It is wider to the side to which this character's strokes were begun
  /// beside their starts, by as much [em].
  double corridor = 0.06;
  /// Share of the length that must be written in order, less `slack`, before the stroke is finished: at its end, or
  /// where the pen is lifted. 0: the feature planes finish it, as printed [1].
  double coverage = 0.9;
  /// Length that may be missing besides, so that short strokes are taken too [em].
  double slack = 0.04;
  /// Whether a stroke of the right shape that is perhaps too short when the pen is lifted stays due, but is finished
  /// once the pen begins the next one.
  bool next_decides = true;

  /// Whether all are the same.
  bool operator==(const StrokeTolerances&) const = default;

  /// For beginners and for large devices held loosely.
  static constexpr StrokeTolerances lenient() noexcept {
    return {0.25, std::numbers::pi / 2.5, 0.04, 3.0, 0.08, 0.8, 0.06, true};
  }
  /// The default.
  static constexpr StrokeTolerances normal() noexcept { return {}; }
  /// For examinations.
  static constexpr StrokeTolerances strict() noexcept {
    return {0.1, std::numbers::pi / 4.0, 0.04, 1.5, 0.05, 0.95, 0.02, false};
  }
};

/// @throws ValueError naming the tolerance and its value when one is out of range or not finite; only `distinction` may
/// be infinite
void validate(const StrokeTolerances& tolerances);

}  // namespace calligraphy
