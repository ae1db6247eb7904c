// How much of a stroke a pen has written, in order: a corridor about the stroke, decided tick by tick.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/render/stroke_tolerances.hpp>

namespace calligraphy {

/// The stroke is a row of points at equal arc length. A point is free while it is abreast of the pen and near enough.
/// Which points the pen can have reached in order, each while it was free, follows step by step from the recurrence
/// that decides whether a discrete Frechet distance is within a bound (Eiter and Mannila, Computing discrete Frechet
/// distance, 1994). The writer's offset is allowed for, as docs/capture.md explains. Only load() allocates.
class StrokeFollower {
 public:
  /// Loads the stroke to be written, in a square of `em` [m]. Takes a few microseconds. `servo_rate`: of the updates
  /// [Hz], over which a first stretch is spread; at 0, which stands for one that is not known, it is not.
  void load(const ActiveStroke& stroke, double em, const StrokeTolerances& tolerances, double servo_rate = 0.0);

  /// The stroke is begun at `tip`, in a character that the writer has misplaced by `misplaced` so far [m, page].
  void begin(const Point& tip, const Point& misplaced) noexcept;

  /// The pen is at `tip`, on the paper, and the hand means to be at `hand` [m, page].
  void update(const Point& tip, const Point& hand) noexcept;
  /// The pen leaves the stroke where it was last: the rest of its path, however short, counts too.
  void leave() noexcept;

  /// Share of the stroke that was written in order.
  double covered() const noexcept;
  /// Whether the stroke has been written, with up to `hidden` [m] missing in addition to the tolerance.
  bool accepts(double hidden) const noexcept;
  /// Whether the pen is at the end of the stroke, up to `hidden` [m] short of it, or has been there, in order.
  bool is_at_end(double hidden) const noexcept;

  /// Distance of a hand at `hand` across the stroke, beyond the offset that is allowed for [m]: exact where it is more
  /// than the width of the corridor.
  double astray(const Point& hand, const StrokeContact& contact) noexcept;

 private:
  static constexpr int max_points = 64;  // as many as the bits of a word

  static constexpr int max_waiting = 16;

  struct RowPoint {
    Point point, tangent;
  };

  struct Sample {
    Point tip, pull;
  };

  /// Where the pen is relative to the points of the stroke, allowing for its offset at the beginning.
  struct Places {
    std::array<double, max_points> along;   ///< how far the pen is ahead of each, beyond its allowed offset [m]
    std::array<double, max_points> square;  ///< of the distance, with the pen's own offset [m^2]
    std::uint64_t free;                     ///< bit i: the pen passes point i
  };

  const RowPoint& row(int point) const noexcept { return row_[static_cast<std::size_t>(point)]; }
  void place(const Point& tip, int point, Places& places) const noexcept;
  void pass_special(int point, double square, Places& places) const noexcept;
  double across(const Point& from_stroke, const Point& tangent) const noexcept;
  void lengthen_way(const Point& tip, const Point& pull) noexcept;
  void look_along() noexcept;
  void begin_leg(const Sample& to) noexcept;
  bool may_be_accepted() const noexcept;
  void wait() noexcept;
  void catch_up_entirely() noexcept;
  void catch_up(int looks) noexcept;
  void look(const Point& tip, double way) noexcept;
  void measure(const Point& tip) noexcept;

  // The stroke. [m]
  int count_ = 0;
  double em_ = 0.0, length_ = 0.0, spacing_ = 0.0;
  double width_ = 0.0;      ///< of the corridor to each side
  double lead_ = 0.0;       ///< a point this far ahead or behind is abreast of the pen
  double least_way_ = 0.0;  ///< of a pen that has written enough of the stroke
  double shortest_way_ = 0.0;  ///< likewise, however much of it friction hides
  double share_ = 0.0, slack_ = 0.0;
  std::vector<RowPoint> row_;  ///< with the last one twice, since they are placed in pairs
  int looks_a_tick_ = 0;
  std::uint64_t special_ = 0;  ///< bit i: the stroke bends sharply at point i, or ends there

  // The pen. [m]
  std::uint64_t reached_ = 0;         ///< bit i: point i can have been reached in order
  Point own_ = Point::Zero();         ///< offset from the stroke
  Point late_ = Point::Zero();        ///< part of it due to a start beyond the stroke's
  Point misplaced_ = Point::Zero();   ///< offset of the character
  Point tip_ = Point::Zero();         ///< of the last sample
  Point pull_ = Point::Zero();        ///< from there to where the hand means to be
  Point seen_ = Point::Zero();        ///< where the pen was last looked at
  Point chord_from_ = Point::Zero();  ///< beginning of the current chord
  double nearest_ = 0.0;              ///< arc length of the furthest point that the pen was nearest to
  double covered_ = 0.0;              ///< arc length
  double way_ = 0.0, outside_ = 0.0;  ///< lengths of the pen's path, and of what lay outside the corridor
  double chords_ = 0.0;               ///< length of the path inside it
  double to_end_ = 0.0;               ///< distance to the end of the stroke, once that can have been reached
  bool is_first_leg_ = false;         ///< the pen has not been looked at since it began
  bool is_behind_ = false;            ///< the leg that the pen has moved is being looked at, and samples wait
  int waiting_ = 0, next_ = 0;        ///< samples that waited, and the first that still does
  int leg_step_ = 0, leg_steps_ = 0;  ///< looks at the leg, and how many it takes
  double leg_way_ = 0.0;              ///< its length
  double most_way_ = 0.0;             ///< no less than the hand's path, until no sample waits
  Point leg_from_ = Point::Zero(), leg_ = Point::Zero();  ///< its beginning, and the vector from there to its end
  Point leg_pull_ = Point::Zero();                        ///< `pull_` at its end
  std::array<Sample, max_waiting> samples_;
};

}  // namespace calligraphy
