#include "polyline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace calligraphy_test {

using namespace calligraphy;

namespace {

struct Place {
  std::size_t before;  ///< the last point that is not beyond it
  Point point;
};

Place place_at(const PenPath& path, double share) {
  double left = share * path_length(path);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double step = (path[i + 1] - path[i]).norm();
    if (left < step) return {i, path[i] + left / step * (path[i + 1] - path[i])};
    left -= step;
  }
  return {path.size() - 1, path.back()};
}

double cross_product(const Point& one, const Point& other) { return one.x() * other.y() - one.y() * other.x(); }

}  // namespace

Box box_of(const PenPath& path) {
  Box box;
  for (const Point& point : path) box.extend(point);
  return box;
}

Box box_of(std::span<const PenPath> paths) {
  Box box;
  for (const PenPath& path : paths) box.extend(box_of(path));
  return box;
}

double chord(const PenPath& path) { return (path.back() - path.front()).norm(); }

Point point_at(const PenPath& path, double share) { return place_at(path, share).point; }

std::pair<PenPath, PenPath> cut(const PenPath& path, double share) {
  const Place place = place_at(path, share);
  const auto after = path.begin() + static_cast<std::ptrdiff_t>(place.before) + 1;
  PenPath first(path.begin(), after), second{place.point};
  first.push_back(place.point);
  second.insert(second.end(), after, path.end());
  return {first, second};
}

PenPath part_of(const PenPath& path, double from, double to) {
  const double length = path_length(path);
  return cut(cut(path, to / length).first, from / to).second;
}

PenPath evenly(const PenPath& path, int count) {
  PenPath even;
  for (int i = 0; i < count; ++i) even.push_back(point_at(path, static_cast<double>(i) / (count - 1)));
  return even;
}

std::vector<Crossing> crossings(const PenPath& one, const PenPath& other) {
  std::vector<Crossing> found;
  if (!box_of(one).intersects(box_of(other))) return found;
  double along_one = 0.0;
  for (std::size_t i = 0; i + 1 < one.size(); ++i) {
    const Point step = one[i + 1] - one[i];
    double along_other = 0.0;
    for (std::size_t j = 0; j + 1 < other.size(); ++j) {
      const Point other_step = other[j + 1] - other[j], between = other[j] - one[i];
      const double area = cross_product(step, other_step);
      if (std::abs(area) > 1e-15) {
        const double share = cross_product(between, other_step) / area;
        const double other_share = cross_product(between, step) / area;
        if (share >= 0.0 && share < 1.0 && other_share >= 0.0 && other_share < 1.0) {
          found.push_back({along_one + share * step.norm(), along_other + other_share * other_step.norm()});
        }
      }
      along_other += other_step.norm();
    }
    along_one += step.norm();
  }
  return found;
}

double depth(const PenPath& one, const PenPath& other) {
  const double length = path_length(one), other_length = path_length(other);
  double deepest = 0.0;
  for (const Crossing& each : crossings(one, other)) {
    deepest = std::max(deepest, std::min({each.one, length - each.one, each.other, other_length - each.other}));
  }
  return deepest;
}

Nearest nearest(const Point& to, const PenPath& path) {
  Nearest best{path.front(), (to - path.front()).norm(), 0.0, 1.0};
  double along = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point step = path[i + 1] - path[i];
    const double square = step.squaredNorm();
    const double share = square > 0.0 ? std::clamp((to - path[i]).dot(step) / square, 0.0, 1.0) : 0.0;
    const Point point = path[i] + share * step;
    const double distance = (to - point).norm();
    if (distance < best.distance || i == 0) {
      best = {point, distance, along + share * step.norm(), cross_product(step, to - point) < 0.0 ? -1.0 : 1.0};
    }
    along += step.norm();
  }
  return best;
}

double bow(const PenPath& path) {
  const Point across = path.back() - path.front();
  double most = 0.0;
  for (const Point& point : path) {
    const Point from = point - path.front();
    most = std::max(most, across.norm() > 1e-9 ? std::abs(cross_product(across, from)) / across.norm() : from.norm());
  }
  return most;
}

std::optional<double> hook_start(const PenPath& path) {
  constexpr int count = 32, beside = 3;
  constexpr double least_turn = std::numbers::pi / 3.0;
  const PenPath even = evenly(path, count);
  const double length = path_length(path), longest = std::min(0.35 * length, 0.2);
  const auto turn = [&](int i) {
    const auto at = [&](int k) { return even[static_cast<std::size_t>(k)]; };
    const Point before = at(i) - at(i - beside), after = at(i + beside) - at(i);
    return std::abs(std::atan2(cross_product(before, after), before.dot(after)));
  };
  for (int i = count - 1 - beside; i >= beside; --i) {
    const double along = length * i / (count - 1);
    if (length - along > longest) return std::nullopt;
    if (turn(i) < least_turn) continue;
    while (i > beside && turn(i - 1) > turn(i)) --i;
    return length * i / (count - 1);
  }
  return std::nullopt;
}

PenPath straight_line(const Point& from, const Point& to) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / 0.01)));
  PenPath path;
  for (int i = 0; i <= steps; ++i) path.push_back(from + (to - from) * i / steps);
  return path;
}

}  // namespace calligraphy_test
