// The remarks on a character that was read.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <calligraphy/judge/stroke_matching.hpp>

#include "judge/reading/other_character.hpp"

namespace calligraphy {

/// How sure or how grave remarks are, and must be (StrokeRemark::evidence) [1].
struct RemarkEvidence {
  double order;  ///< evidence of remarks on order
  double least;  ///< minimum evidence of a remark
};

/// The remarks by pen-down, then those on strokes that none of them wrote. `drawn` says what each of the paths wrote.
/// If it was another character, there is only that remark; if it was a lookalike, that remark comes first.
std::vector<StrokeRemark> remarks_on(const Character& character, std::span<const PenPath> paths,
                                     std::span<const DrawnStroke> drawn, const AffineMap& fit,
                                     const RemarkEvidence& evidence,
                                     const std::optional<OtherCharacter>& other = std::nullopt);

}  // namespace calligraphy
