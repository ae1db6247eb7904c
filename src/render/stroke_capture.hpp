// Decides whether a pen-down begins the stroke that is due: by its place, its first direction, and the other strokes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/stroke_tolerances.hpp>

namespace calligraphy {

/// The first stretch of a stroke on the page.
struct StrokeStart {
  Point point = Point::Zero();
  Point direction = Point::Zero();  ///< unit vector; zero for a stroke without length
  double stretch = 0.0;             ///< length over which the direction is judged [m]
  bool bends = false;               ///< judged over a longer stretch than usual, within which the stroke turns
  double min_cosine = -2.0;         ///< of the angle to a way in a tolerated direction; -2: in any
};

/// The starts of all strokes of a character.
std::vector<StrokeStart> stroke_starts(const PlacedCharacter& placed, const StrokeTolerances& tolerances);

enum class CaptureVerdict {
  undecided,        ///< the pen has not moved far enough, or is too far from the start
  begun,            ///< it writes the stroke that is due
  wrong_direction,  ///< near the start, but going another way; it may still turn
  another_stroke    ///< it writes another one, until it is lifted
};

/// Judges one pen-down after another within a character. Never allocates.
class StrokeCapture {
 public:
  /// Begins a new character: nothing is known about where the writer sees it.
  void restart() noexcept { *this = {}; }

  /// The pen was put down at `tip` [m, page], with stroke `due` of `starts` to be written.
  void put_down(const Point& tip, std::span<const StrokeStart> starts, std::size_t due) noexcept;

  /// The pen is at `tip`, and stroke `due` of `starts` is to be written; `em` [m].
  CaptureVerdict update(const Point& tip, std::span<const StrokeStart> starts, std::size_t due, double em,
                        const StrokeTolerances& tolerances) noexcept;

  /// How badly the pen's way from where it was put down to `tip` fits the start of a stroke; 1 at the tolerances.
  double misfit_to(const StrokeStart& start, const Point& tip, double em,
                   const StrokeTolerances& tolerances) const noexcept;

  CaptureVerdict verdict() const noexcept { return verdict_; }
  /// Whether the start of the due stroke was the nearest of those to come when the pen was put down.
  bool is_nearest() const noexcept { return is_nearest_; }

  /// Where the stroke was begun [m, page].
  const Point& begin() const noexcept { return anchor_; }
  /// The same without the way on which it approached the stroke.
  const Point& own_begin() const noexcept { return own_begin_; }

  /// Average offset at which the strokes of this character were begun [m]; the first ones count for little.
  Point misplaced() const noexcept { return misplaced_ / (count_ + 1); }

  /// Where the pen was put down [m, page].
  const Point& down() const noexcept { return down_; }
  /// The stroke that begins at `start`, for which the pen was put down at `down`, was written to its end: writers
  /// misplace the strokes of a character alike.
  void written(const Point& start, const Point& down) noexcept;

 private:
  Point anchor_ = Point::Zero();  ///< follows the pen at the length of the first stretch
  Point own_begin_ = Point::Zero();
  Point down_ = Point::Zero();  ///< where the pen was put down
  CaptureVerdict verdict_ = CaptureVerdict::undecided;
  bool is_nearest_ = false;
  bool is_first_ = true;             ///< the pen has not yet written a first stretch since it was put down
  Point misplaced_ = Point::Zero();  ///< sum over the strokes written so far [m]
  int count_ = 0;
};

}  // namespace calligraphy
