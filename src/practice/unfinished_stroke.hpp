// The pen-down in which a recording ends, and the stroke that it has begun.
#pragma once

#include <span>

#include <calligraphy/model/character.hpp>
#include <calligraphy/practice/pen_path.hpp>
#include <calligraphy/render/stroke_tolerances.hpp>

namespace calligraphy {

/// The last path [em], with the rest of the stroke that it has begun: the next one in order that no other path wrote,
/// forwards, unless another fits the path better by 5 % of the em. As it is, where it goes on with the stroke of the
/// path before it, or has joined several. There is at least one path.
PenPath finish_last(const Character& character, std::span<const PenPath> paths, const StrokeTolerances& tolerances);

}  // namespace calligraphy
