// How pictures draw strokes.
#pragma once

namespace calligraphy {

/// How pictures draw strokes.
enum class StrokeStyle {
  ink,   ///< as a brush leaves them, with the typical width profile of their kind if they have none of their own
  lines  ///< as lines of one width along their paths (Wang 2006, sec. 3.2)
};

}  // namespace calligraphy
