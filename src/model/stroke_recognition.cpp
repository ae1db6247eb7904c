#include "stroke_recognition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include <Eigen/Dense>

#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::recognition {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Lengths of what the brush leaves [em], measured on hanzi-writer-data.
constexpr double longest_entry = 0.095;
constexpr double longest_droop = 0.055;
constexpr double longest_press = 0.1;

/// Direction of a vector in degrees, counter-clockwise from the right: heng is about 5, shu -90, pie -125.
double direction_of(const Point& vector) { return std::atan2(vector.y(), vector.x()) * 180.0 / std::numbers::pi; }

/// Angle brought to (-180, 180] degrees.
double wrapped(double degrees) { return std::remainder(degrees, 360.0); }

struct Range {
  double from;
  double to;
};

bool contains(const Range& range, double degrees) {
  return std::abs(wrapped(degrees - 0.5 * (range.from + range.to))) <= 0.5 * (range.to - range.from);
}

/// How far outside the range a direction is [degree].
double outside(const Range& range, double degrees) {
  const double half = 0.5 * (range.to - range.from);
  return std::max(0.0, std::abs(wrapped(degrees - 0.5 * (range.from + range.to))) - half);
}

/// How far outside the range a number is.
double beyond(const Range& range, double value) { return std::max({0.0, range.from - value, value - range.to}); }

/// Point of the path at an arc length after vertex `from`, at most the last point.
Point point_after(std::span<const Point> path, std::size_t from, double length) {
  for (std::size_t i = from; i + 1 < path.size(); ++i) {
    const double step = (path[i + 1] - path[i]).norm();
    if (step >= length && step > 0.0) return path[i] + (length / step) * (path[i + 1] - path[i]);
    length -= step;
  }
  return path.back();
}

Path without_repeats(std::span<const Point> points) {
  constexpr double nearest = 1e-9;  // [em]
  Path path;
  for (const Point& point : points) {
    if (path.empty() || (point - path.back()).norm() > nearest) path.push_back(point);
  }
  return path;
}

/// Directions in which a brush is set down: from the upper left, or curling in before a ti or a pie.
constexpr Range set_down{-95.0, 8.0};
constexpr Range curl_before_ti{70.0, 150.0};
constexpr Range curl_before_pie{130.0, 230.0};

/// Does a start piece with this direction belong to the brush, when the stroke goes on in direction `body`?
/// Strokes that go right or up are entered from the upper left by turning left, those that go down by turning right. A
/// na and a dian start thin and have no entry, so bodies between are left alone.
bool is_entry(double piece, double body) {
  const double turn = wrapped(body - piece);
  if (contains(curl_before_ti, piece) && contains({30.0, 80.0}, body)) return turn < -10.0;
  if (contains(curl_before_pie, piece) && contains({-180.0, -105.0}, body)) return turn > 10.0;
  if (!contains(set_down, piece)) return false;
  if (contains({-15.0, 80.0}, body)) return turn > 8.0;
  return contains({-200.0, -62.0}, body) && turn < -10.0;
}

/// Does an end piece with this direction belong to the brush? The brush is lifted towards the lower right after a heng,
/// downwards after a pie, sidewards after a ti or shu. Hooks turn by more than that.
bool is_droop(double piece, double body) {
  const double turn = wrapped(piece - body);
  if (contains({-20.0, 30.0}, body)) return turn < -12.0 && turn > -115.0;
  if (contains({-175.0, -112.0}, body)) return turn > 12.0 && turn < 90.0;
  if (contains({30.0, 80.0}, body)) return std::abs(turn) > 12.0 && std::abs(turn) < 80.0;
  return contains({-112.0, -20.0}, body) && turn < -12.0 && turn > -75.0;
}

/// A heng may be pressed down longer at its end than other strokes are.
bool is_press(double piece, double body) {
  const double turn = wrapped(piece - body);
  return contains({-10.0, 25.0}, body) && turn < -12.0 && turn > -70.0;
}

/// Number of vertices at the start that belong to the brush entry.
std::size_t entry_vertices(std::span<const Point> path, double length) {
  const double limit = std::min(longest_entry, 0.4 * length);
  double travelled = 0.0;
  std::size_t cut = 0;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    travelled += (path[i] - path[i - 1]).norm();
    if (travelled > limit) break;
    const double piece = direction_of(path[i] - path[i - 1]);
    const double look_ahead = std::clamp(0.3 * length, 0.05, 0.15);
    if (is_entry(piece, direction_of(point_after(path, i, look_ahead) - path[i]))) {
      cut = i;
    } else if (!contains(set_down, piece) && !contains(curl_before_ti, piece)) {
      break;  // the stroke's own first limb has begun
    }
  }
  return cut;
}

/// Number of vertices at the end that belong to the droop.
std::size_t droop_vertices(std::span<const Point> path, double length) {
  const Path reversed(path.rbegin(), path.rend());
  const double limit = std::min(longest_press, 0.25 * length);
  double travelled = 0.0;
  std::size_t cut = 0;
  for (std::size_t i = 1; i + 1 < reversed.size(); ++i) {
    travelled += (reversed[i] - reversed[i - 1]).norm();
    if (travelled > limit) break;
    const double piece = direction_of(reversed.front() - reversed[i]);
    const double look_back = std::clamp(0.2 * length, 0.03, 0.10);
    const double body = direction_of(reversed[i] - point_after(reversed, i, look_back));
    if (is_press(piece, body) || (travelled <= longest_droop && is_droop(piece, body))) cut = i;
  }
  return cut;
}

double distance_to_line(const Point& point, const Point& from, const Point& to) {
  const Point along = to - from;
  const double squared = along.squaredNorm();
  if (squared == 0.0) return (point - from).norm();
  const double t = std::clamp((point - from).dot(along) / squared, 0.0, 1.0);
  return (point - from - t * along).norm();
}

}  // namespace

double path_length(std::span<const Point> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

CleanPath clean_median(std::span<const Point> median) {
  CleanPath clean;
  const Path path = without_repeats(median);
  const double length = path_length(path);
  const std::size_t entry = entry_vertices(path, length);
  const std::size_t droop = droop_vertices(path, length);
  clean.had_entry = entry > 0;
  const auto first = path.begin() + static_cast<std::ptrdiff_t>(entry);
  const auto last = path.end() - static_cast<std::ptrdiff_t>(droop);
  if (last - first < 2) {
    clean.points = path;
  } else {
    clean.points.assign(first, last);
  }
  return clean;
}

Path simplified(const Path& path, std::size_t most) {
  if (path.size() <= most) return path;
  // The vertex farthest from the path so far is added next: at most `most` passes, so O(points * most).
  std::vector<std::size_t> kept{0, path.size() - 1};
  std::vector<double> distance(path.size(), 0.0);
  const auto measure = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from + 1; i < to; ++i) distance[i] = distance_to_line(path[i], path[from], path[to]);
    distance[from] = distance[to] = 0.0;
  };
  measure(0, path.size() - 1);
  while (kept.size() < most) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest < 0.002) break;
    const auto index = static_cast<std::size_t>(farthest - distance.begin());
    const auto next = std::upper_bound(kept.begin(), kept.end(), index);
    const std::size_t before = *(next - 1);
    const std::size_t after = *next;
    kept.insert(next, index);
    measure(before, index);
    measure(index, after);
  }
  Path result;
  for (const std::size_t index : kept) result.push_back(path[index]);
  return result;
}

Path refined(const Path& path, double step) {
  constexpr double most_steps = 96.0;
  step = std::max(step, path_length(path) / most_steps);
  Path result{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int pieces = std::max(1, static_cast<int>(std::ceil((path[i] - path[i - 1]).norm() / step)));
    for (int piece = 1; piece <= pieces; ++piece) {
      result.push_back(path[i - 1] + (static_cast<double>(piece) / pieces) * (path[i] - path[i - 1]));
    }
  }
  return result;
}

namespace {

/// Inner control points by linear least squares at given parameters, the end points fixed.
bool solve_handles(std::span<const Point> points, std::span<const double> parameters, Point handles[2]) {
  const Point& first = points.front();
  const Point& last = points.back();
  double a11 = 0.0, a12 = 0.0, a22 = 0.0;
  Point b1 = Point::Zero(), b2 = Point::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = parameters[i];
    const double s = 1.0 - t;
    const double w1 = 3.0 * s * s * t;
    const double w2 = 3.0 * s * t * t;
    const Point rest = points[i] - s * s * s * first - t * t * t * last;
    a11 += w1 * w1;
    a12 += w1 * w2;
    a22 += w2 * w2;
    b1 += w1 * rest;
    b2 += w2 * rest;
  }
  const double determinant = a11 * a22 - a12 * a12;
  if (!(determinant > 1e-9)) return false;
  handles[0] = (a22 * b1 - a12 * b2) / determinant;
  handles[1] = (a11 * b2 - a12 * b1) / determinant;
  return handles[0].allFinite() && handles[1].allFinite();
}

/// One Newton step of each parameter towards the foot of its point on the curve (Plass and Stone 1983).
void improve_parameters(std::span<const Point> points, const Bezier<3>& curve, std::vector<double>& parameters) {
  const Bezier<2> velocity = curve.hodograph();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point difference = curve.point(parameters[i]) - points[i];
    const Point tangent = velocity.point(parameters[i]);
    const double slope = tangent.squaredNorm() + difference.dot(velocity.derivative(parameters[i]));
    if (slope <= 0.0) continue;
    parameters[i] = std::clamp(parameters[i] - difference.dot(tangent) / slope, 0.0, 1.0);
  }
}

}  // namespace

double fit_cubic(std::span<const Point> points, Point handles[2]) {
  const Point& first = points.front();
  const Point& last = points.back();
  handles[0] = first + (last - first) / 3.0;
  handles[1] = last - (last - first) / 3.0;
  const double length = path_length(points);
  if (points.size() < 4 || length <= 0.0) return 0.0;
  std::vector<double> parameters(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    parameters[i] = parameters[i - 1] + (points[i] - points[i - 1]).norm() / length;
  }
  const Point straight[2] = {handles[0], handles[1]};
  for (int round = 0; round < 2; ++round) {
    Point next[2];
    if (!solve_handles(points, parameters, next)) break;
    // A handle far from the path would make a loop that nobody wrote.
    if ((next[0] - first).norm() > 1.5 * length || (next[1] - last).norm() > 1.5 * length) {
      handles[0] = straight[0];
      handles[1] = straight[1];
      break;
    }
    handles[0] = next[0];
    handles[1] = next[1];
    improve_parameters(points, {{first, handles[0], handles[1], last}}, parameters);
  }
  const Bezier<3> curve{{first, handles[0], handles[1], last}};
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    largest = std::max(largest, (curve.point(parameters[i]) - points[i]).norm());
  }
  return largest;
}

namespace {

/// A piece of the path as an element may see it.
struct Piece {
  double length = 0.0;          ///< of the chord [em]
  double direction = 0.0;       ///< of the chord [degree]
  double leaving = 0.0;         ///< direction of the first third [degree]
  double arriving = 0.0;        ///< direction of the last third [degree]
  double bulge = 0.0;           ///< mean offset of the path from the chord, over the chord's length, left positive [1]
  double line_direction = 0.0;  ///< of the best line, corners left out [degree]
  double line_error = 0.0;      ///< largest distance from the best line [em]
  double cubic_error = 0.0;     ///< largest distance from the best cubic [em]
  double sharpest = 0.0;        ///< largest turn inside, within 6 % of the em [degree]
};

/// The points without what a rounded corner at either end may have bent.
std::span<const Point> between_corners(std::span<const Point> points) {
  constexpr double corner_radius = 0.03;  // [em]
  const double reach = std::min(corner_radius, 0.15 * (points.back() - points.front()).norm());
  std::size_t first = 0;
  std::size_t last = points.size() - 1;
  while (first + 1 < last && (points[first] - points.front()).norm() < reach) ++first;
  while (last > first + 1 && (points[last] - points.back()).norm() < reach) --last;
  return points.subspan(first, last - first + 1);
}

/// Total least squares line: its direction, forwards [degree], and the largest distance from it [em].
struct LineFit {
  double direction;
  double error;
};

LineFit fit_line(std::span<const Point> points) {
  const auto [through, along] = line_through(points);
  const Point normal(-along.y(), along.x());
  double largest = 0.0;
  for (const Point& point : points) largest = std::max(largest, std::abs(normal.dot(point - through)));
  return {direction_of(along.dot(points.back() - points.front()) < 0.0 ? Point(-along) : along), largest};
}

/// Mean offset from the chord, by the area between path and chord.
double bulge_of(std::span<const Point> points, double chord) {
  if (chord <= 0.0) return 0.0;
  double area = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point a = points[i - 1] - points.front();
    const Point b = points[i] - points.front();
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  // The area left of travel counts positive when the path lies left of its chord.
  return -area / (chord * chord);
}

/// How far the path turns at each of its points, between the chords of one window before and after it [degree].
std::vector<double> turns_along(const Path& path) {
  constexpr double window = 0.03;  // [em]
  const Path reversed(path.rbegin(), path.rend());
  std::vector<double> turns(path.size(), 0.0);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point before = path[i] - point_after(reversed, path.size() - 1 - i, window);
    const Point after = point_after(path, i, window) - path[i];
    turns[i] = std::abs(wrapped(direction_of(after) - direction_of(before)));
  }
  return turns;
}

Piece measure(std::span<const Point> points, std::span<const double> turns) {
  constexpr double corner_radius = 0.03;  // [em]
  Piece piece;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double nearest = std::min((points[i] - points.front()).norm(), (points[i] - points.back()).norm());
    if (nearest > corner_radius) piece.sharpest = std::max(piece.sharpest, turns[i]);
  }
  const Point chord = points.back() - points.front();
  piece.length = chord.norm();
  piece.direction = direction_of(chord);
  const auto third = std::max<std::size_t>(1, points.size() / 3);
  piece.leaving = direction_of(points[third] - points.front());
  piece.arriving = direction_of(points.back() - points[points.size() - 1 - third]);
  piece.bulge = bulge_of(points, piece.length);
  const LineFit line = fit_line(between_corners(points));
  piece.line_direction = line.direction;
  piece.line_error = line.error;
  Point handles[2];
  piece.cubic_error = fit_cubic(points, handles);
  return piece;
}

constexpr Range any_direction{-180.0, 180.0};
constexpr Range any_bulge{-10.0, 10.0};
constexpr Range any_share{0.0, 1.0};

/// What an element of a compound stroke must look like.
struct ElementRule {
  Range direction;                 ///< of the chord [degree]
  Range share = any_share;         ///< of the stroke's length [1]
  Range leaving = any_direction;   ///< [degree]
  Range arriving = any_direction;  ///< [degree]
  Range bulge = any_bulge;         ///< left of travel positive [1]
};

struct CompoundRule {
  int id;
  std::vector<ElementRule> elements;
};

constexpr Range heng{-18.0, 30.0};
constexpr Range shu{-112.0, -68.0};
constexpr Range ti{22.0, 80.0};
constexpr Range hook_left{105.0, 205.0};
constexpr Range hook_up{55.0, 150.0};
constexpr Range hook_share{0.0, 0.34};

/// The compound strokes as sequences of limbs. Ranges are those of Kai forms with some slack: what lies outside is
/// dearer, not forbidden, so that every path has a best stroke.
const std::vector<CompoundRule>& compound_rules() {
  static const std::vector<CompoundRule> rules = {
      // heng gou: the second limb is a short straight hook; longer or curved it is heng pie (17).
      {11, {{heng}, {{-165.0, -117.5}, {0.0, 0.55}}}},
      {12, {{{-112.0, -72.0}}, {hook_left, hook_share}}},
      // wan gou bows to the right, xie gou and wo gou to the lower left.
      {13, {{{-110.0, -55.0}, any_share, {-85.0, -5.0}, {-150.0, -70.0}, {0.035, 0.4}}, {hook_left, hook_share}}},
      {14, {{{-88.0, -36.0}, any_share, {-100.0, -45.0}, {-70.0, 5.0}, {-0.14, -0.01}}, {{45.0, 135.0}, hook_share}}},
      {15, {{{-42.0, 20.0}, any_share, {-82.0, -20.0}, {-15.0, 60.0}, {-0.6, -0.08}}, {{60.0, 180.0}, hook_share}}},
      {16, {{heng}, {{-117.5, -68.0}}}},
      {17, {{heng}, {{-165.0, -98.0}, {0.34, 1.0}, any_direction, any_direction, {-0.01, 0.4}}}},
      {18, {{heng}, {{-128.0, -72.0}}, {{120.0, 215.0}, hook_share}}},
      {19, {{heng}, {shu}, {ti, {0.0, 0.45}}}},
      {20, {{heng}, {{-125.0, -72.0}}, {{-85.0, -15.0}}, {{-18.0, 30.0}}, {hook_up, hook_share}}},
      {21,
       {{heng},
        {{-82.0, -35.0}, {0.3, 1.0}, {-110.0, -65.0}, {-75.0, 25.0}, {-0.4, -0.05}},
        {{50.0, 130.0}, hook_share}}},
      {22,
       {{heng},
        {{-160.0, -105.0}, {0.1, 1.0}},
        {{-50.0, 15.0}, {0.2, 1.0}, {-140.0, -40.0}, {-20.0, 60.0}, {-0.8, -0.12}},
        {hook_up, hook_share}}},
      {23, {{heng}, {{-130.0, -75.0}}, {{-60.0, 10.0}, any_share, {-120.0, -25.0}, {-15.0, 30.0}, {-0.5, -0.03}}}},
      {24, {{heng}, {shu}, {{-18.0, 22.0}}}},
      {25, {{heng}, {shu}, {heng}, {shu}}},
      {26,
       {{heng},
        {{-150.0, -85.0}},
        {{-75.0, 25.0}, {0.0, 0.35}},
        {{-160.0, -65.0}, any_share, {-130.0, -20.0}, {-170.0, -65.0}, {-0.02, 0.5}}}},
      {27,
       {{heng},
        {{-140.0, -90.0}},
        {{-15.0, 25.0}, {0.12, 1.0}},
        {{-130.0, -75.0}, any_share, {-120.0, -60.0}, {-150.0, -80.0}, {-0.05, 0.5}},
        {{120.0, 215.0}, hook_share}}},
      {28,
       {{heng},
        {{-155.0, -90.0}},
        {{-120.0, -50.0}, any_share, {-85.0, 10.0}, {-180.0, -80.0}, {0.05, 0.8}},
        {hook_left, hook_share}}},
      {29, {{shu}, {ti, {0.0, 0.6}}}},
      // shu wan turns in a round bend, shu zhe (32) in a corner.
      {30, {{shu}, {{-75.0, -15.0}, {0.08, 0.4}, {-110.0, -45.0}, {-40.0, 20.0}, {-0.5, -0.05}}, {{-15.0, 22.0}}}},
      {31, {{{-125.0, -68.0}}, {{-80.0, -10.0}}, {{-20.0, 25.0}}, {hook_up, hook_share}}},
      {32, {{shu}, {{-15.0, 21.0}}}},
      {33, {{{-125.0, -70.0}}, {heng}, {{-165.0, -98.0}, any_share, any_direction, any_direction, {-0.02, 0.4}}}},
      {34, {{shu}, {heng}, {shu}}},
      {35,
       {{{-125.0, -70.0}},
        {heng, {0.12, 1.0}},
        {{-125.0, -78.0}, any_share, {-115.0, -65.0}, {-160.0, -80.0}, {-0.03, 0.5}},
        {{120.0, 215.0}, hook_share}}},
      {36, {{{-165.0, -108.0}}, {{-16.0, 45.0}}}},
      {37, {{{-155.0, -98.0}, any_share, {-140.0, -85.0}, {-170.0, -85.0}, {-0.05, 0.4}}, {{-75.0, -16.0}}}},
      {39, {{any_direction}, {any_direction}, {any_direction}, {any_direction}}},
  };
  return rules;
}

const CompoundRule& rule_of(int id) { return *std::ranges::find(compound_rules(), id, &CompoundRule::id); }

/// Prices in the currency of the choice, em of deviation.
constexpr double price_of_degree = 0.0009;
constexpr double price_of_bulge = 0.25;     // per unit of offset over chord
constexpr double price_of_share = 0.25;     // per unit of the stroke's length
constexpr double price_of_corner = 0.0012;  // per degree of a sharp turn inside an element
constexpr double price_of_line = 0.005;
constexpr double price_of_curve = 0.009;

/// An element has no corner inside: what turns by more than this within a few per cent of the em is one.
double corner_cost(const Piece& piece) { return price_of_corner * std::max(0.0, piece.sharpest - 40.0); }

/// Price of an element for its control points; less in a small stroke, where all deviations are small.
double price_of(char kind, double stroke_length) {
  return (kind == 'L' ? price_of_line : price_of_curve) * std::clamp(stroke_length / 0.5, 0.35, 1.0);
}

double cost_of(const ElementRule& rule, char kind, const Piece& piece, double stroke_length) {
  const double direction = kind == 'L' ? piece.line_direction : piece.direction;
  const double misplaced = price_of_degree * outside(rule.direction, direction) +
                           price_of_share * stroke_length * beyond(rule.share, piece.length / stroke_length);
  const double price = price_of(kind, stroke_length);
  if (kind == 'L') return price + piece.line_error + corner_cost(piece) + misplaced;
  return price + piece.cubic_error + corner_cost(piece) + misplaced +
         price_of_degree * (outside(rule.leaving, piece.leaving) + outside(rule.arriving, piece.arriving)) +
         price_of_bulge * stroke_length * beyond(rule.bulge, piece.bulge);
}

/// Pieces between all pairs of corners.
class PieceTable {
 public:
  PieceTable(const Path& path, std::span<const std::size_t> corners) : count_(corners.size()) {
    pieces_.resize(count_ * count_);
    const std::vector<double> turns = turns_along(path);
    for (std::size_t from = 0; from < count_; ++from) {
      for (std::size_t to = from + 1; to < count_; ++to) {
        const std::size_t points = corners[to] - corners[from] + 1;
        pieces_[from * count_ + to] =
            measure(std::span(path).subspan(corners[from], points), std::span(turns).subspan(corners[from], points));
      }
    }
  }
  std::size_t count() const { return count_; }
  const Piece& between(std::size_t from, std::size_t to) const { return pieces_[from * count_ + to]; }
  const Piece& whole() const { return between(0, count_ - 1); }

 private:
  std::size_t count_;
  std::vector<Piece> pieces_;
};

struct Choice {
  double cost = infinity;
  std::vector<std::size_t> corners;
};

/// Cheapest way to divide the path into the elements of a compound stroke, by dynamic programming over the corners.
Choice divide(const CompoundRule& rule, std::string_view kinds, const PieceTable& table, double length) {
  const std::size_t corners = table.count();
  const std::size_t elements = rule.elements.size();
  if (corners <= elements) return {};
  std::vector<double> cost((elements + 1) * corners, infinity);
  std::vector<std::size_t> previous((elements + 1) * corners, 0);
  cost[0] = 0.0;
  for (std::size_t element = 0; element < elements; ++element) {
    for (std::size_t from = element; from + 1 < corners; ++from) {
      const double before = cost[element * corners + from];
      if (before == infinity) continue;
      const std::size_t first_end = element + 1 == elements ? corners - 1 : from + 1;
      for (std::size_t to = first_end; to < corners; ++to) {
        const double total = before + cost_of(rule.elements[element], kinds[element], table.between(from, to), length);
        if (total >= cost[(element + 1) * corners + to]) continue;
        cost[(element + 1) * corners + to] = total;
        previous[(element + 1) * corners + to] = from;
      }
    }
  }
  Choice choice;
  choice.cost = cost[elements * corners + corners - 1];
  choice.corners.assign(elements + 1, corners - 1);
  for (std::size_t element = elements; element > 0; --element) {
    choice.corners[element - 1] = previous[element * corners + choice.corners[element]];
  }
  return choice;
}

/// Strokes of one element share composition and much of their geometry: fixed thresholds tell them apart, set where
/// they separate the strokes of hanzi-writer-data best. Lengths in em, directions of the chord in degrees.
int simple_stroke(const Piece& piece, bool had_entry) {
  const double direction = piece.direction;
  const double length = piece.length;
  const bool straight = piece.line_error < 0.012;
  // ti rises more steeply than a heng.
  if (contains({20.0, 130.0}, direction)) return 10;
  // A long wave that lies nearly flat is a ping na; a heng may bow a little.
  if (contains({-11.0, 20.0}, direction)) {
    return length > 0.3 && piece.line_error > 0.02 && direction < 5.0 ? 7 : 1;
  }
  if (contains({-66.0, -11.0}, direction)) {
    // dian is short and straight; chang dian ends steeper than it starts, na flatter.
    if (length < 0.22) return 8;
    if (piece.bulge > 0.012 && direction < -20.0) return 38;
    if (straight && length < 0.3) return 8;
    return direction > -27.0 ? 7 : 6;
  }
  // shu, unless it is short, leans left and starts as thin as a left dian, or ends in a pie.
  if (contains({-113.0, -66.0}, direction)) {
    if (direction < -98.0 && !had_entry && length < 0.3) return 9;
    const bool curved = piece.line_error > 0.008 && piece.bulge > 0.02;
    return direction < -90.0 && curved ? 3 : 2;
  }
  // pie. Flat and straight, as on top of 千, it is short pie.
  if (contains({-230.0, -113.0}, direction)) {
    if (!had_entry && length < 0.3 && direction > -135.0) return 9;
    const bool flat = !contains({-148.0, -113.0}, direction);
    return straight && ((flat && length < 0.5) || length < 0.15) ? 5 : 4;
  }
  return length < 0.24 ? 8 : 10;
}

/// Cost of the path as one element, with which compound strokes compete.
double simple_cost(const Piece& piece, char kind, double stroke_length) {
  const double error = kind == 'L' ? piece.line_error : piece.cubic_error;
  return price_of(kind, stroke_length) + error + corner_cost(piece) +
         0.5 * price_of_bulge * beyond({-0.25, 0.25}, piece.bulge);
}

}  // namespace

namespace {

/// Some curves follow two strokes equally well, and then what is measured here decides and not the price.
int sibling_of(const Recognition& found, const Path& path) {
  const auto element = [&](std::size_t index) {
    return std::span(path).subspan(found.splits[index], found.splits[index + 1] - found.splits[index] + 1);
  };
  const auto leaving = [&](std::size_t index) {
    return direction_of(point_after(element(index), 0, 0.12) - element(index).front());
  };
  switch (found.id) {
    case 11:  // the hook of heng gou is short; a long straight limb is a heng pie
      return path_length(element(1)) > 0.25 ? 17 : 11;
    case 15:  // wo gou starts on a slant, shu wan gou upright
      return leaving(0) < -78.0 ? 31 : 15;
    case 21: {  // heng xie gou falls all the way to its hook, heng zhe wan gou runs out level
      const std::span<const Point> curve = element(1);
      if (leaving(1) < -112.0) return 22;
      return direction_of(curve.back() - curve[curve.size() - 1 - curve.size() / 3]) > -8.0 ? 20 : 21;
    }
    case 20:
    case 22: {  // the second limb of heng xie wan gou is a pie, that of heng zhe wan gou a shu
      const std::span<const Point> limb = element(1);
      return direction_of(limb.back() - limb.front()) > -113.0 ? 20 : 22;
    }
    case 28:  // the ear of heng pie wan gou swings out to the right; heng zhe gou only leans
      return leaving(2) < -80.0 ? 18 : 28;
    default:
      return found.id;
  }
}

}  // namespace

Recognition recognise(const Path& path, std::span<const std::size_t> corners, bool had_entry) {
  const PieceTable table(path, corners);
  const double length = path_length(path);
  const Piece& whole = table.whole();
  Recognition best{simple_stroke(whole, had_entry), {0, path.size() - 1}};
  double best_cost = simple_cost(whole, typical_stroke(best.id).elements[0], length);
  const auto consider = [&](const CompoundRule& rule, double discount) {
    Choice choice = divide(rule, typical_stroke(rule.id).elements, table, length);
    // A circle closes; nothing else that turns so far does.
    if (rule.id == 39) choice.cost += 0.6 * whole.length;
    if (choice.cost == infinity || choice.cost - discount >= best_cost) return;
    best_cost = choice.cost - discount;
    best.id = rule.id;
    best.splits.clear();
    for (const std::size_t corner : choice.corners) best.splits.push_back(corners[corner]);
  };
  for (const CompoundRule& rule : compound_rules()) consider(rule, 0.0);
  const int sibling = sibling_of(best, path);
  if (sibling != best.id) consider(rule_of(sibling), infinity);
  return best;
}

Line line_through(std::span<const Point> points) {
  Point mean = Point::Zero();
  for (const Point& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const Point& point : points) moments += (point - mean) * (point - mean).transpose();
  const double angle = 0.5 * std::atan2(2.0 * moments(0, 1), moments(0, 0) - moments(1, 1));
  return {mean, Point(std::cos(angle), std::sin(angle))};
}

}  // namespace calligraphy::recognition
