// Where the elements of a typical stroke begin and end in a path; private to the importers.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include <calligraphy/model/typical_stroke.hpp>

#include "piece_residuals.hpp"
#include "polyline.hpp"

namespace calligraphy::recognition {

struct Division {
  double cost = std::numeric_limits<double>::infinity();  ///< [em^2]
  std::vector<std::size_t> ends;  ///< first point of each element, then the last point; empty if there are too few
};

/// Divides one path among the elements of several typical strokes. The cost is the mean square of the residuals of
/// each element from a line or cubic of constant speed, and of its deviations from the directions of the typical
/// stroke.
class StrokeDivider {
 public:
  /// @param path evenly spaced points, which must outlive the divider
  explicit StrokeDivider(const Path& path);

  /// The division of least cost, by dynamic programming over at most 95 places for the joints.
  /// @param elements a composition of strokes of this type
  Division divide(const TypicalStroke& type, std::string_view elements);

 private:
  double residual(std::size_t from, std::size_t to, char kind);

  const Path& path_;
  PieceResiduals pieces_;
  std::vector<std::size_t> places_;   ///< points where an element may begin and end
  std::vector<double> residuals_;     ///< of pieces between places, as line and as curve; negative if not yet known
};

}  // namespace calligraphy::recognition
