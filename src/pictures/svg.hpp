// What the pictures share: SVG through pugixml, numbers that no locale changes, strokes as paths.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/model/character.hpp>
#include <calligraphy/pictures/stroke_style.hpp>

namespace calligraphy::svg {

inline constexpr const char* ink = "#333333";
inline constexpr const char* faint = "#dddddd";

using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

/// A numeral with at most three decimals, without trailing zeros.
std::string number(double value);

/// Replaces control characters, which XML may not hold, by blanks. @throws FormatError when the text is not UTF-8
std::string clean(std::string_view text);

pugi::xml_node add(pugi::xml_node parent, const char* name, Attributes attributes);
pugi::xml_node add_text(pugi::xml_node parent, double x, double y, double size, const std::string& text,
                        Attributes attributes = {});

/// A rectangle, from its upper left corner.
pugi::xml_node add_rect(pugi::xml_node parent, const Point& corner, double width, double height,
                        Attributes attributes = {});
pugi::xml_node add_circle(pugi::xml_node parent, const char* name, const Point& centre, const char* radius,
                          Attributes attributes);

/// Approximate width of the text in a sans-serif font.
double text_width(std::string_view text, double size);

/// The text in lines no wider than this, broken at blanks and beside Chinese characters.
std::vector<std::string> wrapped(std::string_view text, double size, double width);

/// Maps the coordinates of a model to those of the picture, y down.
struct View {
  Point origin = Point::Zero();  ///< where the model's origin is in the picture
  double scale = 1.0;

  Point operator()(const Point& point) const { return origin + scale * Point(point.x(), -point.y()); }
  std::vector<Point> operator()(std::span<const Point> points) const;
};

/// Path data "M x,y ...".
class Path {
 public:
  void move_to(const Point& point) { append('M', {point}); }
  void line_to(const Point& point) { append('L', {point}); }
  void curve_to(const Point& first, const Point& second, const Point& end) { append('C', {first, second, end}); }
  const std::string& data() const { return data_; }

 private:
  void append(char command, std::initializer_list<Point> points);
  std::string data_;
  char command_ = 0;
};

/// The stroke's middle line: cubic curves as they are, quartic ones as fine polylines.
std::string stroke_path(const Stroke& stroke, const View& view);

/// A polyline. A lone point becomes a dot, as a pen that stood still leaves it.
std::string line_path(std::span<const Point> points);
/// The closed polygon.
std::string polygon_path(std::span<const Point> points);

/// A group whose children are paths of add_stroke() in the same style. `line_width` is that of lines, in the units of
/// the picture.
pugi::xml_node add_stroke_group(pugi::xml_node parent, const std::string& name, StrokeStyle style, const char* colour,
                                double line_width);

/// The stroke's ink, which it must have, or its middle line.
void add_stroke(pugi::xml_node group, const Stroke& stroke, StrokeStyle style, const View& view);

/// An empty picture on white. Lengths have the unit given ("mm", "px").
pugi::xml_node begin(pugi::xml_document& document, double width, double height, const char* unit,
                     const std::string& title);
std::string to_string(const pugi::xml_document& document);

}  // namespace calligraphy::svg
