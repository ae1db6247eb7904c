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

// Log odds that a y axis points down, for a motion down by an angle from x of 0 to 22.5 degrees, 22.5 to 45 and so on
// to 180; a motion up counts against it. Logistic regression on every other character of hanzi-writer-data and its mirror
// image, turned at random by 6 degrees (RMS).
constexpr std::size_t sectors = 8;
constexpr std::array<double, sectors> stroke_odds = {-0.2, 0.7, 0.75, 0.9, 0.9, 0.7, 0.1, 0.1};  // first to last point
constexpr std::array<double, sectors> move_odds = {0.0, 0.0, 0.1, 0.65, 0.65, 0.4, 0.25, 0.1};   // to the next stroke

constexpr double least_axis_evidence = 5.0;       // of both together
constexpr double least_axis_evidence_each = 1.0;  // of either alone

struct AxisEvidence {
  double strokes = 0.0, moves = 0.0;  ///< log odds that it points down
  double heng = 0.0;                  ///< number of heng to the right, less those to the left
};

double odds_of(const Point& motion, const std::array<double, sectors>& odds) {
  if (!(motion.norm() > tap_length)) return 0.0;
  const double angle = std::atan2(std::abs(motion.y()), motion.x());  // from 0 to pi
  const auto sector = std::min(sectors - 1, static_cast<std::size_t>(angle / std::numbers::pi * sectors));
  return motion.y() < 0.0 ? odds[sector] : -odds[sector];
}

AxisEvidence evidence_of(const PenTrace& trace) {
  AxisEvidence evidence;
  std::optional<Point> last;  // middle of the stroke before
  for (const PenPath& path : pen_paths(trace)) {
    if (path_length(path) < tap_length) continue;
    const Point motion = path.back() - path.front();
    evidence.strokes += odds_of(motion, stroke_odds);
    const double slope = std::tan(std::numbers::pi / sectors);
    if (motion.norm() > tap_length && std::abs(motion.y()) < slope * std::abs(motion.x())) {
      evidence.heng += motion.x() > 0.0 ? 1.0 : -1.0;
    }
    Point low = path.front(), high = path.front();
    for (const Point& point : path) low = low.cwiseMin(point), high = high.cwiseMax(point);
    const Point middle = (low + high) / 2.0;
    if (last) evidence.moves += odds_of(middle - *last, move_odds);
    last = middle;
  }
  return evidence;
}

}  // namespace

const char* to_string(YAxis axis) noexcept {
  static constexpr const char* names[] = {"down", "up"};
  return name_of<YAxis::up>(axis, names, "unknown");
}

std::optional<YAxis> recognise_y_axis(std::span<const PenTrace> traces) {
  struct OfCharacter {
    AxisEvidence sum;
    double traces = 0.0;
  };
  std::map<char32_t, OfCharacter> characters;
  for (const PenTrace& trace : traces) {
    OfCharacter& character = characters[trace.character];
    const AxisEvidence evidence = evidence_of(trace);
    character.sum.strokes += evidence.strokes;
    character.sum.moves += evidence.moves;
    character.sum.heng += evidence.heng;
    character.traces += 1.0;
  }
  AxisEvidence all;
  for (const auto& [code, character] : characters) {
    all.strokes += character.sum.strokes / character.traces;
    all.moves += character.sum.moves / character.traces;
    all.heng += character.sum.heng / character.traces;
  }
  const double together = all.strokes + all.moves;
  const double least = std::min(all.strokes, all.moves), most = std::max(all.strokes, all.moves);
  if (together > least_axis_evidence && least > least_axis_evidence_each) return YAxis::down;
  if (together < -least_axis_evidence && most < -least_axis_evidence_each && all.heng > 0.0) return YAxis::up;
  return std::nullopt;
}

void turn_over(PenTrace& trace) noexcept {
  for (std::vector<PenStroke>* const strokes : {&trace.strokes, &trace.air}) {
    for (PenStroke& stroke : *strokes) {
      for (TimedPoint& point : stroke) point.point.y() = 1.0 - point.point.y();
    }
  }
}

}  // namespace calligraphy
