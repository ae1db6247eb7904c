// Pictures as SVG text: what the paper's display shows (Wang 2006, sec. 7.2, Figs. 30, 31, 37, 38), and the stroke
// library.
#pragma once

#include <string>

#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// The page while character `active` (index) has been written: templates blue, the active character yellow, traces
/// light green, and a red ellipse at the start of the active stroke (when the character is complete: of its last
/// stroke). Traces of abandoned attempts are cleared, as on the display (sec. 4.3). In life size.
/// @throws ValueError when `active` is not on the page or the page is invalid, FormatError when the title is not UTF-8
std::string page_picture(const Page& page, const Recording& recording, int active, const std::string& title);

/// All typical strokes with id, names, elements, control points and feature points (Figs. 7 and 9 to 12).
std::string typical_strokes_picture();

}  // namespace calligraphy
