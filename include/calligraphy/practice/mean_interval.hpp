// A mean with a confidence interval that counts as independent only what was drawn independently.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace calligraphy {

/// A value and the draw on which it depends: for example, how much force reduced the error of a character in one pair
/// of runs.
struct DrawnValue {
  double value = 0.0;      ///< in any unit
  std::uint64_t draw = 0;  ///< number of the draw, shared by the values of one run (page and seed)
};

/// A mean with its 95 % confidence interval, both in the unit of the values.
struct MeanInterval {
  double mean = 0.0;        ///< mean of the values; NaN if there are none
  double half_width = 0.0;  ///< half the width of the interval; NaN with fewer than two draws
  std::size_t values = 0;   ///< number of values, excluding missing ones
  std::size_t draws = 0;    ///< number of independent draws among them
  std::size_t missing = 0;  ///< number of values left out because they are NaN: not measured
};

/// Mean of values that are clustered by draw. With S_g the sum of a cluster's deviations from the mean of all n values,
/// the standard error is sqrt(G / (G - 1) sum S_g^2) / n, which for clusters of equal size is that of the mean of the G
/// cluster means (Liang and Zeger 1986, for a mean). The interval uses Student's t with G - 1 degrees of freedom.
MeanInterval mean_interval(std::span<const DrawnValue> values);

/// The value that Student's t with these degrees of freedom exceeds with a probability of 2.5 %, half of what remains
/// outside a 95 % interval; NaN for 0.
double student_t(std::size_t degrees_of_freedom);

}  // namespace calligraphy
