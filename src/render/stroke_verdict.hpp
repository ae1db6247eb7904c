// What is made of the shape that a pen has written: the stroke that is due, perhaps that stroke, or another shape.
#pragma once

#include <calligraphy/render/stroke_tolerances.hpp>

#include "shape_fit.hpp"
#include "stroke_shape.hpp"

namespace calligraphy {

enum class StrokeVerdict {
  refused,
  plausible,  ///< of the right shape, but perhaps only a part: the stroke that is begun next decides
  finished
};

/// No shorter a share of a stroke is one, however it is stretched and however much of it friction hides.
inline constexpr double shortest_share_of_way = 0.57;

/// The least share of a stroke of `length` [em] that the pen's way must have: less of a short one.
double least_share_of_way(double length, const StrokeTolerances& tolerances) noexcept;

/// What the follower has accepted is not the stroke all the same: a tremor, loops, waves, or a bend that is missing.
bool is_vetoed(const ShapeMatch& match, const StrokeShape& stroke, const StrokeTolerances& tolerances) noexcept;

/// Where the pen has left the paper. Up to `hidden` [em] of its way is hidden by dry friction.
StrokeVerdict verdict_on(const ShapeMatch& match, const StrokeShape& stroke, double hidden,
                         const StrokeTolerances& tolerances) noexcept;

}  // namespace calligraphy
