#include "svg.hpp"

#include <cstddef>
#include <sstream>

#include <calligraphy/base/text.hpp>
#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/ink_outline.hpp>

#include "base/charconv.hpp"

namespace calligraphy::svg {

std::string number(double value) {
  std::string text;
  append_rounded(text, value, 3);
  return text;
}

std::string clean(std::string_view text) {
  std::string result;
  for (const char32_t code : decode_utf8(text)) {
    const bool allowed = code >= 0x20 && code != 0x7f && code != 0xfffe && code != 0xffff;
    result += encode_utf8(allowed ? code : U' ');
  }
  return result;
}

namespace {

pugi::xml_node with(pugi::xml_node node, Attributes attributes) {
  for (const auto& [key, value] : attributes) node.append_attribute(key) = value.c_str();
  return node;
}

}  // namespace

pugi::xml_node add(pugi::xml_node parent, const char* name, Attributes attributes) {
  return with(parent.append_child(name), attributes);
}

pugi::xml_node add_text(pugi::xml_node parent, double x, double y, double size, const std::string& text,
                        Attributes attributes) {
  pugi::xml_node node = add(parent, "text", {{"x", number(x)}, {"y", number(y)}, {"font-size", number(size)}});
  node.text() = text.c_str();
  return with(node, attributes);
}

pugi::xml_node add_rect(pugi::xml_node parent, const Point& corner, double width, double height,
                        Attributes attributes) {
  const std::string x = number(corner.x()), y = number(corner.y());
  return with(add(parent, "rect", {{"x", x}, {"y", y}, {"width", number(width)}, {"height", number(height)}}),
              attributes);
}

pugi::xml_node add_circle(pugi::xml_node parent, const char* name, const Point& centre, const char* radius,
                          Attributes attributes) {
  const std::string x = number(centre.x()), y = number(centre.y());
  return with(add(parent, "circle", {{"class", name}, {"cx", x}, {"cy", y}, {"r", radius}}), attributes);
}

double text_width(std::string_view text, double size) {
  double width = 0.0;
  for (const char32_t code : decode_utf8(text)) width += code < 0x2e80 ? 0.58 : 1.0;
  return width * size;
}

std::vector<std::string> wrapped(std::string_view text, double size, double width) {
  std::vector<std::string> words;  // each with the blanks after it
  char32_t before = U' ';
  for (const char32_t code : decode_utf8(text)) {
    const bool is_punctuation = (0x3001 <= code && code <= 0x3011) || 0xff00 <= code;  // never begins a line
    const bool begins = (before == U' ' && code != U' ') || (code >= 0x2e80 && !is_punctuation) ||
                        (before >= 0x2e80 && code < 0x2e80 && code != U' ');
    if (begins || words.empty()) words.emplace_back();
    words.back() += encode_utf8(code);
    before = code;
  }
  std::vector<std::string> lines = {""};
  for (const std::string& word : words) {
    const std::size_t shown = word.find_last_not_of(' ') + 1;
    if (!lines.back().empty() && text_width(lines.back() + word.substr(0, shown), size) > width) lines.emplace_back();
    lines.back() += word;
  }
  return lines;
}

std::vector<Point> View::operator()(std::span<const Point> points) const {
  std::vector<Point> result;
  for (const Point& point : points) result.push_back((*this)(point));
  return result;
}

void Path::append(char command, std::initializer_list<Point> points) {
  // A repeated command needs no letter.
  if (command != command_) data_ += command;
  bool separated = command != command_;
  command_ = command;
  for (const Point& point : points) {
    if (!separated) data_ += ' ';
    separated = false;
    data_.append(number(point.x())).append(",").append(number(point.y()));
  }
}

std::string stroke_path(const Stroke& stroke, const View& view) {
  constexpr int steps = 48;
  const auto& points = stroke.control_points;
  Path path;
  path.move_to(view(points[0]));
  std::size_t at = 0;
  for (const char element : stroke.elements) {
    if (element == static_cast<char>(ElementKind::line)) {
      path.line_to(view(points[++at]));
    } else if (stroke.curve_degree == 3) {
      path.curve_to(view(points[at + 1]), view(points[at + 2]), view(points[at + 3]));
      at += 3;
    } else {
      const Bezier<4> curve{{points[at], points[at + 1], points[at + 2], points[at + 3], points[at + 4]}};
      for (int i = 1; i <= steps; ++i) path.line_to(view(curve.point(static_cast<double>(i) / steps)));
      at += 4;
    }
  }
  return path.data();
}

std::string line_path(std::span<const Point> points) {
  Path path;
  path.move_to(points.front());
  for (const Point& point : points.size() == 1 ? points : points.subspan(1)) path.line_to(point);
  return path.data();
}

std::string polygon_path(std::span<const Point> points) { return line_path(points) + "Z"; }

pugi::xml_node add_stroke_group(pugi::xml_node parent, const std::string& name, StrokeStyle style, const char* colour,
                                double line_width) {
  if (style == StrokeStyle::ink) return add(parent, "g", {{"class", name}, {"fill", colour}});
  return add(parent, "g",
             {{"class", name},
              {"fill", "none"},
              {"stroke", colour},
              {"stroke-width", number(line_width)},
              {"stroke-linecap", "round"},
              {"stroke-linejoin", "round"}});
}

void add_stroke(pugi::xml_node group, const Stroke& stroke, StrokeStyle style, const View& view) {
  const bool lines = style == StrokeStyle::lines;
  add(group, "path", {{"d", lines ? stroke_path(stroke, view) : polygon_path(view(ink_outline(stroke)))}});
}

pugi::xml_node begin(pugi::xml_document& document, double width, double height, const char* unit,
                     const std::string& title) {
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("svg");
  root.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
  root.append_attribute("width") = (number(width) + unit).c_str();
  root.append_attribute("height") = (number(height) + unit).c_str();
  root.append_attribute("viewBox") = ("0 0 " + number(width) + " " + number(height)).c_str();
  root.append_attribute("font-family") = "sans-serif";
  root.append_child("title").text() = title.c_str();
  add(root, "rect", {{"width", "100%"}, {"height", "100%"}, {"fill", "#ffffff"}});
  return root;
}

std::string to_string(const pugi::xml_document& document) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  document.save(out, " ", pugi::format_indent, pugi::encoding_utf8);
  return out.str();
}

}  // namespace calligraphy::svg
