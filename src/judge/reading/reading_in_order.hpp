// Reads pen-downs, taken in a given order, as strokes in theirs.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "stroke_reading.hpp"

namespace calligraphy {

/// The cheapest way to take the pen-downs, in this order, for the strokes in theirs: the edits that turn one word into
/// another (Needleman and Wunsch 1970), with joined and broken strokes as edits.
StrokeReading read_in_this_order(std::shared_ptr<const StrokeCosts> costs, std::span<const std::size_t> order);

}  // namespace calligraphy
