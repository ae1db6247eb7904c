// SVG pictures: a page as on the paper's display (Wang 2006, sec. 7.2, Figs. 30, 31, 37, 38), and the typical strokes.
#pragma once

#include <string>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/pictures/stroke_style.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// Draws the page, life-size, after character `active` (index) has been written: templates blue, the active character
/// yellow, traces light green, and a red ellipse at the start of the active stroke (of the last stroke once the
/// character is complete). Traces of abandoned attempts are cleared, as on the display (sec. 4.3). A trace drawn as ink
/// has the profile of its stroke at 0.6 of the width, so that the template shows on both sides where the pen kept to
/// the path; the trace of a stroke in progress is a line. The language is that of the legend.
/// @throws ValueError when `active` is not on the page or the page is invalid, FormatError when the title is not UTF-8
std::string page_picture(const PracticePage& page, const Recording& recording, int active, const std::string& title,
                         StrokeStyle style = StrokeStyle::ink, const Language& language = {});

/// Draws all typical strokes with ID, names, elements, control points and feature points (Figs. 7 and 9 to 12).
std::string typical_strokes_picture(StrokeStyle style = StrokeStyle::ink);

}  // namespace calligraphy
