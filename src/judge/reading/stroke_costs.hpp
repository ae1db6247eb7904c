// What it costs to read each pen-down as each stroke, once the writing is aligned with the character.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>

#include "judge/pens/resemblance.hpp"

namespace calligraphy {

/// The most strokes that are read as written without lifting the pen.
inline constexpr std::size_t max_joined = 6;

/// The most pen-downs that are read as one stroke.
inline constexpr std::size_t max_broken = 3;

/// What a pen draws when it writes a run of strokes without being lifted: the strokes, joined by straight lines.
struct StrokeRun {
  Outline line;
  Outline shape;       ///< `line`, centred
  double length;       ///< total length of the strokes alone [em]
  double line_length;  ///< length of `line`, joining lines included [em]
};

/// The strokes of a character, alone and in runs of up to max_joined, prepared for comparison with a pen.
class StrokeOutlines {
 public:
  explicit StrokeOutlines(const Character& character);

  std::size_t count() const { return runs_[0].size(); }
  const StrokeRun& run(std::size_t first, std::size_t strokes) const { return runs_[strokes - 1][first]; }
  double length(std::size_t stroke) const { return runs_[0][stroke].length; }
  /// Whether one stroke begins so near the end of another, which it does not follow, that the pen may stay down.
  bool are_near(std::size_t first, std::size_t other) const;
  /// What a pen draws that goes on from one stroke to another, whichever it is.
  StrokeRun apart(std::size_t first, std::size_t other) const;

 private:
  std::vector<std::vector<Point>> lines_;
  std::array<std::vector<StrokeRun>, max_joined> runs_;  ///< by the number of strokes and the first of them
};

/// A pen-down as it was written, before any alignment.
struct DrawnLine {
  Outline line;
  Point begin, end;
  std::vector<Outline> with_next;  ///< it and the next pen-downs as one line: two, or three, as far as there are any
};

std::vector<DrawnLine> drawn_lines(std::span<const PenPath> paths);

/// The cost of reading a pen-down as a stroke, or as several in a row.
struct PairCost {
  double cost;           ///< mean distance, plus a penalty for their directions; infinite: impossible [em]
  double with, against;  ///< accord() with the stroke, and with the stroke written backwards [1]
  bool backwards;        ///< it fits better backwards
};

/// The costs of all pairs at one alignment of the writing with the character.
class StrokeCosts {
 public:
  StrokeCosts(const StrokeOutlines& strokes, std::span<const DrawnLine> drawn, const AffineMap& fit);

  std::size_t paths() const { return placed_.size(); }
  std::size_t strokes() const { return strokes_->count(); }
  const StrokeOutlines& outlines() const { return *strokes_; }
  const AffineMap& fit() const { return fit_; }
  /// The aligned outline of a pen-down, or of `count` pen-downs as one line.
  const Outline& placed(std::size_t path, std::size_t count = 1) const { return placed_[path][count - 1]; }
  double length(std::size_t path) const { return lengths_[path]; }
  bool is_tap(std::size_t path) const { return lengths_[path] < tap_length; }

  const PairCost& single(std::size_t path, std::size_t stroke) const { return singles_[path * strokes() + stroke]; }
  /// A pen-down as `count` strokes in a row, at least 2: possible if it is long enough and resembles them clearly more
  /// than any of them alone.
  const PairCost& joined(std::size_t path, std::size_t first, std::size_t count) const {
    return joined_[(path * strokes() + first) * max_joined + count - 1];
  }
  /// `count` pen-downs in a row, at least 2, as one stroke: possible if each continues where the one before ended, and
  /// all together resemble it hardly less than any alone.
  const PairCost& broken(std::size_t path, std::size_t count, std::size_t stroke) const {
    return broken_[(path * strokes() + stroke) * max_broken + count - 1];
  }

  /// A pen-down as a run of strokes, whichever they are.
  PairCost of_run(std::size_t path, const StrokeRun& run) const;

  /// Number of comparisons of outlines so far.
  int comparisons() const { return comparisons_; }

 private:
  PairCost compare(const Outline& line, const Outline& shape, const StrokeRun& run);
  void compare_singles(std::size_t path);
  void compare_joined(std::size_t path);
  void compare_broken(std::size_t path, std::size_t count, double gap);

  const StrokeOutlines* strokes_;
  AffineMap fit_;
  std::vector<std::array<Outline, max_broken>> placed_;  ///< by pen-down, then by the number of those in one line
  std::vector<Outline> shapes_;
  std::vector<double> lengths_;    ///< lengths of the pen-downs [em]
  std::vector<PairCost> singles_;  ///< by pen-down, then by stroke
  std::vector<PairCost> joined_;   ///< by pen-down, then by the first stroke, then by their number
  std::vector<PairCost> broken_;   ///< by the first pen-down, then by stroke, then by the number of pen-downs
  int comparisons_ = 0;
};

/// How much the direction of a stroke of this length counts: less for a short one.
double trust_in_direction(double length);

}  // namespace calligraphy
