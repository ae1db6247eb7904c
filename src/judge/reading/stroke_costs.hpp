// What it costs to take each pen-down for each stroke, once the writing is laid on the character.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>

#include "judge/pens/resemblance.hpp"
#include "stroke_outlines.hpp"

namespace calligraphy {

/// A pen-down as it came.
struct DrawnLine {
  Outline line;
  Point begin, end;
  Outline with_next;  ///< it and the next pen-down as one line, if there is a next one
};

std::vector<DrawnLine> drawn_lines(std::span<const PenPath> paths);

/// A pen-down taken for a stroke, or for several in a row.
struct PairCost {
  double cost;           ///< mean distance, and what the directions say against it; infinite: impossible [em]
  double with, against;  ///< accord with the stroke, and with the stroke written backwards [1]
  bool backwards;        ///< it fits better backwards
};

/// Costs of all pairs for one way to lay the writing on the character.
class StrokeCosts {
 public:
  StrokeCosts(const StrokeOutlines& strokes, std::span<const DrawnLine> drawn, const AffineMap& fit);

  std::size_t paths() const { return placed_.size(); }
  std::size_t strokes() const { return strokes_->count(); }
  const AffineMap& fit() const { return fit_; }
  /// A pen-down, laid on the character, and it and the next one as one line.
  const Outline& placed(std::size_t path) const { return placed_[path]; }
  const Outline& placed_with_next(std::size_t path) const { return placed_with_next_[path]; }
  double length(std::size_t path) const { return lengths_[path]; }
  bool is_tap(std::size_t path) const { return lengths_[path] < tap_length; }

  const PairCost& single(std::size_t path, std::size_t stroke) const { return singles_[path * strokes() + stroke]; }
  /// A pen-down as `count` strokes in a row, from 2 on: possible where it is long enough, resembles them, and clearly
  /// more than any of them alone.
  const PairCost& joined(std::size_t path, std::size_t first, std::size_t count) const {
    return joined_[(path * strokes() + first) * max_joined + count - 1];
  }
  /// A pen-down and the next one as one stroke: possible where the second goes on where the first ended, and both
  /// together resemble it hardly less than one of them alone.
  const PairCost& broken(std::size_t path, std::size_t stroke) const { return broken_[path * strokes() + stroke]; }

  /// Outlines compared with each other so far.
  int comparisons() const { return comparisons_; }

 private:
  PairCost compare(const Outline& line, const Outline& shape, const StrokeRun& run);
  void compare_singles(std::size_t path);
  void compare_joined(std::size_t path);
  void compare_broken(std::size_t path, double gap);

  const StrokeOutlines* strokes_;
  AffineMap fit_;
  std::vector<Outline> placed_, shapes_, placed_with_next_;
  std::vector<double> lengths_;    ///< of the pen-downs [em]
  std::vector<PairCost> singles_;  ///< by pen-down, then by stroke
  std::vector<PairCost> joined_;   ///< by pen-down, then by the first stroke, then by their number
  std::vector<PairCost> broken_;   ///< by the first of two pen-downs, then by stroke
  int comparisons_ = 0;
};

/// How much the direction of a stroke tells: less of short ones.
double trust_in_direction(double length);

}  // namespace calligraphy
