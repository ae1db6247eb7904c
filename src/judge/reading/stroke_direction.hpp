// In which direction a stroke was written, and whether it was all of it.
#pragma once

#include <calligraphy/judge/stroke_matching.hpp>

#include "stroke_reading.hpp"

namespace calligraphy {

/// Length of the pen-downs of a step over that of the strokes that it takes them for.
double length_share(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes);

struct StrokeDirection {
  WritingDirection direction = WritingDirection::unknown;
  double evidence = 0.0;  ///< that it is wrong, or the shape: at least 1 unless it runs forwards
};

/// Direction in which what a step takes was written, as far as its length allows to tell.
StrokeDirection direction_of(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes);

}  // namespace calligraphy
