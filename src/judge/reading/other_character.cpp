#include "other_character.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "judge/judge_constants.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

/// The points of a stroke.
using StrokePoints = Eigen::Matrix<float, points_in_stroke, 2, Eigen::RowMajor>;

/// The rotation nearest to a map without reflection.
Eigen::Matrix2d rotation_of(const Eigen::Matrix2d& map) {
  return Eigen::Rotation2Dd(std::atan2(map(1, 0) - map(0, 1), map(0, 0) + map(1, 1))).toRotationMatrix();
}

/// The feature with its strokes in the order and direction in which the pen-downs were read as strokes of the character
/// asked for; empty unless each wrote exactly one.
CharacterFeature as_read(const CharacterFeature& feature, const StrokeReading& reading) {
  CharacterFeature read(feature.size());
  for (const ReadingStep& step : reading.steps) {
    if (step.paths != 1 || step.strokes != 1) return {};
    StrokePoints points = StrokePoints::Map(feature.data() + step.path * StrokePoints::SizeAtCompileTime);
    if (reading.pair(step).backwards) points = points.colwise().reverse().eval();
    StrokePoints::Map(read.data() + step.stroke * StrokePoints::SizeAtCompileTime) = points;
  }
  return read;
}

}  // namespace

std::optional<OtherCharacter> other_character(const CharacterFeatures& characters, const Character& asked_for,
                                              std::span<const PenPath> paths, const StrokeReading& reading) {
  if (paths.size() != reading.costs->strokes() || paths.empty()) return std::nullopt;
  const CharacterFeature asked = character_feature(asked_for);
  CharacterFeatures::Neighbour nearest;
  double from_asked = std::numeric_limits<double>::infinity(), from_asked_as_read = from_asked;
  // Both turned upright as in the reading and as it is: the reading of another character may turn it wrongly.
  const Eigen::Matrix2d as_it_is = Eigen::Matrix2d::Identity();
  for (const Eigen::Matrix2d& turn : {rotation_of(reading.costs->fit().linear), as_it_is}) {
    std::vector<Outline> drawn;
    for (const PenPath& path : paths) drawn.push_back(outline(path) * turn.transpose());
    const CharacterFeature writing = character_feature(drawn), read = as_read(writing, reading);
    const auto near = characters.nearest(writing, asked_for.code);
    if (near && near->distance < nearest.distance) nearest = *near;
    from_asked = std::min(from_asked, apart(writing, asked));
    if (read.size() > 0) from_asked_as_read = std::min(from_asked_as_read, apart(read, asked));
  }
  if (nearest.code == 0 || nearest.distance > judge_constants.named_distance) return std::nullopt;
  // A careless hand needs more evidence than a neat one.
  const double doubt = judge_constants.carelessness * nearest.distance / std::sqrt(static_cast<double>(paths.size()));
  // Along the line from one character to the other; `between` is its length.
  const auto is_clear = [&](double from_one, double between) {
    const double past_middle = (from_one * from_one - nearest.distance * nearest.distance) / (2.0 * between);
    return past_middle > judge_constants.beyond_middle * 0.5 * between + doubt;
  };
  const CharacterFeature other = characters.feature(nearest), other_as_read = as_read(other, reading);
  const double between = apart(asked, other);
  if (between < judge_constants.drawn_alike_distance || !is_clear(from_asked, between)) return std::nullopt;
  if (other_as_read.size() > 0 && !is_clear(from_asked_as_read, apart(asked, other_as_read))) return std::nullopt;
  return OtherCharacter{nearest.code, between < judge_constants.lookalike_distance};
}

}  // namespace calligraphy
