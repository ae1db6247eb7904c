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

/// The division of a path among elements, by dynamic programming over the `places` where one may end, the first and
/// the last of them included: the least cost, infinite if there are too few places, and the place where each element
/// begins and the last one ends. `cost(element, from, to, before, best)` adds to `before` the cost of an element from
/// one place to another; it may stop adding once it has reached `best`.
template <typename Cost>
double divide_at_least_cost(std::size_t elements, std::size_t places, std::vector<std::size_t>& ends, Cost cost) {
  constexpr double unreached = std::numeric_limits<double>::infinity();
  if (places <= elements) return unreached;
  std::vector<double> least((elements + 1) * places, unreached);
  std::vector<std::size_t> previous(least.size(), 0);
  least[0] = 0.0;
  for (std::size_t element = 0; element < elements; ++element) {
    for (std::size_t from = element; from + 1 < places; ++from) {
      const double before = least[element * places + from];
      if (before == unreached) continue;
      for (std::size_t to = element + 1 == elements ? places - 1 : from + 1; to < places; ++to) {
        double& best = least[(element + 1) * places + to];
        const double total = cost(element, from, to, before, best);
        if (total >= best) continue;
        best = total;
        previous[(element + 1) * places + to] = from;
      }
    }
  }
  ends.assign(elements + 1, places - 1);
  for (std::size_t element = elements; element > 0; --element) {
    ends[element - 1] = previous[element * places + ends[element]];
  }
  return least.back();
}

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
