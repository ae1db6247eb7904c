#include "svg_drawing.hpp"

#include <algorithm>
#include <cstring>
#include <sstream>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "xml_document.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_svg = 1 << 20;  // [byte]; the largest of KanjiVG has 8 thousand

[[noreturn]] void fail(const std::string& name, const std::string& what) { throw FormatError(name + ": " + what); }

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
  load_xml(document, svg, name);
  const pugi::xml_node root = document.child("svg");
  if (!root) fail(name, "no <svg> element");
  check_frame(root, size, name);

  SvgDrawing drawing;
  if (const pugi::xml_node first = document.first_child(); first.type() == pugi::node_comment) {
    drawing.notice = first.value();
  }
  const auto enter = [&](pugi::xml_node node) {
    const bool is_path = std::strcmp(node.name(), "path") == 0;
    const bool is_drawn = is_path || std::strcmp(node.name(), "g") == 0 || std::strcmp(node.name(), "svg") == 0;
    if (is_drawn && node.attribute("transform")) {
      const std::string path = is_path ? ": path " + std::to_string(drawing.paths.size() + 1) : "";
      fail(name + path, "a transform is not supported");
    }
    if (!is_path || drawing.paths.size() > max_svg_paths) return;
    drawing.paths.push_back({node.attribute("d").value(), node.attribute("id").value(),
                             node.attribute("clip-path").value(), node.attribute("kvg:type").value()});
  };
  walk_elements(root, enter, [](pugi::xml_node) {});
  return drawing;
}

}  // namespace calligraphy
