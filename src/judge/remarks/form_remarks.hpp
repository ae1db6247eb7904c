// The remarks on the form of a character that was read.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/judge/stroke_matching.hpp>

#include "judge/form/form_faults.hpp"
#include "judge/form/whole_writing.hpp"

namespace calligraphy {

/// The remarks on form, one for each fault, by pen-down. `drawn` says what each of the paths wrote, from which
/// `written` was made. Which faults are one does not depend on `least`, the minimum evidence of a remark: a lower one
/// gives the same remarks and more.
std::vector<StrokeRemark> form_remarks(const CharacterForm& form, const WrittenForm& written,
                                       std::span<const DrawnStroke> drawn, double least);

/// The remark on the whole; place: the middle of the writing.
StrokeRemark whole_remark(const WholeFault& fault, std::span<const PenPath> paths);

}  // namespace calligraphy
