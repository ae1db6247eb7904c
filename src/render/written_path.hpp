// What a pen has written of a stroke, however long it takes, in a bounded number of points.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Keeps a point every 0.01 em. When it is full, every second point goes and the distance doubles. Never allocates.
class WrittenPath {
 public:
  static constexpr double spacing = 0.01;  ///< of the first points [em]
  static constexpr double chord = 0.03;    ///< of the way that a fine tremor does not lengthen [em]
  static constexpr std::size_t capacity = 64;

  /// The pen sets out at `tip` [m, page], in a square of `em` [m]. Smaller motions than `hidden` [m] need not be the
  /// hand's.
  void begin(const Point& tip, double em, double hidden) noexcept;

  /// The pen is at `tip` [m, page].
  void update(const Point& tip) noexcept {
    points_[count_] = tip;
    if ((tip - chord_from_).squaredNorm() >= chord_ * chord_) add_chord();
    if ((tip - points_[count_ - 1]).squaredNorm() >= apart_ * apart_) keep();
  }

  /// Where the pen was: the points that are kept, and the last one [m, page].
  std::span<const Point> points() const noexcept { return {points_.data(), count_ + 1}; }
  /// Arc lengths of the points that are kept [m].
  std::span<const double> arcs() const noexcept { return {arcs_.data(), count_}; }
  /// Length of the pen's way, in steps of `spacing`, or of what may be hidden if that is longer; without the first [m].
  double way() const noexcept { return std::max(0.0, way_ - step_); }
  /// The same in chords, to the last point [m].
  double chords() const noexcept { return chords_ + (points_[count_] - chord_from_).norm(); }

 private:
  [[gnu::noinline]] void add_chord() noexcept;
  [[gnu::noinline]] void keep() noexcept;

  std::size_t count_ = 1;  ///< of the kept points
  double apart_ = 0.0, chord_ = 0.0, step_ = 0.0;
  Point chord_from_ = Point::Zero(), step_from_ = Point::Zero();
  double way_ = 0.0, chords_ = 0.0;
  std::array<Point, capacity + 1> points_;  ///< kept ones, and the last one
  std::array<double, capacity> arcs_;       ///< of the kept ones
};

}  // namespace calligraphy
