// Pictures as PDF, to print.
#pragma once

#include <string>

namespace calligraphy {

/// Whether the library was built with librsvg, which draws a PDF.
bool pdf_available() noexcept;

/// An SVG picture, any of this library's, as a PDF of one page of the same size; fonts are embedded. The same picture
/// and fonts give the same bytes.
/// @throws FormatError when the picture cannot be read or has no size, Error when it cannot be drawn or the library was
/// built without librsvg
std::string pdf_of_svg(const std::string& svg);

}  // namespace calligraphy
