#include <algorithm>
#include <cmath>
#include <cstddef>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/tradeoff.hpp>
#include <calligraphy/model/placed_character.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr int narrowest = 4, widest = 16;  // [bits]
constexpr int points_per_element = 64;

struct Distances {
  double largest = 0.0;
  double weighted_squares = 0.0, length = 0.0;
};

/// How far the points of one stroke are from another, evenly over its length.
void measure(const std::vector<StrokeElement>& from, const std::vector<StrokeElement>& to, Distances& distances) {
  for (const StrokeElement& element : from) {
    const double weight = element.length() / points_per_element;
    for (int i = 0; i <= points_per_element; ++i) {
      const Point point = element.point(element.parameter_at(element.length() * i / points_per_element));
      double distance = nearest_point(to.front(), point).distance;
      for (const StrokeElement& other : to) distance = std::min(distance, nearest_point(other, point).distance);
      distances.largest = std::max(distances.largest, distance);
      const double share = i == 0 || i == points_per_element ? 0.5 : 1.0;
      distances.weighted_squares += share * weight * distance * distance;
      distances.length += share * weight;
    }
  }
}

double stored_bytes(const Character& character, int bits) {
  const auto coordinates = 2.0 * static_cast<double>(character.structure.control_points.size());
  return character.stroke_count() + std::ceil(coordinates * bits / 8.0);
}

}  // namespace

Character with_coordinate_width(const Character& character, int bits) {
  require_within("coordinate width", bits, "bits", 1, 32);
  const double steps = std::exp2(bits) - 1.0;
  Character rounded = character;
  for (Point& point : rounded.structure.control_points) {
    point = (point.cwiseMax(0.0).cwiseMin(1.0) * steps).array().round() / steps;
  }
  return rounded;
}

std::vector<CoordinateWidthTradeoff> coordinate_width_tradeoff(std::span<const Character> characters,
                                                               const std::function<void(double)>& progress) {
  if (characters.empty()) throw ValueError("coordinate width: no characters");
  const Placement em_square{Point::Zero(), 1.0};
  const double total = static_cast<double>(characters.size()) * (widest - narrowest + 1);
  double done = 0.0;
  std::vector<CoordinateWidthTradeoff> tradeoff;
  for (int bits = narrowest; bits <= widest; ++bits) {
    CoordinateWidthTradeoff entry;
    entry.bits = bits;
    entry.step = 1.0 / (std::exp2(bits) - 1.0);
    Distances distances;
    for (const Character& character : characters) {
      const Character rounded = with_coordinate_width(character, bits);
      const std::vector<Stroke> true_strokes = strokes(character), stored_strokes = strokes(rounded);
      for (std::size_t i = 0; i < true_strokes.size(); ++i) {
        const auto as_drawn = place_elements(true_strokes[i], em_square);
        const auto as_stored = place_elements(stored_strokes[i], em_square);
        measure(as_drawn, as_stored, distances);
        measure(as_stored, as_drawn, distances);
      }
      entry.bytes += stored_bytes(character, bits) / static_cast<double>(characters.size());
      if (progress) progress(++done / total);
    }
    entry.max_error = distances.largest;
    entry.rms_error = distances.length > 0.0 ? std::sqrt(distances.weighted_squares / distances.length) : 0.0;
    tradeoff.push_back(entry);
  }
  return tradeoff;
}

}  // namespace calligraphy
