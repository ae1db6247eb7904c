#include "brush.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "direction_range.hpp"

namespace calligraphy::recognition {
namespace {

/// Lengths of brush traces [em], measured on hanzi-writer-data.
constexpr double max_entry = 0.095;
constexpr double max_droop = 0.055;
constexpr double max_lift_share = 0.095;  // [1], relative to the stroke's length; a hook is longer
constexpr double max_press = 0.1;

/// Directions in which a brush is set down: from the upper left, or curling in before a ti or a pie.
constexpr Range set_down{-95.0, 8.0};
constexpr Range curl_before_ti{70.0, 150.0};
constexpr Range curl_before_pie{130.0, 230.0};

/// True if a start piece with this direction belongs to the brush when the stroke continues in direction `body`.
/// Strokes to the right or upwards are entered from the upper left with a left turn, downward strokes with a right
/// turn. A na and a dian start thin and have no entry, so directions in between are not changed.
bool is_entry(double piece, double body) {
  const double turn = wrapped(body - piece);
  if (contains(curl_before_ti, piece) && contains({30.0, 80.0}, body)) return turn < -10.0;
  if (contains(curl_before_pie, piece) && contains({-180.0, -105.0}, body)) return turn > 10.0;
  if (!contains(set_down, piece)) return false;
  if (contains({-15.0, 80.0}, body)) return turn > 8.0;
  return contains({-200.0, -62.0}, body) && turn < -10.0;
}

/// True if an end piece with this direction belongs to the brush, which is lifted towards the lower right after a heng,
/// downwards after a pie, and sideways after a ti or shu. Hooks turn by more than that.
bool is_droop(double piece, double body) {
  const double turn = wrapped(piece - body);
  if (contains({-20.0, 30.0}, body)) return turn < -12.0 && turn > -115.0;
  if (contains({-175.0, -112.0}, body)) return turn > 12.0 && turn < 90.0;
  if (contains({30.0, 80.0}, body)) return std::abs(turn) > 12.0 && std::abs(turn) < 80.0;
  return contains({-112.0, -20.0}, body) && turn < -12.0 && turn > -75.0;
}

/// At its end, a heng may be pressed for longer than other strokes.
bool is_press(double piece, double body) {
  const double turn = wrapped(piece - body);
  return contains({-10.0, 25.0}, body) && turn < -12.0 && turn > -70.0;
}

/// After a shu or a zhe the brush may be lifted to the left; a hook is longer.
bool is_lift(double piece, double body) {
  const double turn = wrapped(piece - body);
  return contains({-118.0, -62.0}, body) && turn < -12.0 && turn > -140.0;
}

/// Number of vertices at the start that belong to the brush entry.
std::size_t entry_vertices(std::span<const Point> path, double length) {
  const double limit = std::min(max_entry, 0.4 * length);
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
      break;  // the first limb of the stroke has begun
    }
  }
  return cut;
}

/// Number of vertices at the end that belong to the droop.
std::size_t droop_vertices(std::span<const Point> path, double length) {
  const Path reversed(path.rbegin(), path.rend());
  const double limit = std::min(max_press, 0.25 * length);
  double travelled = 0.0;
  std::size_t cut = 0;
  for (std::size_t i = 1; i + 1 < reversed.size(); ++i) {
    travelled += (reversed[i] - reversed[i - 1]).norm();
    if (travelled > limit) break;
    const double piece = direction_of(reversed.front() - reversed[i]);
    const double look_back = std::clamp(0.2 * length, 0.03, 0.10);
    const double body = direction_of(reversed[i] - point_after(reversed, i, look_back));
    const bool drooped = travelled <= max_droop && is_droop(piece, body);
    // A lift starts at a corner, before which the path follows the body.
    const bool at_corner = std::abs(wrapped(direction_of(reversed[i] - reversed[i + 1]) - body)) < 25.0;
    const bool lifted = travelled <= std::min(max_press, max_lift_share * length) && at_corner && is_lift(piece, body);
    if (drooped || lifted || is_press(piece, body)) cut = i;
  }
  return cut;
}

CleanPath as_drawn(std::span<const Point> points) {
  constexpr double reach = 0.04;           // [em]
  constexpr std::size_t max_points = 512;  // more points add less detail than a pen can show
  constexpr double simplification = 2e-5;  // [em]
  CleanPath clean;
  clean.points = without_repeats(points);
  if (clean.points.size() > max_points) clean.points = simplified(clean.points, max_points, simplification);
  const Path& path = clean.points;
  clean.first = direction_of(point_after(path, 0, reach) - path.front());
  clean.last = direction_of(path.back() - point_before(path, path.size() - 1, reach));
  return clean;
}

}  // namespace

CleanPath clean_median(std::span<const Point> median) {
  CleanPath clean = as_drawn(median);
  const Path path = clean.points;
  const double length = path_length(path);
  const std::size_t entry = entry_vertices(path, length);
  const std::size_t droop = droop_vertices(path, length);
  clean.had_entry = entry > 0;
  if (entry + droop + 2 <= path.size()) {
    clean.points.assign(path.begin() + static_cast<std::ptrdiff_t>(entry),
                        path.end() - static_cast<std::ptrdiff_t>(droop));
  }
  return clean;
}

CleanPath clean_pen_path(std::span<const Point> path) { return as_drawn(path); }

}  // namespace calligraphy::recognition
