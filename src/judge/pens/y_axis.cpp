#include <calligraphy/judge/y_axis.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>

#include <calligraphy/judge/pen_path.hpp>

#include "base/enum_name.hpp"

namespace calligraphy {
namespace {

// Logarithms of how often people's strokes, from first to last point, and their moves from the middle of one stroke to
// that of the next go in a direction: each sixteenth of a turn, counterclockwise from the right. From every other character
// of hanzi-writer-data, turned at random by 7 degrees (RMS).
constexpr std::size_t sectors = 16;
using Directions = std::array<double, sectors>;
constexpr Directions stroke_directions = {-1.66, -2.25, -4.74, -4.62, -4.97, -5.07, -5.08, -5.08,
                                          -4.9,  -4.02, -3.03, -2.28, -1.89, -2.22, -1.98, -2.45};
constexpr Directions move_directions = {-2.17, -2.25, -2.83, -3.38, -4.02, -3.6,  -3.87, -4.07,
                                        -3.49, -2.82, -2.28, -2.23, -1.87, -2.56, -3.4,  -3.25};
constexpr double quarter_turn = 0.5 * std::numbers::pi;
constexpr double least_axis_evidence = 1.2;  // logarithm of how much likelier than the next explanation

/// How a page may have been read: turned by quarters, mirrored or not, the strokes written from their ends or not.
constexpr std::size_t explanations = 16;
constexpr std::size_t as_it_is = 0, mirrored = 8;  // without a turn and with strokes forwards
using Likelihoods = std::array<double, explanations>;  ///< their logarithms

/// Adds how likely a motion is by each explanation.
void add_motion(const Point& motion, const Directions& directions, bool is_stroke, Likelihoods& sum) {
  if (!(motion.norm() > tap_length)) return;
  const double angle = std::atan2(motion.y(), motion.x());
  for (std::size_t i = 0; i < explanations; ++i) {
    const bool is_backwards = i % 8 >= 4;
    const double turned = angle - static_cast<double>(i % 4) * quarter_turn;
    const double written = (i < mirrored ? turned : -turned) + (is_stroke && is_backwards ? std::numbers::pi : 0.0);
    const auto sector = std::lround(written / (2.0 * std::numbers::pi) * sectors);
    sum[i] += directions[static_cast<std::size_t>(sector + 4 * static_cast<long>(sectors)) % sectors];
  }
}

Likelihoods likelihoods_of(const PenTrace& trace) {
  Likelihoods sum{};
  std::optional<Point> last;  // middle of the stroke before
  for (const PenPath& path : pen_paths(trace)) {
    if (path_length(path) < tap_length) continue;
    add_motion(path.back() - path.front(), stroke_directions, true, sum);
    Point low = path.front(), high = path.front();
    for (const Point& point : path) low = low.cwiseMin(point), high = high.cwiseMax(point);
    const Point middle = (low + high) / 2.0;
    if (last) add_motion(middle - *last, move_directions, false, sum);
    last = middle;
  }
  return sum;
}

}  // namespace

const char* to_string(YAxis axis) noexcept {
  static constexpr const char* names[] = {"down", "up"};
  return name_of<YAxis::up>(axis, names, "unknown");
}

std::optional<YAxis> recognise_y_axis(std::span<const PenTrace> traces) {
  std::map<char32_t, double> counts;
  for (const PenTrace& trace : traces) counts[trace.character] += 1.0;
  Likelihoods all{};
  for (const PenTrace& trace : traces) {
    const Likelihoods sum = likelihoods_of(trace);
    for (std::size_t i = 0; i < explanations; ++i) all[i] += sum[i] / counts[trace.character];
  }
  const auto best = static_cast<std::size_t>(std::max_element(all.begin(), all.end()) - all.begin());
  for (std::size_t i = 0; i < explanations; ++i) {
    if (i != best && all[best] - all[i] < least_axis_evidence) return std::nullopt;
  }
  if (best == as_it_is) return YAxis::down;
  return best == mirrored ? std::optional(YAxis::up) : std::nullopt;
}

void turn_over(PenTrace& trace) noexcept {
  for (std::vector<PenStroke>* const strokes : {&trace.strokes, &trace.air}) {
    for (PenStroke& stroke : *strokes) {
      for (TimedPoint& point : stroke) point.point.y() = 1.0 - point.point.y();
    }
  }
}

}  // namespace calligraphy
