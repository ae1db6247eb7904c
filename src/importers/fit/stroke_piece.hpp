// Pieces of a path as candidates for the elements of a stroke; private to the importers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// Measured features of a piece of a path.
struct Piece {
  double length = 0.0;          ///< of the chord [em]
  double direction = 0.0;       ///< of the chord [degree]
  double leaving = 0.0;         ///< direction of the first third [degree]
  double arriving = 0.0;        ///< direction of the last third [degree]
  double bulge = 0.0;           ///< mean offset from the chord, divided by its length, left positive [1]
  double line_direction = 0.0;  ///< of the best line, without corners [degree]
  double line_error = 0.0;      ///< maximum distance from the best line [em]
  double cubic_error = 0.0;     ///< maximum distance from the best cubic [em]
  double sharpest = 0.0;        ///< maximum turn inside, within 6 % of the em [degree]
};

/// Mean offset of a path from its chord, divided by the given chord length, left of travel positive [1].
double bulge_of(std::span<const Point> points, double chord);

/// Pieces between all pairs of corners, given as ascending indices into the path that include its first and last
/// vertex.
class PieceTable {
 public:
  PieceTable(const Path& path, std::span<const std::size_t> corners);

  std::size_t count() const { return count_; }
  const Piece& between(std::size_t from, std::size_t to) const { return pieces_[from * count_ + to]; }
  const Piece& whole() const { return between(0, count_ - 1); }

 private:
  std::size_t count_;
  std::vector<Piece> pieces_;
};

}  // namespace calligraphy::recognition
