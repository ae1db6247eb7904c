// A character that was broken off: what is missing at its end, and what its last pen-down has begun.
#pragma once

#include <span>

#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy {

/// match_strokes() of paths that lie where they were written on the page [em], as though the writer had gone on to
/// write the other strokes in their places: few strokes by themselves resemble too many others elsewhere. How many
/// strokes were begun is what leaves the least to remark; a last path that was not lifted may go on along the last of
/// them.
MatchResult match_unfinished(const Character& character, std::span<const PenPath> paths, bool is_lifted,
                             const StrokeTolerances& tolerances);

}  // namespace calligraphy
