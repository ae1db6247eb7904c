// How pictures draw strokes.
#pragma once

namespace calligraphy {

/// As a brush leaves them, with the typical width profile of their kind where they have none of their own, or as lines
/// of one width along their paths (Wang 2006, sec. 3.2).
enum class StrokeStyle { ink, lines };

}  // namespace calligraphy
