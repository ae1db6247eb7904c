// The path of a fitted stroke; private to the importers.
#pragma once

#include <calligraphy/model/character.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// The path of a stroke as stroke_polyline() flattens it, before it is part of a character.
Path flattened(const StrokeInput& stroke);

}  // namespace calligraphy::recognition
