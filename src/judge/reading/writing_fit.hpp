// The alignment of the writing as a whole with the character.
#pragma once

#include <optional>
#include <span>

#include <calligraphy/judge/pen_path.hpp>

#include "stroke_reading.hpp"

namespace calligraphy {

/// The affine map from the pen-downs to the strokes as which they are read, by least squares. It is pulled towards the
/// start, because a few strokes reveal little about slant and size. None if nothing was written, or if the map slants
/// or scales the writing beyond the start more than handwriting varies.
std::optional<AffineMap> fit_writing(const StrokeReading& reading, const StrokeOutlines& strokes,
                                     std::span<const DrawnLine> drawn, const AffineMap& start);

}  // namespace calligraphy
