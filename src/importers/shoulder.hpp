// The shoulder of a brush stroke: where a heng turns down, the brush presses and its median cuts the corner; private to
// the model.
#pragma once

#include "polyline.hpp"

namespace calligraphy::recognition {

/// The path with each shoulder replaced by the corner where its two limbs meet when they are drawn on. A shoulder is at
/// most 0.1 em long, comes after a heng and turns down by 60 degrees at least. O(points).
Path without_shoulders(const Path& path);

}  // namespace calligraphy::recognition
