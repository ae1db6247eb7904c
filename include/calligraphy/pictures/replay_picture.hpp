// A person's writing beside its template, and what became of it under guidance, as SVG text.
#pragma once

#include <span>
#include <string>

#include <calligraphy/practice/pen_path.hpp>
#include <calligraphy/practice/stroke_verdict.hpp>

namespace calligraphy {

/// Two squares. Left: the pen-downs over the template, laid on it by the verdict's fit, with an arrow and the number in
/// which each was drawn; the template's own numbers are blue; red is what is out of turn, backwards, extra or missing,
/// orange what was joined or has another shape. Right: where the pen of the device went (pen-downs in the same square
/// of the character). Below: the remarks. 190 mm wide.
/// @throws ValueError when the verdict is not of these paths, FormatError when the title is not UTF-8
std::string replay_picture(const Character& character, std::span<const PenPath> paths, const StrokeVerdict& verdict,
                           std::span<const PenPath> guided, const std::string& title);

}  // namespace calligraphy
