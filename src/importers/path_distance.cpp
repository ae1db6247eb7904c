#include "path_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace calligraphy::recognition {
namespace {

/// The segments of a polyline, stored by component so that loops over them vectorise.
class Segments {
 public:
  explicit Segments(std::span<const Point> path) {
    const std::size_t count = std::max<std::size_t>(1, path.size() - 1);
    for (std::size_t i = 0; i < count; ++i) {
      const Point along = path[std::min(i + 1, path.size() - 1)] - path[i];
      const double squared = along.squaredNorm();
      x_.push_back(path[i].x());
      y_.push_back(path[i].y());
      dx_.push_back(along.x());
      dy_.push_back(along.y());
      inverse_.push_back(squared > 0.0 ? 1.0 / squared : 0.0);
    }
  }

  std::size_t count() const { return x_.size(); }

  /// Squared distance of a point to each segment.
  void measure(const Point& point, std::span<double> squared) const {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double px = point.x() - x_[i];
      const double py = point.y() - y_[i];
      const double t = std::min(1.0, std::max(0.0, (px * dx_[i] + py * dy_[i]) * inverse_[i]));
      const double rx = px - t * dx_[i];
      const double ry = py - t * dy_[i];
      squared[i] = rx * rx + ry * ry;
    }
  }

 private:
  std::vector<double> x_, y_, dx_, dy_, inverse_;
};

/// Maximum distance of a polyline from another, by branch and bound. The distance to one segment is convex along a
/// straight piece, so its distance from the whole polyline is at most the minimum over segments of the larger distance
/// at its two ends.
class FarthestPoint {
 public:
  FarthestPoint(std::span<const Point> to, double tolerance)
      : to_(to), tolerance_(tolerance), at_from_(to_.count()), at_end_(to_.count()) {}

  double run(std::span<const Point> from) {
    constexpr std::size_t max_distances = 20'000'000;  // about 50 ms
    for (const Point& point : from) largest_ = std::max(largest_, nearest(point, at_end_));
    left_ = max_distances / to_.count();
    double bound = largest_;
    for (std::size_t i = 1; i < from.size(); ++i) bound = std::max(bound, search(from[i - 1], from[i]));
    return bound;
  }

 private:
  double nearest(const Point& point, std::vector<double>& distances) const {
    to_.measure(point, distances);
    return std::sqrt(*std::min_element(distances.begin(), distances.end()));
  }

  /// Upper bound on the distances along a piece, at most `tolerance` above the maximum distance found.
  double search(const Point& from, const Point& end) {
    pieces_.assign(1, {from, end});
    double bound = 0.0;
    while (!pieces_.empty()) {
      const auto [first, last] = pieces_.back();
      pieces_.pop_back();
      largest_ = std::max({largest_, nearest(first, at_from_), nearest(last, at_end_)});
      double squared = std::max(at_from_[0], at_end_[0]);
      for (std::size_t i = 1; i < at_from_.size(); ++i) squared = std::min(squared, std::max(at_from_[i], at_end_[i]));
      const double piece_bound = std::min(std::sqrt(squared), largest_ + 0.5 * (last - first).norm());
      if (piece_bound <= largest_ + tolerance_ || left_ == 0) {
        bound = std::max(bound, piece_bound);
        continue;
      }
      --left_;
      const Point middle = 0.5 * (first + last);
      pieces_.emplace_back(first, middle);
      pieces_.emplace_back(middle, last);
    }
    return std::max(bound, largest_);
  }

  Segments to_;
  double tolerance_;
  std::vector<double> at_from_, at_end_;
  std::vector<std::pair<Point, Point>> pieces_;
  double largest_ = 0.0;
  std::size_t left_ = 0;
};

}  // namespace

double hausdorff_distance(std::span<const Point> one, std::span<const Point> other, double tolerance) {
  return std::max(FarthestPoint(other, tolerance).run(one), FarthestPoint(one, tolerance).run(other));
}

}  // namespace calligraphy::recognition
