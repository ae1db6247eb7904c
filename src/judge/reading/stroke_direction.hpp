// In which direction a stroke was written, and whether all of it was.
#pragma once

#include <calligraphy/judge/stroke_matching.hpp>

#include "stroke_reading.hpp"

namespace calligraphy {

/// Length of the pen-downs of a step over that of the strokes they are read as.
double length_share(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes);

struct StrokeDirection {
  WritingDirection direction = WritingDirection::unknown;
  double evidence = 0.0;  ///< that the direction or the shape is wrong: at least 1 unless forwards [1]
};

/// The direction in which the strokes of a step were written, as far as their length reveals it.
StrokeDirection direction_of(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes);

}  // namespace calligraphy
