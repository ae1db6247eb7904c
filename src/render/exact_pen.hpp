// Checks that the tolerances accept a pen that draws the strokes of a page exactly.
#pragma once

#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// Draws each stroke exactly, unless the tolerances are a preset, which is known to accept it, or leave the end of a
/// stroke to its feature planes. All arguments must be valid. Takes about 0.3 ms per character.
/// @throws ValueError naming the first stroke that is not begun, or not finished
void require_exact_pen_accepted(const std::vector<PlacedCharacter>& page, const RendererOptions& options,
                                const Capabilities& capabilities, const MotionMapping& mapping);

}  // namespace calligraphy
