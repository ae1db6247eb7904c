#include "character_features.hpp"

#include <algorithm>
#include <cmath>

#include "judge/judge_constants.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr Eigen::Index values_per_stroke = 2 * points_in_stroke;
constexpr Eigen::Index pieces_per_point = Outline::RowsAtCompileTime / points_in_stroke;

/// Whether people write it: not a part of a character, nor another code for one.
bool is_written(char32_t code) {
  const bool is_radical = code >= 0x2E80 && code < 0x2FE0, is_stroke = code >= 0x31C0 && code < 0x31F0;
  const bool is_component = code >= 0x9FA6 && code < 0x9FBC;  // of GB 18030
  const bool is_compatible = (code >= 0xF900 && code < 0xFB00) || (code >= 0x2F800 && code < 0x2FA20);
  return !is_radical && !is_stroke && !is_component && !is_compatible;
}

}  // namespace

CharacterFeature character_feature(std::span<const Outline> strokes) {
  Eigen::MatrixX2d points(points_in_stroke * static_cast<Eigen::Index>(strokes.size()), 2);
  Eigen::Index row = 0;
  for (const Outline& stroke : strokes) {
    for (Eigen::Index k = 0; k < points_in_stroke; ++k, ++row) {
      points.row(row) = stroke.middleRows<pieces_per_point>(k * pieces_per_point).colwise().mean();
    }
  }
  if (row == 0) return {};
  points.rowwise() -= points.colwise().mean().eval();
  const Point deviation = (points.colwise().squaredNorm() / static_cast<double>(row)).cwiseSqrt().transpose();
  // The slope of a lone line is all that can be seen of it.
  const double share = strokes.size() == 1 ? 1.0 : judge_constants.min_deviation_share;
  const double least = std::max(share * deviation.maxCoeff(), 1e-9);
  const double wanted = judge_constants.feature_deviation;
  for (const int axis : {0, 1}) points.col(axis) *= wanted / std::max(deviation[axis], least);
  return points.reshaped<Eigen::RowMajor>().cast<float>();
}

CharacterFeature character_feature(const Character& character) {
  std::vector<Outline> outlines;
  for (const std::vector<Point>& line : middle_lines(character)) outlines.push_back(outline(line));
  return character_feature(outlines);
}

double apart(const Eigen::Ref<const CharacterFeature>& one, const Eigen::Ref<const CharacterFeature>& other) {
  return static_cast<double>((one - other).norm()) / std::sqrt(static_cast<double>(one.size()) / 2.0);
}

CharacterFeatures::CharacterFeatures(const CharacterSet& set) {
  std::vector<std::vector<CharacterFeature>> features;
  for (std::optional<char32_t> code = set.next(0); code; code = set.next(*code + 1)) {
    if (!is_written(*code)) continue;
    ++size_;
    for (const StoredCharacter& form : set.forms(*code)) {
      const Character character = form.character();
      const auto count = static_cast<std::size_t>(character.stroke_count());
      groups_.resize(std::max(groups_.size(), count + 1));
      features.resize(groups_.size());
      groups_[count].codes.push_back(*code);
      features[count].push_back(character_feature(character));
    }
  }
  for (std::size_t count = 0; count < groups_.size(); ++count) {
    Eigen::MatrixXf& columns = groups_[count].features;
    columns.resize(values_per_stroke * static_cast<Eigen::Index>(count),
                   static_cast<Eigen::Index>(features[count].size()));
    for (std::size_t i = 0; i < features[count].size(); ++i) {
      columns.col(static_cast<Eigen::Index>(i)) = features[count][i];
    }
  }
}

std::vector<CharacterFeatures::Neighbour> CharacterFeatures::neighbours(const CharacterFeature& feature) const {
  std::vector<Neighbour> found;
  const auto strokes = static_cast<std::size_t>(feature.size() / values_per_stroke);
  if (strokes >= groups_.size()) return found;
  const Group& group = groups_[strokes];
  for (std::size_t i = 0; i < group.codes.size(); ++i) {
    const double distance = apart(group.features.col(static_cast<Eigen::Index>(i)), feature);
    found.push_back({group.codes[i], distance, strokes, i});
  }
  return found;
}

std::optional<CharacterFeatures::Neighbour> CharacterFeatures::nearest(const CharacterFeature& feature,
                                                                       char32_t except) const {
  Neighbour nearest;
  for (const Neighbour& each : neighbours(feature)) {
    if (each.code != except && each.distance < nearest.distance) nearest = each;
  }
  return nearest.code != 0 ? std::optional(nearest) : std::nullopt;
}

CharacterFeature CharacterFeatures::feature(const Neighbour& neighbour) const {
  return groups_[neighbour.strokes].features.col(static_cast<Eigen::Index>(neighbour.index));
}

}  // namespace calligraphy
