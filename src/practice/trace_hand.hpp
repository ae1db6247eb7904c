// A hand that follows a person's recorded pen.
#pragma once

#include <vector>

#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/model/placed_character.hpp>

namespace calligraphy {

/// The intended position of a person's pen. On the paper it follows the trace at the person's own speed, pressed
/// slightly below the surface; in the air it is raised and moves with minimum jerk, taking as long as the person did,
/// or longer if that is too short to raise, move and lower a pen with mass. fit_box maps the bounding box of the
/// writing onto that of the character. The hand has no visual feedback: it feels the guidance but does not adapt to it.
class TraceHand {
 public:
  /// Where the pen is meant to be, and what it senses: on the paper, what the person's did.
  struct Pen {
    Eigen::Vector3d point;  ///< [m, page]
    StylusState stylus = {};
  };

  /// `start`: position of the pen at time 0 [m, page].
  /// @throws ValueError when the trace has no point or one that is not finite, or its times decrease
  TraceHand(const PenTrace& trace, const PlacedCharacter& placed, const Eigen::Vector3d& start);

  /// Time until the pen rests above the end of the last stroke [s].
  double duration() const noexcept { return knots_.back().time; }
  /// The pen at a time since the start [s].
  Pen at(double time) const noexcept;

 private:
  struct Knot {
    double time;
    Eigen::Vector3d point;
    StylusState stylus = {};  ///< until the next knot
  };

  void move(const Eigen::Vector3d& to, double seconds);
  void write(const PenStroke& stroke, const BoxMap& map, const Placement& placement);

  std::vector<Knot> knots_;  ///< in order of time
};

}  // namespace calligraphy
