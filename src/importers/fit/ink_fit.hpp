// Fits the ink of a stroke to the outline of a brush stroke; private to the importers.
#pragma once

#include <span>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/stroke_ink.hpp>

#include "outline.hpp"

namespace calligraphy::recognition {

/// The ink along a path that best covers the outline of a brush stroke. The path is that of the stroke fitted to the
/// median; the outline is not empty; all are in em (docs/strokes.md).
StrokeInk fit_ink(std::span<const Point> path, std::span<const Point> median, const Outline& outline,
                  InkDetail detail);

}  // namespace calligraphy::recognition
