#include "stroke_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>

namespace calligraphy_test {

using namespace calligraphy;

namespace {

constexpr int chords = 48;  // per element

/// By de Casteljau's algorithm.
Point bezier_point(std::vector<Point> row, double t) {
  for (std::size_t left = row.size() - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i) row[i] += t * (row[i + 1] - row[i]);
  }
  return row[0];
}

}  // namespace

StrokeLine::StrokeLine(std::vector<Point> points) : points_(std::move(points)) { measure(); }

StrokeLine::StrokeLine(const Stroke& stroke, const Placement& placement) {
  points_ = {placement.to_page(stroke.control_points[0])};
  std::size_t first = 0;
  for (std::size_t element = 0; element < stroke.elements.size(); ++element) {
    const bool line = stroke.elements[element] == 'L';
    const auto degree = static_cast<std::size_t>(line ? 1 : stroke.curve_degree);
    std::vector<Point> control;
    for (std::size_t i = 0; i <= degree; ++i) control.push_back(placement.to_page(stroke.control_points[first + i]));
    for (int i = 1; i <= chords; ++i) points_.push_back(bezier_point(control, static_cast<double>(i) / chords));
    first += degree;
  }
  measure();
}

void StrokeLine::measure() {
  arcs_ = {0.0};
  for (std::size_t i = 1; i < points_.size(); ++i) arcs_.push_back(arcs_.back() + (points_[i] - points_[i - 1]).norm());
}

/// Index of the end of the chord that contains `arc`.
std::size_t StrokeLine::chord(double arc) const {
  const auto above = std::upper_bound(arcs_.begin() + 1, arcs_.end() - 1, arc);
  return static_cast<std::size_t>(above - arcs_.begin());
}

Point StrokeLine::at(double arc) const {
  const std::size_t i = chord(arc);
  const double way = arcs_[i] - arcs_[i - 1];
  const double share = way > 0.0 ? std::clamp((arc - arcs_[i - 1]) / way, 0.0, 1.0) : 1.0;
  return points_[i - 1] + share * (points_[i] - points_[i - 1]);
}

Point StrokeLine::tangent(double arc) const {
  for (std::size_t i = chord(arc); i > 0; --i) {
    const double way = arcs_[i] - arcs_[i - 1];
    if (way > 0.0) return (points_[i] - points_[i - 1]) / way;
  }
  return Point::Zero();
}

double StrokeLine::distance(const Point& from) const { return (at(nearest_arc(from, 0.0, length())) - from).norm(); }

double StrokeLine::nearest_arc(const Point& from, double low, double high) const {
  double least = std::numeric_limits<double>::infinity(), best = 0.0;
  const std::size_t last = chord(high);
  for (std::size_t i = chord(low); i <= last; ++i) {
    const Point edge = points_[i] - points_[i - 1];
    const double square = edge.squaredNorm();
    const double way = arcs_[i] - arcs_[i - 1];
    double share = square > 0.0 ? (from - points_[i - 1]).dot(edge) / square : 0.0;
    if (way > 0.0) {
      const double lowest = std::clamp((low - arcs_[i - 1]) / way, 0.0, 1.0);
      share = std::clamp(share, lowest, std::clamp((high - arcs_[i - 1]) / way, lowest, 1.0));
    }
    const double distance = (points_[i - 1] + share * edge - from).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = arcs_[i - 1] + share * way;
  }
  return best;
}

StrokeLine StrokeLine::part(double from, double to) const {
  const double first = from * length(), last = to * length();
  std::vector<Point> points = {at(first)};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (arcs_[i] > first && arcs_[i] < last) points.push_back(points_[i]);
  }
  points.push_back(at(last));
  return StrokeLine(std::move(points));
}

StrokeLine StrokeLine::reversed() const { return StrokeLine(std::vector<Point>(points_.rbegin(), points_.rend())); }

std::vector<StrokeLine> stroke_lines(const PlacedCharacter& placed) {
  std::vector<StrokeLine> lines;
  for (const Stroke& stroke : strokes(placed.character)) lines.emplace_back(stroke, placed.placement);
  return lines;
}

double mean_distance(const StrokeLine& one, const StrokeLine& other) {
  constexpr int steps = 32;
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    sum += (one.at(share * one.length()) - other.at(share * other.length())).norm();
  }
  return sum / (steps + 1);
}

PracticePage page_of(const Character& character, double em) {
  PageLayout layout;
  layout.em = em;
  return lay_out(std::span(&character, 1), layout).front();
}

std::vector<Character> some_characters(const std::string& file, int count, std::uint64_t seed) {
  if (file.empty()) {
    std::vector<Character> all = built_in_characters().characters;
    all.resize(std::min(all.size(), static_cast<std::size_t>(count)));
    return all;
  }
  const CharacterSet set = CharacterSet::open(file);
  std::vector<char32_t> codes;
  for (const StoredCharacter& stored : set) codes.push_back(stored.code());
  Random random(seed);
  shuffle(codes, random);
  codes.resize(std::min(codes.size(), static_cast<std::size_t>(count)));
  std::vector<Character> characters;
  for (const char32_t code : codes) characters.push_back(set.find(code)->character());
  return characters;
}

}  // namespace calligraphy_test
