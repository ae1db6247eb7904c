// fit_stroke() for the outlines of brush strokes that consist of several parts; private to the importers.
#pragma once

#include <span>

#include <calligraphy/importers/stroke_fit.hpp>

#include "outline.hpp"

namespace calligraphy::recognition {

/// As fit_stroke(), whose options these are.
FittedStroke fit_brush_stroke(std::span<const Point> path, const Outline& outline, std::span<const int> ids);

}  // namespace calligraphy::recognition
