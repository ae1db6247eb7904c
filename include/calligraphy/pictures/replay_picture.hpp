// SVG picture of a person's writing over its template, beside the same writing under guidance.
#pragma once

#include <span>
#include <string>

#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/pictures/stroke_style.hpp>

namespace calligraphy {

/// Draws two squares, 190 mm wide in all. Left: the pen-downs over the template, aligned with it by the match's fit,
/// each with an arrow and its number in writing order; the template's own numbers are blue; red marks what is out of
/// order, backwards, extra or missing, orange what was joined or has another form, with a ring round what a remark
/// points at. Right: the path of the device's pen (pen-downs in the square of the same character). Below: the remarks.
/// The style is that of the template: pen paths are always lines. The language is that of all words but the title.
/// @throws ValueError when the match does not belong to these paths, FormatError when the title is not UTF-8
std::string replay_picture(const Character& character, std::span<const PenPath> paths, const MatchResult& match,
                           std::span<const PenPath> guided, const std::string& title,
                           StrokeStyle style = StrokeStyle::ink, const Language& language = {});

}  // namespace calligraphy
