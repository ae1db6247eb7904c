#include "stroke_division.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace calligraphy::recognition {
namespace {

constexpr std::size_t most_joints = 48;
constexpr double free_turn = 35.0;          // [degree] from the typical direction, free of cost
constexpr double price_of_degree = 0.0005;  // [em]; for turns beyond that

/// Directions of an element in the typical stroke [degree]; if that is a line, all the same.
struct ElementDirections {
  double leaving;
  double arriving;
  double chord;
};

std::vector<ElementDirections> directions_of(const TypicalStroke& type) {
  std::vector<ElementDirections> directions;
  std::size_t at = 0;
  const auto between = [&](std::size_t from, std::size_t to) {
    return direction_of(Point(type.shape[to][0] - type.shape[from][0], type.shape[to][1] - type.shape[from][1]));
  };
  for (const char kind : type.elements) {
    const std::size_t end = at + (kind == 'L' ? 1 : 3);
    directions.push_back({between(at, at + 1), between(end - 1, end), between(at, end)});
    at = end;
  }
  return directions;
}

double turn_beyond(const Point& from, const Point& to, double typical) {
  return std::max(0.0, std::abs(wrapped(direction_of(to - from) - typical)) - free_turn);
}

/// Cost of the deviation of points `from` to `to` of the path from the directions of the typical element [em^2].
double price_of_directions(const Path& path, std::size_t from, std::size_t to, char kind,
                           const ElementDirections& typical) {
  double turn;
  if (kind == 'L' || to - from < 3) {
    turn = turn_beyond(path[from], path[to], typical.chord);
  } else {
    const std::size_t third = (to - from) / 3;
    turn = 0.5 * (turn_beyond(path[from], path[from + third], typical.leaving) +
                  turn_beyond(path[to - third], path[to], typical.arriving));
  }
  const double price = price_of_degree * turn;
  return price * price;
}

}  // namespace

StrokeDivider::StrokeDivider(const Path& path) : path_(path), pieces_(path) {
  const std::size_t stride = std::max<std::size_t>(1, path.size() / most_joints);
  for (std::size_t i = 0; i + 1 < path.size(); i += stride) places_.push_back(i);
  places_.push_back(path.size() - 1);
  residuals_.assign(2 * places_.size() * places_.size(), -1.0);
}

double StrokeDivider::residual(std::size_t from, std::size_t to, char kind) {
  double& known = residuals_[2 * (from * places_.size() + to) + (kind == 'L' ? 0 : 1)];
  if (known < 0.0) known = pieces_.residual(places_[from], places_[to], kind == 'L' ? 1 : 3);
  return known;
}

Division StrokeDivider::divide(const TypicalStroke& type, std::string_view elements) {
  const std::vector<ElementDirections> directions = directions_of(type);
  const double points = static_cast<double>(path_.size());
  const double parts = static_cast<double>(elements.size());
  const auto cost = [&](std::size_t element, std::size_t from, std::size_t to, double before, double best) {
    const char kind = elements[element];
    const double total = before + residual(from, to, kind) / points;
    if (total >= best) return total;
    return total + price_of_directions(path_, places_[from], places_[to], kind, directions[element]) / parts;
  };
  Division division;
  division.cost = divide_at_least_cost(elements.size(), places_.size(), division.ends, cost);
  for (std::size_t& end : division.ends) end = places_[end];
  return division;
}

}  // namespace calligraphy::recognition
