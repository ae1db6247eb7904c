#include "svg_drawing.hpp"

#include <algorithm>
#include <cstring>
#include <sstream>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

namespace calligraphy {
namespace {

constexpr std::size_t max_svg = 1 << 20;  // [byte]; the largest of KanjiVG has 8 thousand

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

/// "109" or "109px".
bool is_length(const std::string& text, double size) {
  std::istringstream in(text);
  double length = 0.0;
  std::string unit;
  return in >> length && length == size && (!(in >> unit) || unit == "px");
}

void check_frame(pugi::xml_node root, double size, const std::string& name) {
  const std::string box = root.attribute("viewBox").value();
  std::string numbers = box;
  std::replace(numbers.begin(), numbers.end(), ',', ' ');
  std::istringstream in(numbers);
  double left = 0, top = 0, width = 0, height = 0;
  if (in >> left >> top >> width >> height && left == 0 && top == 0 && width == size && height == size) return;
  if (!root.attribute("viewBox") && is_length(root.attribute("width").value(), size) &&
      is_length(root.attribute("height").value(), size)) {
    return;
  }
  const std::string expected = std::to_string(static_cast<int>(size));
  fail(name, "viewBox '" + printable(box.substr(0, 40)) + "': expected '0 0 " + expected + " " + expected + "'");
}

}  // namespace

SvgDrawing parse_svg(std::string_view svg, double size, const std::string& name) {
  if (svg.size() > max_svg) fail(name, "larger than 1 MB");
  pugi::xml_document document;
  const auto result =
      document.load_buffer(svg.data(), svg.size(), pugi::parse_default | pugi::parse_comments, pugi::encoding_utf8);
  if (!result) {
    fail(name, "line " + std::to_string(line_of(svg, result.offset)) + ": not XML: " + result.description());
  }
  const pugi::xml_node root = document.child("svg");
  if (!root) fail(name, "no <svg> element");
  check_frame(root, size, name);

  SvgDrawing drawing;
  if (const pugi::xml_node first = document.first_child(); first.type() == pugi::node_comment) {
    drawing.notice = first.value();
  }
  for (pugi::xml_node node = root; node; node = next_in_document(node, root)) {
    const bool is_path = std::strcmp(node.name(), "path") == 0;
    const bool is_drawn = is_path || std::strcmp(node.name(), "g") == 0 || std::strcmp(node.name(), "svg") == 0;
    if (is_drawn && node.attribute("transform")) {
      const std::string path = is_path ? ": path " + std::to_string(drawing.paths.size() + 1) : "";
      fail(name + path, "a transform is not supported");
    }
    if (!is_path) continue;
    if (drawing.paths.size() > max_svg_paths) break;
    drawing.paths.push_back({node.attribute("d").value(), node.attribute("id").value(),
                             node.attribute("clip-path").value(), node.attribute("kvg:type").value()});
  }
  return drawing;
}

}  // namespace calligraphy
