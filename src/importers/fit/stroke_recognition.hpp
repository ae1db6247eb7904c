// Recognition of a pen path as a typical stroke, by geometry alone; private to the importers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "brush.hpp"
#include "polyline.hpp"

namespace calligraphy::recognition {

/// A candidate for a path: a typical stroke and where its elements begin and end in the path.
struct Recognition {
  int id;
  std::vector<std::size_t> splits;  ///< elements + 1 indices into the path, including its ends
  double cost;                      ///< [em]
};

/// Candidate typical strokes for a refined path, the best first. `corners` are ascending indices of path vertices where
/// an element may end, including the first and last vertex. `clean` is the path before refinement. There is at least
/// one candidate, of one element.
std::vector<Recognition> recognise(const Path& path, std::span<const std::size_t> corners, const CleanPath& clean,
                                   bool brush);

}  // namespace calligraphy::recognition
