#include "path_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/bezier.hpp>

#include "base/charconv.hpp"

namespace calligraphy {
namespace {

constexpr double max_path_coordinate = 1e4;  // [unit]; a drawing has 109
constexpr std::size_t max_path_points = 20000;
constexpr int max_pieces = 1000;  // of one curve

/// A number right after its command, before which there is no comma.
enum class First { no, yes };

/// An arc of an ellipse from its end points, as in SVG 2, appendix B.2.
struct EllipticalArc {
  Point centre;
  Point axis;   ///< the first semi-axis
  Point other;  ///< the second
  double start;
  double sweep;  ///< [rad]; negative against the sense from the first axis to the second

  Point point(double share) const {
    const double angle = start + share * sweep;
    return centre + std::cos(angle) * axis + std::sin(angle) * other;
  }
};

/// Radii that are too small are scaled. They are not zero, nor are the ends equal.
EllipticalArc arc_between(const Point& from, const Point& to, Point radii, double rotation, bool is_large,
                          bool is_positive) {
  const Point along(std::cos(rotation), std::sin(rotation)), across(-along.y(), along.x());
  const Point half = 0.5 * (from - to);
  Point on_circle(half.dot(along) / radii.x(), half.dot(across) / radii.y());  // of radius 1
  const double squared = on_circle.squaredNorm();
  if (squared > 1.0) {
    radii *= std::sqrt(squared);
    on_circle /= std::sqrt(squared);
  }
  const double to_centre = std::sqrt(std::max(0.0, 1.0 / std::min(squared, 1.0) - 1.0));
  const Point centre = (is_large == is_positive ? -1.0 : 1.0) * to_centre * Point(on_circle.y(), -on_circle.x());
  const auto angle_of = [](const Point& point) { return std::atan2(point.y(), point.x()); };
  const double start = angle_of(on_circle - centre);
  double sweep = angle_of(-on_circle - centre) - start;
  constexpr double turn = 2.0 * std::numbers::pi;
  if (is_positive && sweep < 0.0) sweep += turn;
  if (!is_positive && sweep > 0.0) sweep -= turn;
  const Point axis = radii.x() * along, other = radii.y() * across;
  return {0.5 * (from + to) + centre.x() * axis + centre.y() * other, axis, other, start, sweep};
}

class PathReader {
 public:
  PathReader(std::string_view data, double tolerance) : data_(data), tolerance_(tolerance) {}

  std::vector<Subpath> read() {
    const char start = next_command();
    if (start != 'M' && start != 'm') fail_at(0, "expected M, found " + quoted(start));
    move(start == 'm');
    while (!at_end()) {
      const std::size_t place = at_;
      const char command = next_command();
      const bool relative = command >= 'a' && command <= 'z';
      const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
      if (std::string_view("MLHVCSQTAZ").find(kind) == std::string_view::npos) {
        fail_at(place, "command " + quoted(command) + ": expected one of M, L, H, V, C, S, Q, T, A and Z");
      }
      if (kind == 'M') {
        move(relative);
      } else if (kind == 'Z') {
        close();
      } else {
        draw(kind, relative);
      }
    }
    finish_subpath();
    if (subpaths_.empty()) subpaths_.push_back({{current_}, false});
    return std::move(subpaths_);
  }

 private:
  /// Further pairs after M draw lines.
  void move(bool relative) {
    finish_subpath();
    current_ = begin_ = pair(relative ? current_ : Point(Point::Zero()), First::yes);
    add(current_);
    smooth_ = '\0';
    if (number_follows()) draw('L', relative);
  }

  void close() {
    if (points_.size() > 1) subpaths_.push_back({std::move(points_), true});
    points_.clear();
    current_ = begin_;  // where a command other than M goes on
    smooth_ = '\0';
    skip_space();
  }

  /// Leaves out an M that draws nothing.
  void finish_subpath() {
    if (points_.size() > 1) subpaths_.push_back({std::move(points_), false});
    points_.clear();
  }

  void draw(char kind, bool relative) {
    if (points_.empty()) add(current_);
    First first = First::yes;
    do {
      draw_one(kind, relative ? current_ : Point(Point::Zero()), first);
      first = First::no;
    } while (number_follows());
  }

  void draw_one(char kind, const Point& origin, First first) {
    const Point start = current_;
    const bool keeps_handle = smooth_ == (kind == 'S' || kind == 'C' ? 'C' : 'Q');
    const Point mirrored = keeps_handle ? Point(2.0 * start - handle_) : start;
    smooth_ = '\0';
    switch (kind) {
      case 'H':
        return line_to(bounded({origin.x() + number(first), start.y()}));
      case 'V':
        return line_to(bounded({start.x(), origin.y() + number(first)}));
      case 'L':
        return line_to(pair(origin, first));
      case 'A':
        return arc_to(origin, first);
      case 'Q':
      case 'T':
        handle_ = kind == 'Q' ? pair(origin, first) : mirrored;
        current_ = pair(origin, kind == 'Q' ? First::no : first);
        smooth_ = 'Q';
        return add_curve({{start, start + 2.0 / 3.0 * (handle_ - start), current_ + 2.0 / 3.0 * (handle_ - current_),
                           current_}});  // raised to degree 3
      default:
        const Point leaving = kind == 'C' ? pair(origin, first) : mirrored;
        handle_ = pair(origin, kind == 'C' ? First::no : first);
        current_ = pair(origin);
        smooth_ = 'C';
        return add_curve({{start, leaving, handle_, current_}});
    }
  }

  void line_to(const Point& end) {
    current_ = end;
    add(end);
  }

  void arc_to(const Point& origin, First first) {
    constexpr double straight = 1e12;  // [unit]; a radius from which an arc is as good as its chord
    constexpr double shortest = 1e-9;  // [unit]; a chord whose direction means something
    const double across = std::abs(number(first)), upwards = std::abs(number());
    const double rotation = std::remainder(number(), 360.0) * std::numbers::pi / 180.0;
    const bool is_large = flag(), is_positive = flag();
    const Point start = current_, end = pair(origin);
    if (start == end) return;
    const auto [least, most] = std::minmax(across, upwards);
    if ((end - start).norm() < shortest || least == 0.0 || most > straight) return line_to(end);
    const EllipticalArc arc = arc_between(start, end, {across, upwards}, rotation, is_large, is_positive);
    const double radius = std::max(arc.axis.norm(), arc.other.norm());
    const int pieces = pieces_of(std::abs(arc.sweep) / std::sqrt(8.0 * tolerance_ / radius));
    for (int i = 1; i < pieces; ++i) add(bounded(arc.point(static_cast<double>(i) / pieces)));
    line_to(end);
  }

  static int pieces_of(double needed) {
    return static_cast<int>(std::ceil(std::clamp(needed, 1.0, static_cast<double>(max_pieces))));
  }

  /// Pieces of equal parameter length h: the distance of a cubic from its chord is at most h^2 / 8 max |B''|.
  void add_curve(const Bezier<3>& curve) {
    const auto& p = curve.control_points;
    const double second = 6.0 * std::max((p[0] - 2.0 * p[1] + p[2]).norm(), (p[1] - 2.0 * p[2] + p[3]).norm());
    const int pieces = pieces_of(std::sqrt(second / (8.0 * tolerance_)));
    for (int i = 1; i < pieces; ++i) add(curve.point(static_cast<double>(i) / pieces));
    add(p[3]);
  }

  void add(const Point& point) {
    points_.push_back(point);
    if (++count_ > max_path_points) fail("more than " + std::to_string(max_path_points) + " points");
  }

  Point bounded(const Point& point) const {
    if (point.cwiseAbs().maxCoeff() > max_path_coordinate) fail("a coordinate beyond 10000");
    return point;
  }

  Point pair(const Point& origin, First first = First::no) {
    const double x = number(first);
    const double y = number();
    return bounded(origin + Point(x, y));
  }

  double number(First first = First::no) {
    skip_separator(first);
    const std::size_t begin = at_;
    if (at_ < data_.size() && data_[at_] == '+' && at_ + 1 < data_.size() && data_[at_ + 1] != '-') ++at_;
    double value = 0.0;
    const auto [end, error] = from_chars(data_.data() + at_, data_.data() + data_.size(), value);
    at_ = begin;
    if (error != std::errc() || !std::isfinite(value)) fail("expected a number, found " + rest());
    at_ = static_cast<std::size_t>(end - data_.data());
    return value;
  }

  /// One digit, which the next number may follow at once.
  bool flag() {
    skip_separator(First::no);
    if (at_end() || (data_[at_] != '0' && data_[at_] != '1')) fail("expected 0 or 1, found " + rest());
    return data_[at_++] == '1';
  }

  char next_command() {
    skip_space();
    if (at_end()) fail("expected a command, found the end");
    const char found = data_[at_];
    if (found == '+' || found == '-' || found == '.' || found == ',' || (found >= '0' && found <= '9')) {
      fail("expected a command, found " + rest());
    }
    ++at_;
    return found;
  }

  bool number_follows() {
    const std::size_t before = at_;
    skip_separator(First::no);
    const bool follows = at_ < data_.size() && std::string_view("+-.0123456789").find(data_[at_]) != std::string::npos;
    if (!follows) at_ = before;
    skip_space();
    return follows;
  }

  void skip_space() {
    while (at_ < data_.size() && std::string_view(" \t\r\n\f").find(data_[at_]) != std::string_view::npos) ++at_;
  }
  void skip_separator(First first) {
    skip_space();
    if (first == First::no && at_ < data_.size() && data_[at_] == ',') ++at_;
    skip_space();
  }
  bool at_end() const { return at_ == data_.size(); }

  static std::string quoted(char c) { return std::string("'") + c + "'"; }
  std::string rest() const { return at_end() ? "the end" : "'" + std::string(data_.substr(at_, 12)) + "'"; }
  [[noreturn]] void fail(const std::string& what) const { fail_at(at_, what); }
  [[noreturn]] static void fail_at(std::size_t byte, const std::string& what) {
    throw FormatError("at byte " + std::to_string(byte) + ": " + what);
  }

  std::string_view data_;
  double tolerance_;
  std::size_t at_ = 0;
  std::vector<Subpath> subpaths_;  ///< before the current one
  std::vector<Point> points_;      ///< of the current one
  std::size_t count_ = 0;          ///< of all points
  Point current_ = Point::Zero();
  Point begin_ = Point::Zero();   ///< of the current subpath
  Point handle_ = Point::Zero();  ///< the last one of a curve
  char smooth_ = '\0';            ///< C or Q if that curve has just been drawn
};

}  // namespace

std::vector<Subpath> flattened(std::string_view data, double tolerance) { return PathReader(data, tolerance).read(); }

std::vector<Point> flattened_path(std::string_view data, double tolerance) {
  std::vector<Subpath> subpaths = flattened(data, tolerance);
  if (subpaths.size() > 1) {
    throw FormatError("draws " + std::to_string(subpaths.size()) + " lines, each after an M: expected one");
  }
  std::vector<Point> points = std::move(subpaths.front().points);
  if (subpaths.front().is_closed && points.back() != points.front()) points.push_back(points.front());
  return points;
}

std::vector<std::vector<Point>> flattened_outline(std::string_view data, double tolerance) {
  std::vector<std::vector<Point>> polygons;
  for (Subpath& subpath : flattened(data, tolerance)) {
    const Point gap = subpath.points.back() - subpath.points.front();
    if (!subpath.is_closed && (subpath.points.size() < 3 || gap.norm() > tolerance)) {
      throw FormatError("is not closed: expected Z at the end of each part");
    }
    polygons.push_back(std::move(subpath.points));
  }
  return polygons;
}

}  // namespace calligraphy
