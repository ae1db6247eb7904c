// A stroke's centre line as a polyline; private to the importers.
#pragma once

#include <calligraphy/model/character.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// The stroke as a polyline within 1e-4 em of it, unless a curve is so large that this would require more than 256
/// pieces.
Path flattened(const StrokeInput& stroke);

}  // namespace calligraphy::recognition
