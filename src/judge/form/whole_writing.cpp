#include "whole_writing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "judge/judge_constants.hpp"
#include "judge/pens/resemblance.hpp"
#include "judge/reading/assignment.hpp"
#include "laid_writing.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr double flat_box = 0.25;  // side of a box, over the longer, below which it is not stretched [1]
constexpr std::size_t orientations = 8;
constexpr double shortest_way = 0.2, opposite = -0.7;  // between parts [em], and cosine of ways in each other's place
constexpr double apart_share = -0.05, least_rest = 0.5;  // of two characters, over the size of the first [1]

/// How to lay writing upright, by its orientation.
const std::array<Eigen::Matrix2d, orientations>& upright_maps() {
  static const std::array<Eigen::Matrix2d, orientations> maps = [] {
    std::array<Eigen::Matrix2d, orientations> all;
    all[0] << 1.0, 0.0, 0.0, 1.0;
    all[1] << -1.0, 0.0, 0.0, 1.0;   // mirrored
    all[2] << 1.0, 0.0, 0.0, -1.0;   // upside down
    all[3] << -1.0, 0.0, 0.0, -1.0;  // half turned
    all[4] << 0.0, 1.0, -1.0, 0.0;   // turned left
    all[5] << 0.0, -1.0, 1.0, 0.0;   // turned right
    all[6] << 0.0, -1.0, -1.0, 0.0;  // mirrored, then turned left
    all[7] << 0.0, 1.0, 1.0, 0.0;    // mirrored, then turned right
    return all;
  }();
  return maps;
}

/// The outlines of lines in a box of side 1 about 0.
std::vector<Outline> boxed(std::span<const FormLine> lines) {
  const Eigen::AlignedBox2d box = box_of_lines(lines);
  const double longest = std::max(box.sizes().maxCoeff(), 1e-6);
  const Point sides = box.sizes().cwiseMax(Point::Constant(flat_box * longest)), centre = box.center();
  std::vector<Outline> outlines;
  for (const FormLine& line : lines) {
    Outline& placed = outlines.emplace_back();
    for (Eigen::Index k = 0; k < placed.rows(); ++k) {
      const Point point = (line.points[static_cast<std::size_t>(2 * k + 1)] - centre).cwiseQuotient(sides);
      placed.row(k) = point.transpose();
    }
  }
  return outlines;
}

double mean_residual(std::span<const Outline> written, std::span<const Outline> wanted, const Eigen::Matrix2d& map) {
  double sum = 0.0;
  for (std::size_t i = 0; i < written.size(); ++i) sum += mean_distance(written[i] * map.transpose(), wanted[i]);
  return sum / static_cast<double>(written.size());
}

/// The least mean residual in any order and direction.
double free_residual(std::span<const Outline> written, std::span<const Outline> wanted) {
  std::vector<std::vector<double>> costs(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Outline backwards = reversed(wanted[i]);
    for (const Outline& path : written) {
      costs[i].push_back(std::min(mean_distance(path, wanted[i]), mean_distance(path, backwards)));
    }
  }
  constexpr double never = 1e6;
  const auto owners = assign(costs, written.size(), never);
  double sum = 0.0;
  for (std::size_t i = 0; i < owners.size(); ++i) sum += costs[i][owners[i].value_or(0)];
  return sum / static_cast<double>(wanted.size());
}

std::optional<WholeFault> orientation_of(std::span<const FormLine> strokes, std::span<const FormLine> written) {
  const std::vector<Outline> wanted = boxed(strokes), drawn = boxed(written);
  std::array<double, orientations> residuals;
  for (std::size_t i = 0; i < orientations; ++i) residuals[i] = mean_residual(drawn, wanted, upright_maps()[i]);
  const auto best = static_cast<std::size_t>(std::min_element(residuals.begin(), residuals.end()) - residuals.begin());
  if (best == 0 || residuals[best] >= judge_constants.max_turned_residual) return std::nullopt;
  const double least = std::max(residuals[best], 1e-6);
  if (residuals[0] <= std::max(judge_constants.min_upright_residual, judge_constants.upright_factor * least)) {
    return std::nullopt;
  }
  // What strokes in another order or direction explain as well is told as that.
  const double clearly = std::max(judge_constants.free_factor * least, least + judge_constants.free_margin);
  if (free_residual(drawn, wanted) <= clearly) return std::nullopt;
  return WholeFault{StrokeRemarkKind::orientation, static_cast<WritingOrientation>(best)};
}

/// Two parts, each well written, in each other's place.
std::optional<WholeFault> exchanged_parts(std::span<const FormLine> strokes, std::span<const FormLine> written) {
  const std::size_t n = strokes.size();
  if (n < 4) return std::nullopt;
  const double drawn_size = box_of_lines(written).sizes().maxCoeff();
  const double size = drawn_size / std::max(box_of_lines(strokes).sizes().maxCoeff(), 1e-6);
  double least = std::numeric_limits<double>::infinity();
  std::size_t first_part = 0;
  for (std::size_t cut = 2; cut + 1 < n; ++cut) {
    const Point wanted = box_of_lines(strokes.subspan(cut)).center() - box_of_lines(strokes.first(cut)).center();
    const Point drawn = box_of_lines(written.subspan(cut)).center() - box_of_lines(written.first(cut)).center();
    if (std::min(wanted.norm(), drawn.norm() / std::max(size, 1e-6)) < shortest_way) continue;
    if (wanted.dot(drawn) > opposite * wanted.norm() * drawn.norm()) continue;
    const LaidWriting one = lay_on(strokes.first(cut), written.first(cut));
    const LaidWriting other = lay_on(strokes.subspan(cut), written.subspan(cut));
    const double residual = (one.mean_residual() * static_cast<double>(cut) +
                             other.mean_residual() * static_cast<double>(n - cut)) / static_cast<double>(n);
    if (residual >= least) continue;
    least = residual;
    first_part = cut;
  }
  if (least > judge_constants.max_part_residual) return std::nullopt;
  if (lay_on(strokes, written).mean_residual() < judge_constants.part_factor * least) return std::nullopt;
  return WholeFault{StrokeRemarkKind::parts, WritingOrientation::upright, first_part};
}

/// The character asked for, first or last, and beside it something of about the same size.
std::optional<WholeFault> several_characters(std::span<const FormLine> strokes, std::span<const FormLine> written) {
  const std::size_t n = strokes.size();
  if (n < 2 || written.size() <= n + 1) return std::nullopt;
  const std::vector<Outline> wanted = boxed(strokes);
  for (const std::size_t first : {std::size_t{0}, written.size() - n}) {
    const std::span<const FormLine> mine = written.subspan(first, n);
    const std::span<const FormLine> rest = first == 0 ? written.subspan(n) : written.first(first);
    const Eigen::AlignedBox2d box = box_of_lines(mine), other = box_of_lines(rest);
    const double size = box.sizes().maxCoeff();
    const double apart = std::max((other.min() - box.max()).maxCoeff(), (box.min() - other.max()).maxCoeff());
    if (apart <= apart_share * size || other.sizes().maxCoeff() <= least_rest * size) continue;
    const double residual = mean_residual(boxed(mine), wanted, upright_maps()[0]);
    if (residual < judge_constants.max_one_of_several) return WholeFault{StrokeRemarkKind::several};
  }
  return std::nullopt;
}

}  // namespace

std::optional<WholeFault> whole_fault(const CharacterForm& form, std::span<const PenPath> paths) {
  std::vector<FormLine> written;
  for (const PenPath& path : paths) written.push_back(form_line(path));
  if (written.size() != form.count()) return several_characters(form.strokes, written);
  if (written.size() < 2) return std::nullopt;  // a line that is turned is another line
  const auto orientation = orientation_of(form.strokes, written);
  return orientation ? orientation : exchanged_parts(form.strokes, written);
}

}  // namespace calligraphy
