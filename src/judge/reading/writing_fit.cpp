#include "writing_fit.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SVD>

namespace calligraphy {
namespace {

constexpr double pull = 0.01;      // to the start, as a variance of every point [em^2]
constexpr double max_cost = 0.2;   // of a pair that counts [em]
constexpr double max_slant = 0.6;  // distance from the start without its size: 33 degrees of rotation or of shear
constexpr double max_scale = 1.8;  // against the start, either way

}  // namespace

std::optional<AffineMap> fit_writing(const StrokeReading& reading, const StrokeOutlines& strokes,
                                     std::span<const DrawnLine> drawn, const AffineMap& start) {
  std::vector<std::pair<Outline, Outline>> pairs;
  Point from = Point::Zero(), to = Point::Zero();
  for (const ReadingStep& step : reading.steps) {
    if (step.paths != 1 || step.strokes == 0 || step.cost > max_cost || reading.costs->is_tap(step.path)) continue;
    Outline wanted = strokes.run(step.stroke, step.strokes).line;
    if (reading.pair(step).backwards) wanted = reversed(wanted);
    pairs.emplace_back(drawn[step.path].line, wanted);
    from += pairs.back().first.colwise().mean().transpose();
    to += wanted.colwise().mean().transpose();
  }
  if (pairs.empty()) return std::nullopt;
  const auto count = static_cast<double>(pairs.size());
  from /= count;
  to /= count;
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero(), product = Eigen::Matrix2d::Zero();
  for (const auto& [line, wanted] : pairs) {
    const Outline p = line.rowwise() - from.transpose(), q = wanted.rowwise() - to.transpose();
    square += p.transpose() * p;
    product += q.transpose() * p;
  }
  const double points = count * static_cast<double>(Outline::RowsAtCompileTime);
  const double spread = points * pull / std::abs(start.linear.determinant());
  const Eigen::Matrix2d linear =
      (product + spread * start.linear) * (square + spread * Eigen::Matrix2d::Identity()).inverse();
  const Eigen::Matrix2d change = linear * start.linear.inverse();
  const double size = change.determinant();
  if (!(size > 1.0 / (max_scale * max_scale) && size < max_scale * max_scale)) return std::nullopt;
  const Eigen::Matrix2d slant = change / std::sqrt(size) - Eigen::Matrix2d::Identity();
  if (slant.jacobiSvd().singularValues()[0] > max_slant) return std::nullopt;
  return AffineMap{linear, to - linear * from};
}

}  // namespace calligraphy
