// The appearance of a whole character, stroke by stroke, for telling one from another.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <calligraphy/model/character_set.hpp>

#include "judge/pens/resemblance.hpp"

namespace calligraphy {

/// Number of points of each stroke in a feature.
inline constexpr Eigen::Index points_in_stroke = 8;

/// A column with the x and y of these points of each stroke, in order: about the centre of the whole writing, and with
/// the same standard deviation along both axes unless the writing is a line.
using CharacterFeature = Eigen::VectorXf;

/// The feature of the outlines of pen-downs, or of a character.
CharacterFeature character_feature(std::span<const Outline> strokes);
CharacterFeature character_feature(const Character& character);

/// RMS distance between the points of two characters with the same number of strokes [em].
double apart(const Eigen::Ref<const CharacterFeature>& one, const Eigen::Ref<const CharacterFeature>& other);

/// The features of the characters of a set, in all their forms.
class CharacterFeatures {
 public:
  explicit CharacterFeatures(const CharacterSet& set);

  /// One of the characters, and how far it is from a given feature.
  struct Neighbour {
    char32_t code = 0;
    double distance = std::numeric_limits<double>::infinity();  ///< [em]
    std::size_t strokes = 0, index = 0;                         ///< where its feature is stored
  };

  std::size_t size() const { return size_; }
  /// Every character with as many strokes, not sorted.
  std::vector<Neighbour> neighbours(const CharacterFeature& feature) const;
  /// The nearest one with as many strokes that is not `except`.
  std::optional<Neighbour> nearest(const CharacterFeature& feature, char32_t except) const;
  CharacterFeature feature(const Neighbour& neighbour) const;

 private:
  /// Characters with the same number of strokes.
  struct Group {
    std::vector<char32_t> codes;
    Eigen::MatrixXf features;  ///< a column each
  };

  std::vector<Group> groups_;  ///< by the number of strokes
  std::size_t size_ = 0;
};

}  // namespace calligraphy
