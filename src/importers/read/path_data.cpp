#include "path_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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

/// The commands that may follow the M of a path.
struct Commands {
  std::string_view letters;
  const char* expected;  ///< for messages
};
constexpr Commands centre_line{"CcSs", "expected C or S"};
constexpr Commands outline{"CcLlQqZz", "expected C, L, Q or Z"};

class PathReader {
 public:
  PathReader(std::string_view data, double tolerance, const Commands& commands)
      : data_(data), tolerance_(tolerance), commands_(commands) {}

  std::vector<Point> read() {
    const char start = command();
    if (start != 'M' && start != 'm') fail("expected M, found " + quoted(start));
    points_.push_back(pair(Point::Zero()));
    // The first pair is absolute even for m. Further pairs would be straight lines.
    if (number_follows()) fail(std::string("a second point after M draws a straight line: ") + commands_.expected);
    handle_ = points_.back();
    while (!at_end()) draw(command());
    return std::move(points_);
  }

 private:
  void draw(char command) {
    if (commands_.letters.find(command) == std::string_view::npos) {
      fail("command " + quoted(command) + ": " + commands_.expected);
    }
    if (command == 'Z' || command == 'z') {
      skip_space();
      if (!at_end()) fail("expected the end after Z, found " + rest());
      return;
    }
    const bool relative = command >= 'a';
    do {
      const Point start = points_.back();
      const Point origin = relative ? start : Point(Point::Zero());
      if (command == 'L' || command == 'l') {
        add(pair(origin));
        continue;
      }
      const bool smooth = command == 'S' || command == 's';
      const Point first = smooth ? Point(2.0 * start - handle_) : pair(origin);
      const Point second = pair(origin);
      if (command == 'Q' || command == 'q') {  // raised to degree 3
        add_curve({{start, start + 2.0 / 3.0 * (first - start), second + 2.0 / 3.0 * (first - second), second}});
      } else {
        const Point end = pair(origin);
        add_curve({{start, first, second, end}});
        handle_ = second;
      }
    } while (number_follows());
  }

  /// Pieces of equal parameter length h: the distance of a cubic from its chord is at most h^2 / 8 max |B''|.
  void add_curve(const Bezier<3>& curve) {
    const auto& p = curve.control_points;
    const double second = 6.0 * std::max((p[0] - 2.0 * p[1] + p[2]).norm(), (p[1] - 2.0 * p[2] + p[3]).norm());
    const double needed = std::ceil(std::sqrt(second / (8.0 * tolerance_)));
    const int pieces = static_cast<int>(std::clamp(needed, 1.0, static_cast<double>(max_pieces)));
    for (int i = 1; i < pieces; ++i) points_.push_back(curve.point(static_cast<double>(i) / pieces));
    add(p[3]);
  }

  void add(const Point& point) {
    points_.push_back(point);
    if (points_.size() > max_path_points) fail("more than " + std::to_string(max_path_points) + " points");
  }

  Point pair(const Point& origin) {
    const double x = number();
    const double y = number();
    const Point point = origin + Point(x, y);
    if (point.cwiseAbs().maxCoeff() > max_path_coordinate) fail("a coordinate beyond 10000");
    return point;
  }

  double number() {
    skip_separator();
    const std::size_t begin = at_;
    if (at_ < data_.size() && data_[at_] == '+' && at_ + 1 < data_.size() && data_[at_ + 1] != '-') ++at_;
    double value = 0.0;
    const auto [end, error] = from_chars(data_.data() + at_, data_.data() + data_.size(), value);
    at_ = begin;
    if (error != std::errc() || !std::isfinite(value)) fail("expected a number, found " + rest());
    at_ = static_cast<std::size_t>(end - data_.data());
    return value;
  }

  char command() {
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
    skip_separator();
    const bool follows = at_ < data_.size() && std::string_view("+-.0123456789").find(data_[at_]) != std::string::npos;
    if (!follows) at_ = before;
    skip_space();
    return follows;
  }

  void skip_space() {
    while (at_ < data_.size() && std::string_view(" \t\r\n\f").find(data_[at_]) != std::string_view::npos) ++at_;
  }
  void skip_separator() {
    skip_space();
    if (at_ < data_.size() && data_[at_] == ',') ++at_;
    skip_space();
  }
  bool at_end() const { return at_ == data_.size(); }

  static std::string quoted(char c) { return std::string("'") + c + "'"; }
  std::string rest() const { return at_end() ? "the end" : "'" + std::string(data_.substr(at_, 12)) + "'"; }
  [[noreturn]] void fail(const std::string& what) const {
    throw FormatError("at byte " + std::to_string(at_) + ": " + what);
  }

  std::string_view data_;
  double tolerance_;
  const Commands& commands_;
  std::size_t at_ = 0;
  std::vector<Point> points_;
  Point handle_ = Point::Zero();
};

}  // namespace

std::vector<Point> flattened_path(std::string_view data, double tolerance) {
  return PathReader(data, tolerance, centre_line).read();
}

std::vector<Point> flattened_outline(std::string_view data, double tolerance) {
  return PathReader(data, tolerance, outline).read();
}

}  // namespace calligraphy
