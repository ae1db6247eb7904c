// Fits the ink of a stroke to the outline of a brush stroke; private to the importers.
#pragma once

#include <span>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/character.hpp>
#include <calligraphy/model/stroke_ink.hpp>

#include "outline.hpp"

namespace calligraphy::recognition {

/// The ink of a stroke that best covers the outline of the brush stroke to whose median it was fitted. The outline is
/// not empty (docs/strokes.md).
StrokeInk fit_ink(const Stroke& stroke, std::span<const Point> median, const Outline& outline, InkDetail detail);

}  // namespace calligraphy::recognition
