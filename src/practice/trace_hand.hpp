// A hand that moves as a person's pen did.
#pragma once

#include <vector>

#include <calligraphy/collision/placed_character.hpp>
#include <calligraphy/practice/pen_path.hpp>
#include <calligraphy/practice/pen_trace.hpp>

namespace calligraphy {

/// Where a person means the pen to be: on the paper as in the trace, with its own speed, pressed a little below it; in
/// the air raised, over a way of least jerk, in the person's own time, or longer where that is too short for a pen of
/// mass to be raised, moved and lowered. The box of the person's writing is brought onto that of the character by
/// fit_box. The hand does not look: what guides the pen is felt, not followed.
class TraceHand {
 public:
  /// `start`: where the pen is at time 0 [page, m].
  /// @throws ValueError when the trace has no point or one that is not finite, or its times fall
  TraceHand(const PenTrace& trace, const PlacedCharacter& placed, const Eigen::Vector3d& start);

  /// Until the pen rests above the end of the last stroke [s].
  double duration() const noexcept { return knots_.back().time; }
  /// At a time since the start [s]; the page's axes [m].
  Eigen::Vector3d at(double time) const noexcept;

 private:
  struct Knot {
    double time;
    Eigen::Vector3d point;
  };

  void move(const Eigen::Vector3d& to, double seconds);
  void write(const PenStroke& stroke, const BoxMap& map, const Placement& placement);

  std::vector<Knot> knots_;  ///< by time
};

}  // namespace calligraphy
