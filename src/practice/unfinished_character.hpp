// A character that was broken off: what is missing at its end, and what its last pen-down has begun.
#pragma once

#include <span>

#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy {

/// match_strokes() of paths that lie where they were written on the page [em], as though the writer had gone on to
/// write the other strokes in their places: few strokes by themselves resemble too many others elsewhere. How many
/// strokes were still to come is what leaves the least to remark. A last path that was not lifted goes on along the
/// stroke that it has begun: the next one in order, forwards, unless another fits it better by 5 % of the em.
MatchResult match_unfinished(const Character& character, std::span<const PenPath> paths, bool is_lifted,
                             const StrokeTolerances& tolerances);

}  // namespace calligraphy
