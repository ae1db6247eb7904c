#include "shape_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calligraphy {
namespace {

/// How much spread of a stroke it takes to believe that it is not in its own size and slant [em^2].
constexpr double prior = 0.002;

constexpr std::size_t quarter = ShapeNodes::count / 4;
constexpr std::size_t rows_a_step = 8;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A chord that is shorter has no direction [em].
constexpr double shortest_chord = 0.03;

Point direction(const Point& way) {
  const double length = way.norm();
  return length > 0.0 ? Point(way / length) : Point(Point::Zero());
}

}  // namespace

void ShapeFit::begin(const WrittenPath& written, const StrokeShape& stroke, const Point& misplaced) noexcept {
  written_ = &written;
  stroke_ = &stroke;
  misplaced_ = misplaced / stroke.em;
  round_ = 0;
}

bool ShapeFit::step() noexcept {
  if (is_done()) return true;
  if (round_ == 0) {
    read_path();
    round_ = 1;
    is_mapped_ = false;
  } else if (!is_mapped_) {
    map();
    is_mapped_ = true;
    row_ = 0;
  } else if (row_ < nodes) {
    add_rows();
  } else {
    pair_up();
    is_mapped_ = false;
    if (++round_ > rounds) measure();
  }
  return is_done();
}

void ShapeFit::read_path() noexcept {
  pen_ = nodes_on(*written_, stroke_->origin, stroke_->em);
  match_.extent = written_->chords() / stroke_->em / stroke_->chords;
  match_.roughness = roughness(written_->way() / stroke_->em, pen_) / stroke_->roughness;
  pairs_ = nodes;
  for (std::size_t i = 0; i < nodes; ++i) pen_paired_[i] = stroke_paired_[i] = static_cast<unsigned char>(i);
}

/// The affine map from the stroke's nodes to those of the pen that they are paired with.
void ShapeFit::map() noexcept {
  const ShapeNodes& stroke = stroke_->nodes;
  double px = 0.0, py = 0.0, sx = 0.0, sy = 0.0;
  double sxx = 0.0, sxy = 0.0, syy = 0.0, pxx = 0.0, pxy = 0.0, pyx = 0.0, pyy = 0.0;
  for (std::size_t k = 0; k < pairs_; ++k) {
    const std::size_t i = pen_paired_[k], j = stroke_paired_[k];
    const double x = pen_.x[i], y = pen_.y[i], u = stroke.x[j], v = stroke.y[j];
    px += x, py += y, sx += u, sy += v;
    sxx += u * u, sxy += u * v, syy += v * v;
    pxx += x * u, pxy += x * v, pyx += y * u, pyy += y * v;
  }
  const double share = 1.0 / static_cast<double>(pairs_);
  px *= share, py *= share, sx *= share, sy *= share;
  sxx = sxx * share - sx * sx + prior, sxy = sxy * share - sx * sy, syy = syy * share - sy * sy + prior;
  pxx = pxx * share - px * sx + prior, pxy = pxy * share - px * sy;
  pyx = pyx * share - py * sx, pyy = pyy * share - py * sy + prior;
  const double scale = 1.0 / (sxx * syy - sxy * sxy);
  const double a = (pxx * syy - pxy * sxy) * scale, b = (pxy * sxx - pxx * sxy) * scale;
  const double c = (pyx * syy - pyy * sxy) * scale, d = (pyy * sxx - pyx * sxy) * scale;
  turned_ = along_ = 0.0;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double u = stroke.x[i] - sx, v = stroke.y[i] - sy;
    const double x = a * u + b * v, y = c * u + d * v;
    mapped_.x[i] = px + x;
    mapped_.y[i] = py + y;
    along_ += u * x + v * y;
    turned_ += u * y - v * x;
  }
  match_.moved = (Point(px - sx, py - sy) - misplaced_).norm();
  const Point even(0.5 * (a + d), 0.5 * (c - b)), odd(0.5 * (a - d), 0.5 * (c + b));
  match_.narrowest = even.norm() - odd.norm();
}

/// A pair that follows in both paths counts twice, so that a shortcut costs as much as the way round.
void ShapeFit::add_rows() noexcept {
  for (std::size_t n = 0; n < rows_a_step; ++n, ++row_) {
    const std::size_t i = row_, first = i > band ? 0 : band - i, last = std::min(2 * band, nodes - 1 + band - i);
    auto& sums = sums_[i];
    sums.fill(infinite);
    std::array<double, 2 * band + 1> squares, above;
    for (std::size_t k = first; k <= last; ++k) {
      const std::size_t j = i + k - band;
      const double x = pen_.x[i] - mapped_.x[j], y = pen_.y[i] - mapped_.y[j];
      squares[k] = x * x + y * y;
      above[k] = infinite;
    }
    if (i == 0) {
      above[first] = 0.0;
    } else {
      const auto& before = sums_[i - 1];
      for (std::size_t k = first; k <= last; ++k) {
        const double diagonal = before[k + 1] + squares[k];
        above[k] = diagonal < before[k + 2] ? diagonal : before[k + 2];
      }
    }
    double left = infinite;
    for (std::size_t k = first; k <= last; ++k) {
      left = (above[k] < left ? above[k] : left) + squares[k];
      sums[k + 1] = left;
    }
  }
}

/// Goes back along the least sums.
void ShapeFit::pair_up() noexcept {
  pairs_ = later_pairs_ = 0;
  square_ = later_square_ = 0.0;
  std::size_t i = nodes - 1, j = nodes - 1;
  while (true) {
    pen_paired_[pairs_] = static_cast<unsigned char>(i);
    stroke_paired_[pairs_] = static_cast<unsigned char>(j);
    ++pairs_;
    const double x = pen_.x[i] - mapped_.x[j], y = pen_.y[i] - mapped_.y[j], square = x * x + y * y;
    square_ += square;
    if (i >= quarter) {
      later_square_ += square;
      ++later_pairs_;
    }
    if (i == 0 && j == 0) return;
    const std::size_t k = j + band + 1 - i;
    const double left = sums_[i][k - 1], above = i > 0 ? sums_[i - 1][k + 1] : infinite;
    const double diagonal = i > 0 ? sums_[i - 1][k] + square : infinite;
    const bool is_diagonal = i > 0 && j > 0 && diagonal <= above && diagonal <= left;
    const bool goes_up = is_diagonal || j == 0 || (i > 0 && above <= left);
    if (goes_up) --i;
    if (is_diagonal || !goes_up) --j;
  }
}

void ShapeFit::measure() noexcept {
  const ShapeNodes& stroke = stroke_->nodes;
  constexpr std::size_t last = nodes - 1;
  match_.misfit = std::sqrt(square_ / static_cast<double>(pairs_));
  match_.later_misfit = std::sqrt(later_square_ / static_cast<double>(later_pairs_));
  const double size = std::sqrt(turned_ * turned_ + along_ * along_);
  match_.turn = along_ > 0.0 ? std::abs(turned_) / size : 2.0;
  const Point start = pen_.at(0) - stroke.at(0) - misplaced_, end = pen_.at(last) - stroke.at(last) - misplaced_;
  match_.end = end.norm();
  match_.late = start.dot(direction(stroke.at(quarter) - stroke.at(0)));
  match_.early = -end.dot(direction(stroke.at(last) - stroke.at(last - quarter)));
  const Point chord = stroke.chord();
  match_.ahead = chord.norm() > shortest_chord ? pen_.chord().dot(chord) / chord.squaredNorm() : 1.0;
  match_.own_end = (pen_.chord() - chord).norm();
  match_.bulge = pen_.bulge();
}

}  // namespace calligraphy
