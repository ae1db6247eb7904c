#include "writing_fit.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "judge/judge_constants.hpp"

namespace calligraphy {

using detail::judge_constants;

std::optional<AffineMap> fit_writing(const StrokeReading& reading, const StrokeOutlines& strokes,
                                     std::span<const DrawnLine> drawn, const AffineMap& start) {
  std::vector<std::pair<Outline, Outline>> pairs;
  Point from = Point::Zero(), to = Point::Zero();
  for (const ReadingStep& step : reading.steps) {
    if (step.paths != 1 || step.strokes == 0 || reading.costs->is_tap(step.path)) continue;
    if (step.cost > judge_constants.max_fitted_cost) continue;
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
  const double spread = points * judge_constants.fit_pull / std::abs(start.linear.determinant());
  const Eigen::Matrix2d linear =
      (product + spread * start.linear) * (square + spread * Eigen::Matrix2d::Identity()).inverse();
  const Eigen::Matrix2d change = linear * start.linear.inverse();
  const double size = change.determinant();
  const double max_size = judge_constants.max_fit_scale * judge_constants.max_fit_scale;
  if (!(size > 1.0 / max_size && size < max_size)) return std::nullopt;
  const Eigen::Matrix2d slant = change / std::sqrt(size) - Eigen::Matrix2d::Identity();
  if (slant.jacobiSvd().singularValues()[0] > judge_constants.max_fit_slant) return std::nullopt;
  return AffineMap{linear, to - linear * from};
}

}  // namespace calligraphy
