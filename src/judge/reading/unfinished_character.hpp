// A character that was broken off: what is missing at its end, and what its last pen-down has begun.
#pragma once

#include <span>

#include <calligraphy/judge/stroke_matching.hpp>

namespace calligraphy {

/// match_strokes() of paths that lie where they were written on the page [em], as though the writer had gone on to
/// write the other strokes in their places: few strokes by themselves resemble too many others elsewhere. Of the ways
/// to suppose this, the one that leaves the least to remark counts; the last path may go on along a stroke that no
/// other path wrote. There is at least one path.
MatchResult match_unfinished(const Character& character, std::span<const PenPath> paths,
                             const JudgeTolerances& tolerances);

}  // namespace calligraphy
