// What there is to remark on a character that was read.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <calligraphy/judge/stroke_matching.hpp>

#include "judge/reading/other_character.hpp"

namespace calligraphy {

/// How sure or how grave a remark is, and must be.
struct RemarkEvidence {
  double order;  ///< of those of order
  double least;  ///< of each that is told
};

/// By pen-down, then the strokes that none of them wrote. `drawn` tells what each of the paths wrote. If it was another
/// character, that alone, or of a lookalike, that first.
std::vector<StrokeRemark> remarks_on(const Character& character, std::span<const PenPath> paths,
                                     std::span<const DrawnStroke> drawn, const AffineMap& fit,
                                     const RemarkEvidence& evidence,
                                     const std::optional<OtherCharacter>& other = std::nullopt);

}  // namespace calligraphy
