// A person's strokes, laid on those of the character so that what is wrong with one of them does not displace the rest.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>

#include "form_line.hpp"

namespace calligraphy {

/// Strokes laid on those of a character.
struct LaidWriting {
  std::vector<FormLine> lines;
  std::vector<double> residuals;  ///< mean distance of each from the character's stroke [em]
  AffineMap map;                  ///< from where they were written

  double mean_residual() const;
  double median_residual() const;
};

/// The median of at least one value.
double median_of(std::vector<double> values);

/// Lays strokes on as many of a character by an affine map: weighted least squares, in which a stroke that is far off
/// counts little (iterated, Huber's weights squared), drawn towards the map from box to box. It turns by at most 30
/// degrees and stretches one axis against the other by at most 1.5, and few strokes less: a single one hardly. Each pair
/// is in the same direction. There must be at least one pair.
LaidWriting lay_on(std::span<const FormLine> strokes, std::span<const FormLine> written);

}  // namespace calligraphy
