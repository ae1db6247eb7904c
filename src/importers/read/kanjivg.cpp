#include "kanjivg.hpp"

#include <algorithm>
#include <cstring>
#include <sstream>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "path_data.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_svg = 1 << 20;  // [byte]; the largest of the package has 8 thousand
constexpr std::size_t max_svg_strokes = 256;
constexpr std::size_t max_label = 64;  // [byte]
constexpr double svg_units_per_em = 109.0;
constexpr double svg_tolerance = 5e-5;  // [em]

[[noreturn]] void fail(const std::string& name, const std::string& what) { throw FormatError(name + ": " + what); }

std::size_t line_of(std::string_view text, std::ptrdiff_t offset) {
  const auto end = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text)));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
}

/// The next node in document order. Not recursive, because nesting may be as deep as the file is long.
pugi::xml_node next_in_document(pugi::xml_node node, pugi::xml_node root) {
  if (node.first_child()) return node.first_child();
  while (node && node != root && !node.next_sibling()) node = node.parent();
  return node == root ? pugi::xml_node() : node.next_sibling();
}

void check_view_box(pugi::xml_node root, const std::string& name) {
  const std::string box = root.attribute("viewBox").value();
  std::istringstream in(box);
  double left = 0, top = 0, width = 0, height = 0;
  if (in >> left >> top >> width >> height && left == 0 && top == 0 && width == svg_units_per_em &&
      height == svg_units_per_em) {
    return;
  }
  fail(name, "viewBox '" + box.substr(0, 40) + "': expected '0 0 109 109'");
}

DrawnStroke stroke_of(pugi::xml_node path, const std::string& place) {
  DrawnStroke stroke;
  stroke.label = path.attribute("kvg:type").value();
  if (stroke.label.size() > max_label) fail(place, "kvg:type is longer than 64 bytes");
  try {
    decode_utf8(stroke.label);
    stroke.path = flattened_path(path.attribute("d").value(), svg_tolerance * svg_units_per_em);
  } catch (const FormatError& error) {
    fail(place, std::string("path data ") + error.what());
  }
  for (Point& point : stroke.path) point = Point(point.x(), svg_units_per_em - point.y()) / svg_units_per_em;
  return stroke;
}

}  // namespace

Drawing parse_kanjivg(std::string_view svg, const std::string& name) {
  if (svg.size() > max_svg) fail(name, "larger than 1 MB");
  pugi::xml_document document;
  const auto result =
      document.load_buffer(svg.data(), svg.size(), pugi::parse_default | pugi::parse_comments, pugi::encoding_utf8);
  if (!result) {
    fail(name, "line " + std::to_string(line_of(svg, result.offset)) + ": not XML: " + result.description());
  }
  const pugi::xml_node root = document.child("svg");
  if (!root) fail(name, "no <svg> element");
  check_view_box(root, name);

  Drawing drawing;
  if (const pugi::xml_node first = document.first_child(); first.type() == pugi::node_comment) {
    drawing.notice = first.value();
  }
  for (pugi::xml_node node = root; node; node = next_in_document(node, root)) {
    const bool is_path = std::strcmp(node.name(), "path") == 0;
    const std::string place = name + (is_path ? ": stroke " + std::to_string(drawing.strokes.size() + 1) : "");
    const bool is_drawn = is_path || std::strcmp(node.name(), "g") == 0 || std::strcmp(node.name(), "svg") == 0;
    if (is_drawn && node.attribute("transform")) fail(place, "a transform is not supported");
    if (!is_path) continue;
    if (drawing.strokes.size() == max_svg_strokes) fail(name, "more than 256 strokes");
    drawing.strokes.push_back(stroke_of(node, place));
  }
  if (drawing.strokes.empty()) fail(name, "no <path> element: there is no stroke");
  return drawing;
}

}  // namespace calligraphy
