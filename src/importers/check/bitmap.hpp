// A black-and-white picture of the em square and its margin, to compare shapes by area; private to the importers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/point.hpp>

#include "importers/fit/outline.hpp"

namespace calligraphy::recognition {

/// From -0.25 to 1.25 em in both directions; a pixel is black if its centre is inside. Anything beyond is ignored.
class Bitmap {
 public:
  explicit Bitmap(int pixels_per_em);

  void clear();
  void fill(const Outline& outline);
  void fill(const InkDisc& disc);
  /// Adds the black pixels of `other`, which has the same resolution.
  void add(const Bitmap& other);
  /// Number of black pixels.
  std::int64_t area() const;

  /// Area of the intersection divided by area of the union; 0 if both are white.
  friend double intersection_over_union(const Bitmap& a, const Bitmap& b);

 private:
  int row_of(double y) const;
  void fill_span(int row, double from, double to);

  int pixels_per_em_;
  int rows_;
  int words_;  ///< per row
  int first_row_, last_row_;  ///< that are not all white; none if `last_row_ < first_row_`
  std::vector<std::uint64_t> bits_;
};

double intersection_over_union(const Bitmap& a, const Bitmap& b);

}  // namespace calligraphy::recognition
