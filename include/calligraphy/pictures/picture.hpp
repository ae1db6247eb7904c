// SVG pictures: what was written of a character or a page (Wang 2006, sec. 7.2, Figs. 30, 31, 37, 38), and the typical
// strokes.
#pragma once

#include <span>
#include <string>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/pictures/stroke_style.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/score.hpp>

namespace calligraphy {

/// Draws what was written of a character, 112 mm wide, its square 89 mm unless the pen left it: the template pale, and
/// on it each pen-down as a dark line with an arrow and its number in writing order. Red marks what is out of order,
/// backwards, extra or missing, orange what was joined, broken or has another form, with a ring round what a remark
/// points at. Attempts that the session did not count as a stroke are faint and dashed. Where pen-downs and strokes do
/// not correspond one to one, the template has numbers of its own, blue and italic. Until the character is complete, a
/// blue ring marks the start of the stroke that is due. Below are a legend of what occurs, and the remarks. `scores` are
/// those of the page by score_page(), and `index` counts its characters from 0. The style is that of the template, the
/// language that of all words but the title.
/// @throws ValueError when the page is invalid or has no such character, or the scores do not belong to the recording,
/// FormatError when the title is not UTF-8
std::string character_picture(const PracticePage& page, const Recording& recording,
                              std::span<const CharacterScore> scores, int index, const std::string& title,
                              StrokeStyle style = StrokeStyle::ink, const Language& language = {});

/// Draws the whole page in the same way, life-size and without remarks.
/// @throws ValueError when the page is invalid or the scores do not belong to the recording, FormatError when the title
/// is not UTF-8
std::string page_picture(const PracticePage& page, const Recording& recording, std::span<const CharacterScore> scores,
                         const std::string& title, StrokeStyle style = StrokeStyle::ink, const Language& language = {});

/// The family of an installed font that has the Chinese names of the typical strokes; empty as by chinese_font().
std::string typical_strokes_font();

/// Draws a poster of all typical strokes (A3, landscape) with ID, names, code, elements, path, feature points and
/// control points (Figs. 7 and 9 to 12). The font is that of the Chinese names, which are left out if it is empty; in a
/// viewer that lacks it, common ones take its place. @throws FormatError when the font's name is not UTF-8
std::string typical_strokes_picture(StrokeStyle style = StrokeStyle::ink,
                                    const std::string& font = typical_strokes_font());

}  // namespace calligraphy
