#include "laid_writing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "judge/judge_constants.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr int rounds = 6;
constexpr double least_side = 1e-6;       // [em]
// Greatest stretch of a single stroke, and how much more with each other: a lone arch must not be flattened into a
// straight stroke, nor a stroke that is out of place among a few be excused by them.
constexpr double least_stretch = 1.01, stretch_by_stroke = 0.05;

/// The nearest map that turns and stretches within the limits; none for a reflection.
std::optional<Eigen::Matrix2d> limited(const Eigen::Matrix2d& linear, double max_stretch) {
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix2d turn = svd.matrixU() * svd.matrixV().transpose();
  if (turn.determinant() < 0.0) return std::nullopt;
  Eigen::Vector2d scales = svd.singularValues();
  const double mean = scales[1] * max_stretch * max_stretch > scales[0]
                          ? std::sqrt(std::max(scales[0] * scales[1], 1e-12))
                          : scales[0] / std::sqrt(max_stretch);
  const double limit = std::sqrt(max_stretch);
  for (double& scale : scales) scale = std::clamp(scale, mean / limit, mean * limit);
  const double angle = std::atan2(turn(1, 0), turn(0, 0));
  const double change = std::clamp(angle, -judge_constants.max_form_turn, judge_constants.max_form_turn) - angle;
  return Eigen::Rotation2Dd(change) * svd.matrixU() * scales.asDiagonal() * svd.matrixV().transpose();
}

double mean_distance_between(const FormLine& one, const FormLine& other) {
  double sum = 0.0;
  for (std::size_t k = 0; k < form_points; ++k) sum += (one.points[k] - other.points[k]).norm();
  return sum / static_cast<double>(form_points);
}

}  // namespace

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double LaidWriting::mean_residual() const {
  return std::accumulate(residuals.begin(), residuals.end(), 0.0) / static_cast<double>(residuals.size());
}

double LaidWriting::median_residual() const { return median_of(residuals); }

LaidWriting lay_on(std::span<const FormLine> strokes, std::span<const FormLine> written) {
  const double max_stretch = std::min(judge_constants.max_box_stretch,
                                      least_stretch + stretch_by_stroke * static_cast<double>(strokes.size() - 1));
  const Point to_box = box_of_lines(strokes).sizes(), from_box = box_of_lines(written).sizes();
  const double scale = std::max(to_box.maxCoeff(), least_side) / std::max(from_box.maxCoeff(), least_side);
  const Point scales = to_box.cwiseQuotient(from_box.cwiseMax(Point::Constant(least_side)));
  const Eigen::Matrix2d start = scales.cwiseMax(Point::Constant(scale / max_stretch))
                                    .cwiseMin(Point::Constant(scale * max_stretch))
                                    .asDiagonal();
  const double pull = judge_constants.fit_pull / (scale * scale);
  std::vector<double> weights(strokes.size(), 1.0);
  LaidWriting laid{{written.begin(), written.end()}, std::vector<double>(strokes.size()), {}};
  for (int round = 0; round < rounds; ++round) {
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    Point from = Point::Zero(), to = Point::Zero();
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      from += weights[i] / all * written[i].centre();
      to += weights[i] / all * strokes[i].centre();
    }
    Eigen::Matrix2d square = Eigen::Matrix2d::Zero(), product = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      const double weight = weights[i] / (all * static_cast<double>(form_points));
      for (std::size_t k = 0; k < form_points; ++k) {
        const Point p = written[i].points[k] - from, q = strokes[i].points[k] - to;
        square += weight * p * p.transpose();
        product += weight * q * p.transpose();
      }
    }
    const Eigen::Matrix2d least_squares =
        (product + pull * start) * (square + pull * Eigen::Matrix2d::Identity()).inverse();
    const Eigen::Matrix2d linear = limited(least_squares, max_stretch).value_or(start);
    laid.map = {linear, to - linear * from};
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      std::array<Point, form_points> points = written[i].points;
      for (Point& point : points) point = laid.map(point);
      laid.lines[i].points = points;
      laid.residuals[i] = mean_distance_between(laid.lines[i], strokes[i]);
    }
    const double close = std::max(1.5 * laid.median_residual(), 0.03);
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      const double share = std::min(1.0, close / std::max(laid.residuals[i], 1e-9));
      weights[i] = share * share;
    }
  }
  for (FormLine& line : laid.lines) line = form_line(line.points);
  return laid;
}

}  // namespace calligraphy
