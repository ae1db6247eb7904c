// How the writing as a whole lies on the character.
#pragma once

#include <optional>
#include <span>

#include <calligraphy/judge/pen_path.hpp>

#include "stroke_reading.hpp"

namespace calligraphy {

/// Lays the pen-downs on the strokes that they are taken for: an affine map by least squares, pulled to the start,
/// since few strokes say little of slant and size. None where it slants or scales the writing so much more than the
/// start does that this is no matter of handwriting, or where nothing was written.
std::optional<AffineMap> fit_writing(const StrokeReading& reading, const StrokeOutlines& strokes,
                                     std::span<const DrawnLine> drawn, const AffineMap& start);

}  // namespace calligraphy
