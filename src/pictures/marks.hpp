// How pictures mark what a pen wrote: lines with arrows and numbers, and a colour for each kind of fault.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/judge/stroke_matching.hpp>

#include "svg.hpp"

namespace calligraphy::marks {

// Template and ink differ in tone, so that they are told apart in black and white.
inline constexpr const char* template_colour = "#c5d6f7";
inline constexpr const char* number_colour = "#2f62c9";  ///< of the correct order
inline constexpr const char* wrong = "#e02020";
inline constexpr const char* noted = "#e08a00";

/// Sizes of marks, in the units of the picture.
struct Sizes {
  double line = 0.6;
  double label = 3.4;
  double arrow = 2.4;
};

/// Puts numbers beside paths where they cover each other and the ink least.
class Labels {
 public:
  explicit Labels(double size) : size_(size) {}

  /// Keeps clear of a path.
  void avoid(std::span<const Point> path);
  /// Behind or beside a path, near its start if there is room.
  Point place(std::span<const Point> path, double width);

 private:
  struct Taken {
    Point centre;
    double width;
  };

  double covered(const Point& centre, double width) const;

  double size_;
  std::vector<Taken> taken_;
  std::vector<Point> ink_;
};

/// A group of lines of one width, without fill.
pugi::xml_node add_lines(pugi::xml_node root, const char* name, double width);

void draw_path(pugi::xml_node parent, std::span<const Point> points, const char* colour);

/// The head of an arrow.
struct Arrow {
  Point middle;
  Point direction;  ///< of norm 1
};

/// Where a head of this length tells best which way a path goes: where the path under it runs straight, and as the path
/// does as a whole some three lengths each way, which a jitter of the pen does not. Nothing if it does so nowhere.
std::optional<Arrow> arrow_on(std::span<const Point> path, double length);

/// A head on the path that shows where it goes, if it can be shown.
void draw_arrow(pugi::xml_node parent, std::span<const Point> points, const char* colour, double length);

/// Groups for numbers, with halos below all of them.
class Numbers {
 public:
  Numbers(pugi::xml_node root, double size);

  Labels& labels() { return labels_; }
  /// Another group, in front of those before it. Numbers of the correct order are italic, those of the pen upright.
  pugi::xml_node add_group(pugi::xml_node root, const char* name, const char* font_style);
  void draw(pugi::xml_node group, std::span<const Point> points, std::size_t number, const char* colour);

 private:
  double size_;
  pugi::xml_node halos_;
  Labels labels_;
};

/// The colour of a pen-down: red where it is wrong, orange where it is joined, broken or of another form.
const char* colour_of(const MatchResult& match, std::size_t path);

/// What remarks on the form of some strokes, not of all, point at [em].
std::vector<Point> places_of_form(const MatchResult& match);

/// Rings round places in the picture, of which labels then keep clear.
void draw_rings(pugi::xml_node parent, std::span<const Point> places, const Sizes& sizes, Labels& labels);

bool is_missing(const MatchResult& match, std::size_t stroke);

/// A tap that wrote nothing.
bool bounced(const DrawnStroke& drawn);

/// The first remarks in words, and how many more there are.
std::vector<std::string> remark_lines(const MatchResult& match, const Character& character, const Language& language);

}  // namespace calligraphy::marks
