// A pen that draws the strokes of a page exactly, to try whether tolerances take it.
#pragma once

#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// Draws each stroke, unless the tolerances are a preset, which is known to take them, or leave the end of a stroke to
/// its feature planes. All that is given must be valid. Takes about 0.3 ms a character.
/// @throws ValueError naming the first stroke that is not begun, or not finished
void require_exact_pen_taken(const std::vector<PlacedCharacter>& page, const RendererOptions& options,
                             const Capabilities& capabilities, const MotionMapping& mapping);

}  // namespace calligraphy
