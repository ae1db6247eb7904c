#include "shape_contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::recognition {
namespace {

/// The directions in which strokes of one element run [degree]: within `reach` of `middle`.
struct Direction {
  int id;
  double middle;
  double reach;
};
constexpr Direction kind_directions[] = {
    {1, -2.0, 18.0},    // heng
    {2, -90.0, 27.0},   // shu
    {3, -132.0, 50.0},  // pie
    {4, -132.0, 50.0},
    {5, -132.0, 50.0},
    {6, -37.0, 43.0},  // na
    {7, -37.0, 43.0},
    {8, -90.0, 85.0},  // dots fall
    {9, -90.0, 85.0},
    {38, -90.0, 85.0},
    {10, 42.0, 43.0},  // ti
};

bool is_simple(int id) { return typical_stroke(id).elements.size() == 1; }

bool is_one_of(int id, std::span<const int> ids) { return std::find(ids.begin(), ids.end(), id) != ids.end(); }

/// True for a stroke that ends with a hook; that of a heng gou looks more like the limb of a heng pie.
bool has_hook(int id) {
  constexpr int hooked[] = {12, 13, 14, 15, 18, 20, 21, 22, 27, 28, 31, 35};
  return is_one_of(id, hooked);
}

/// Direction of the path without the slants at its ends [degree].
double main_direction(std::span<const Point> path) {
  constexpr double end = 0.15;  // [1]
  const double length = path_length(path);
  const Path middle = resampled(path, 2, end * length, (1.0 - end) * length);
  return direction_of(middle[1] - middle[0]);
}

/// Sum of all turns, to either side [degree].
double turning(std::span<const Point> path) {
  constexpr double step = 0.02;  // [em]
  constexpr int most = 200;
  const Path points = resampled(path, step, most);
  double sum = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    sum += std::abs(wrapped(direction_of(points[i] - points[i - 1]) - direction_of(points[i - 1] - points[i - 2])));
  }
  return sum;
}

double typical_turning(int id) {
  StrokeInput typical{id, {}};
  for (const auto& [x, y] : typical_stroke(id).shape) typical.control_points.emplace_back(x, y);
  return turning(flattened(typical));
}

/// True if the path ends with a hook: a sharp turn in its last two fifths, at least `shortest` from its end [em].
bool ends_in_hook(std::span<const Point> path, double shortest) {
  constexpr double sharp = 60.0;   // [degree]
  constexpr double before = 0.03;  // [em]
  constexpr double share = 0.4;    // [1]
  constexpr int most = 800;
  const Path points = resampled(path, 0.005, most);
  const double length = path_length(path);
  const double step = length / static_cast<double>(points.size() - 1);
  const auto back = static_cast<std::size_t>(std::max(1.0, std::round(std::min(before, 0.2 * length) / step)));
  const auto first = static_cast<std::size_t>((1.0 - share) * static_cast<double>(points.size() - 1));
  for (std::size_t i = std::max(back, first); i + 1 < points.size(); ++i) {
    const Point rest = points.back() - points[i];
    if (rest.norm() < shortest) break;
    if (std::abs(wrapped(direction_of(rest) - direction_of(points[i] - points[i - back]))) >= sharp) return true;
  }
  return false;
}

}  // namespace

bool is_misdirected(std::span<const Point> path, std::span<const int> ids) {
  const double direction = main_direction(path);
  return std::none_of(std::begin(kind_directions), std::end(kind_directions), [&](const Direction& kind) {
    return is_one_of(kind.id, ids) && std::abs(wrapped(direction - kind.middle)) <= kind.reach;
  });
}

bool contradicts(std::span<const Point> path, bool brush, std::span<const int> ids, int recognised) {
  constexpr double most = 60.0;        // [degree]
  constexpr double brush_hook = 0.04;  // [em]; a lift is shorter
  constexpr double pen_hook = 0.012;   // [em]
  if (ids.empty() || is_one_of(recognised, ids)) return false;
  const auto all = [&](auto condition) { return std::all_of(ids.begin(), ids.end(), condition); };
  if (all(is_simple)) {
    return is_misdirected(path, ids) ||
           (!is_simple(recognised) && ends_in_hook(path, brush ? brush_hook : pen_hook));
  }
  if (brush) return recognised == 13 && is_one_of(12, ids);
  const double turned = turning(path);
  if (all(has_hook)) {
    return !has_hook(recognised) && all([&](int id) { return turned < typical_turning(id) - most; });
  }
  return has_hook(recognised) &&
         all([&](int id) { return !has_hook(id) && turned > typical_turning(id) + most; });
}

}  // namespace calligraphy::recognition
