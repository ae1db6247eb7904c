// From a pen path to the typical stroke it is, by geometry alone; private to the model.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "brush.hpp"
#include "polyline.hpp"

namespace calligraphy::recognition {

/// What a path may be: a typical stroke and where its elements begin and end in the path.
struct Recognition {
  int id;
  std::vector<std::size_t> splits;  ///< indices into the path, elements + 1 of them, the ends included
  double cost;                      ///< [em]
};

/// The typical strokes that a refined path may be, the best first. `corners` are indices of path vertices where an
/// element may end, rising, the first and last vertex included. `clean` is what the path was made of. `ids` restricts
/// the choice, and restricts nothing when it is empty. Empty when no allowed stroke has so few elements.
std::vector<Recognition> recognise(const Path& path, std::span<const std::size_t> corners, const CleanPath& clean,
                                   bool brush, std::span<const int> ids);

}  // namespace calligraphy::recognition
