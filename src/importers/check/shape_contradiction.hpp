// Whether a drawn path contradicts the kinds recorded for it; private to the importers.
#pragma once

#include <span>

#include "importers/fit/polyline.hpp"

namespace calligraphy::recognition {

/// True if the path, which geometry alone recognises as another kind, is clearly none of `ids` (docs/import.md): it
/// runs in another direction, ends with a hook that they lack, or lacks theirs. Of compound brush strokes, whose
/// entries and lifts look like hooks, only a wan gou recorded as a shu gou counts. O(points).
bool contradicts(std::span<const Point> path, bool brush, std::span<const int> ids, int recognised);

/// True if none of the one-element strokes among `ids` runs in the direction of the path. O(points).
bool is_misdirected(std::span<const Point> path, std::span<const int> ids);

}  // namespace calligraphy::recognition
