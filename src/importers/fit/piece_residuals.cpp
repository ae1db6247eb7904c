#include "piece_residuals.hpp"

#include <algorithm>
#include <cmath>

namespace calligraphy::recognition {

PieceResiduals::PieceResiduals(std::span<const Point> path)
    : count_(static_cast<double>(path.size())), before_(path.size() + 1) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double position = static_cast<double>(i) / count_;  // 0 to 1, so that high powers do not dominate
    Moments sums = before_[i];
    double power = 1.0;
    for (Point& sum : sums.of_power) {
      sum += power * path[i];
      power *= position;
    }
    sums.squared += path[i].squaredNorm();
    before_[i + 1] = sums;
  }
}

double PieceResiduals::residual(std::size_t first, std::size_t last, int degree) const {
  const Moments& from = before_[first];
  const Moments& to = before_[last + 1];
  Point sums[4];
  for (int k = 0; k < 4; ++k) sums[k] = to.of_power[k] - from.of_power[k];

  // The same sums for positions v from -1 at the first point to 1 at the last.
  const double n = static_cast<double>(last - first + 1);
  const double centre = 0.5 * static_cast<double>(first + last) / count_;
  const double half = std::max(0.5, 0.5 * static_cast<double>(last - first)) / count_;
  const Point m0 = sums[0];
  const Point m1 = (sums[1] - centre * sums[0]) / half;

  // The discrete orthogonal (Gram) polynomials on n equal steps: 1, v, v^2 - v2 / n, v^3 - (v4 / v2) v, where vk is the
  // sum of v^k. Each reduces what is left.
  double left = to.squared - from.squared - m0.squaredNorm() / n;
  if (n < 2.0) return std::max(0.0, left);
  const double v2 = n * (n + 1.0) / (3.0 * (n - 1.0));
  left -= m1.squaredNorm() / v2;
  if (degree == 1 || n < 5.0) return std::max(0.0, left);
  const double c = centre;
  const Point m2 = (sums[2] - 2.0 * c * sums[1] + c * c * sums[0]) / (half * half);
  const Point m3 = (sums[3] - 3.0 * c * sums[2] + 3.0 * c * c * sums[1] - c * c * c * sums[0]) / (half * half * half);
  const double v4 = v2 * (3.0 * n * n - 7.0) / (5.0 * (n - 1.0) * (n - 1.0));
  const double v6 = v2 * (3.0 * n * n * n * n - 18.0 * n * n + 31.0) / (7.0 * std::pow(n - 1.0, 4));
  left -= (m2 - v2 / n * m0).squaredNorm() / (v4 - v2 * v2 / n);
  left -= (m3 - v4 / v2 * m1).squaredNorm() / (v6 - v4 * v4 / v2);
  return std::max(0.0, left);
}

}  // namespace calligraphy::recognition
