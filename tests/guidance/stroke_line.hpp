// A stroke as a fine polyline, derived from the model alone: independent of the library's nearest points.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/base/random.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/practice/page.hpp>

namespace calligraphy_test {

using calligraphy::Point;

/// A polyline by arc length.
class StrokeLine {
 public:
  StrokeLine() = default;
  explicit StrokeLine(std::vector<Point> points);
  /// A stroke as placed on the page: 48 chords per curve, within 1e-4 of its size.
  StrokeLine(const calligraphy::Stroke& stroke, const calligraphy::Placement& placement);

  double length() const { return arcs_.back(); }
  const std::vector<Point>& points() const { return points_; }
  Point at(double arc) const;
  Point tangent(double arc) const;  ///< unit vector; zero for a point
  double distance(const Point& from) const;
  /// Arc length of the nearest point between two arc lengths.
  double nearest_arc(const Point& from, double low, double high) const;

  /// The part between two shares of the length.
  StrokeLine part(double from, double to) const;
  /// The other way.
  StrokeLine reversed() const;
  /// Each point moved by `move(point, share of the length)`.
  template <typename Move>
  StrokeLine moved(Move&& move) const {
    StrokeLine result = *this;
    const double whole = length();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      result.points_[i] = move(points_[i], whole > 0.0 ? arcs_[i] / whole : 0.0);
    }
    result.measure();
    return result;
  }

 private:
  std::size_t chord(double arc) const;
  void measure();

  std::vector<Point> points_;
  std::vector<double> arcs_;
};

/// The strokes of a placed character, in writing order.
std::vector<StrokeLine> stroke_lines(const calligraphy::PlacedCharacter& placed);

/// Mean distance of the points that are equally far along two lines.
double mean_distance(const StrokeLine& one, const StrokeLine& other);

/// A page of 160 x 120 mm with one character in the middle.
calligraphy::PracticePage page_of(const calligraphy::Character& character, double em);

/// Up to `count` characters: of a set file, drawn without repetition, or if `file` is empty the built-in ones in order.
std::vector<calligraphy::Character> some_characters(const std::string& file, int count, std::uint64_t seed);

}  // namespace calligraphy_test
