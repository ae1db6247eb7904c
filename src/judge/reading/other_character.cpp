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
  struct Distances {
    double other = std::numeric_limits<double>::infinity(), asked = other, asked_as_read = other;
    void lower_to(const Distances& to) {
      other = std::min(other, to.other);
      asked = std::min(asked, to.asked);
      asked_as_read = std::min(asked_as_read, to.asked_as_read);
    }
  };
  CharacterFeatures::Neighbour nearest;
  Distances least, as_it_is;
  // Both turned upright as in the reading and as it is: the reading of another character may turn it wrongly.
  const Eigen::Matrix2d not_turned = Eigen::Matrix2d::Identity();
  for (const Eigen::Matrix2d& turn : {rotation_of(reading.costs->fit().linear), not_turned}) {
    std::vector<Outline> drawn;
    for (const PenPath& path : paths) drawn.push_back(outline(path) * turn.transpose());
    const CharacterFeature writing = character_feature(drawn), read = as_read(writing, reading);
    const auto near = characters.nearest(writing, asked_for.code);
    if (!near) return std::nullopt;
    as_it_is = {near->distance, apart(writing, asked), read.size() > 0 ? apart(read, asked) : least.asked_as_read};
    if (near->distance < least.other) nearest = *near;
    least.lower_to(as_it_is);
  }
  if (least.other > judge_constants.named_distance) return std::nullopt;
  // A careless hand needs more evidence than a neat one.
  const double doubt = judge_constants.carelessness * least.other / std::sqrt(static_cast<double>(paths.size()));
  // Along the line from one character to the other; `between` is its length.
  const auto is_clear = [&](double from_asked, double from_asked_as_it_is, double between) {
    if (between < judge_constants.lookalike_distance) {
      return as_it_is.other < judge_constants.twin_share * from_asked_as_it_is;
    }
    const bool is_stranger = between >= judge_constants.twin_distance;
    if (is_stranger && least.other > judge_constants.stranger_share * from_asked) return false;
    const double past_middle = (from_asked * from_asked - least.other * least.other) / (2.0 * between);
    return past_middle > judge_constants.beyond_middle * 0.5 * between + doubt;
  };
  const CharacterFeature other = characters.feature(nearest), other_as_read = as_read(other, reading);
  const double between = apart(asked, other);
  if (between < judge_constants.drawn_alike_distance || as_it_is.other >= as_it_is.asked) return std::nullopt;
  OtherCharacter found{nearest.code, is_clear(least.asked, as_it_is.asked, between),
                       between < judge_constants.twin_distance, between < judge_constants.lookalike_distance};
  if (other_as_read.size() > 0 && !is_clear(least.asked_as_read, as_it_is.asked_as_read, apart(asked, other_as_read))) {
    found.is_clear = false;
  }
  return found;
}

}  // namespace calligraphy
