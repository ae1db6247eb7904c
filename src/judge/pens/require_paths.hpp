// Validation of pen-downs before they are read.
#pragma once

#include <span>

#include <calligraphy/judge/pen_path.hpp>

namespace calligraphy {

/// @throws ValueError naming the pen-down if there are more than 1000, or one is empty, not finite or more than 1e9 em
/// away
void require_paths(std::span<const PenPath> paths);

}  // namespace calligraphy
