// Shoulders of brush strokes: where a heng turns down, the brush presses and its median cuts the corner; private to the
// importers.
#pragma once

#include "polyline.hpp"

namespace calligraphy::recognition {

/// The path with each shoulder replaced by the corner where its two extended limbs meet. A shoulder is at most 0.1 em
/// long, follows a heng and turns down by at least 60 degrees. O(points).
Path without_shoulders(const Path& path);

}  // namespace calligraphy::recognition
