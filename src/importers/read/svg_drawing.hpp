// The paths of an SVG file that draws one character; private to the importers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace calligraphy {

inline constexpr std::size_t max_svg_paths = 1024;  ///< of a character; no drawing has more

struct SvgPath {
  std::string data;   ///< attribute d
  std::string id;     ///< empty if there is none, as the others
  std::string clip;   ///< clip-path
  std::string label;  ///< kvg:type
};

struct SvgDrawing {
  std::string notice;  ///< the comment at the head of the file
  std::vector<SvgPath> paths;
};

/// Paths in the order of the document, at most one more than max_svg_paths. It has a square frame of this size [unit], by
/// its viewBox or, without one, by width and height. Only the five predefined entities of XML are expanded. `name` is
/// used in messages.
/// @throws FormatError naming the place, also for a transform
SvgDrawing parse_svg(std::string_view svg, double size, const std::string& name);

}  // namespace calligraphy
