// What there is to remark on a character that was read.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy {

/// By pen-down, then the strokes that none of them wrote. `drawn` tells what each of the paths wrote.
std::vector<StrokeRemark> remarks_on(const Character& character, std::span<const PenPath> paths,
                                     std::span<const DrawnStroke> drawn, const AffineMap& fit);

}  // namespace calligraphy
