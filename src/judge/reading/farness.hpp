// How far writing is from the character that it was read as.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <calligraphy/judge/drawn_stroke.hpp>
#include <calligraphy/model/point.hpp>

#include "stroke_reading.hpp"

namespace calligraphy {

/// What the pen-downs of a step drew, and what its strokes wanted; of all parts of a broken stroke together.
struct ComparedStep {
  Outline drawn, wanted;

  double distance() const { return mean_distance(drawn, wanted); }
  /// From the centre of what was wanted to that of what was drawn [em].
  Point offset() const { return (drawn.colwise().mean() - wanted.colwise().mean()).transpose(); }
  /// The mean distance once both have the same centre [em].
  double distance_of_shapes() const;
};

ComparedStep compare_step(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes);

/// A stroke in a wrong place.
struct MisplacedStroke {
  std::size_t path, stroke;
  Point offset;  ///< from its place to where it is [em]
};

/// How far the pen-downs are from what they wrote.
struct Farness {
  double count = 0.0;     ///< number of pen-downs
  double distance = 0.0;  ///< their mean distance [em]
  double unlike = 0.0;    ///< the same, without those that are only misplaced [em]
  double far = 0.0;       ///< share of pen-downs that are far in place and shape [1]
  std::optional<MisplacedStroke> misplaced = {};  ///< the farthest one, if it is much farther than the others

  /// Whether most of it is so far off that it cannot be read.
  bool is_all_over() const;
  /// Whether it is farther from the character than right writing ever is.
  bool is_beyond_right_writing() const;
};

Farness farness_of(const StrokeReading& reading, const StrokeOutlines& strokes, std::span<const DrawnStroke> drawn);

}  // namespace calligraphy
