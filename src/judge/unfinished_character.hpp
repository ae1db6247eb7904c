// A character that was broken off: what is missing at its end, and which stroke its last pen-down began.
#pragma once

#include <span>

#include <calligraphy/judge/stroke_matching.hpp>

namespace calligraphy {

/// match_strokes() of paths that lie where they were written [em], as though the writer had gone on to write the other
/// strokes in their places: a few strokes on their own resemble too many others elsewhere. Of the possible
/// continuations, the one that leaves the least to remark counts; the last path may continue along a stroke that no
/// other path wrote. There must be at least one path.
MatchResult match_unfinished(const Character& character, std::span<const PenPath> paths,
                             const JudgeTolerances& tolerances);

}  // namespace calligraphy
