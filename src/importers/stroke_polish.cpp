#include "stroke_polish.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Dense>

#include "stroke_polyline.hpp"
#include "stroke_variables.hpp"

namespace calligraphy::recognition {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Nearest point on a segment of a polyline: squared distance and position along the segment.
struct ClosestPoint {
  double squared = infinity;
  std::size_t segment = 0;
  double share = 0.0;
};

ClosestPoint foot_on(std::span<const Point> from, std::span<const Point> along, std::span<const double> inverse,
                     const Point& point) {
  ClosestPoint closest;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Point offset = point - from[i];
    const double share = std::clamp(offset.dot(along[i]) * inverse[i], 0.0, 1.0);
    const double squared = (offset - share * along[i]).squaredNorm();
    if (squared < closest.squared) closest = {squared, i, share};
  }
  return closest;
}

/// Segments of a polyline, prepared for many closest-point queries.
struct OutlineSegments {
  std::vector<Point> from, along;
  std::vector<double> inverse;  ///< 1 / squared length, 0 for a segment of zero length

  void add(const Point& first, const Point& last) {
    from.push_back(first);
    along.push_back(last - first);
    const double squared = along.back().squaredNorm();
    inverse.push_back(squared > 0.0 ? 1.0 / squared : 0.0);
  }
  ClosestPoint closest_to(const Point& point) const { return foot_on(from, along, inverse, point); }
};

/// A distance, its direction, and the weight of each control point of an element in its end on the stroke.
struct Offset {
  int first;
  int count;
  std::array<double, 4> weights;
  double distance;
  Point unit;
};

/// Sum of a power of the scaled distances, with its derivatives with respect to the control point coordinates.
/// Distances are linearised in them, which makes the second derivative positive.
struct Penalty {
  double sum = infinity;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

Penalty penalty_of(std::span<const Offset> offsets, int coordinates, double scale, int power) {
  Penalty penalty{0.0, Eigen::VectorXd::Zero(coordinates), Eigen::MatrixXd::Zero(coordinates, coordinates)};
  for (const Offset& offset : offsets) {
    const double ratio = offset.distance / scale;
    const double second = std::pow(ratio, power - 2);
    penalty.sum += second * ratio * ratio;
    if (second < 1e-9) continue;
    const Point slope = second * ratio * offset.unit;
    const Eigen::Matrix2d bend = second * (power - 1) / scale * offset.unit * offset.unit.transpose();
    for (int i = 0; i < offset.count; ++i) {
      const int row = 2 * (offset.first + i);
      penalty.gradient.segment<2>(row) += offset.weights[i] * slope;
      for (int j = 0; j < offset.count; ++j) {
        const int column = 2 * (offset.first + j);
        penalty.curvature.block<2, 2>(row, column) += offset.weights[i] * offset.weights[j] * bend;
      }
    }
  }
  return penalty;
}

double sum_of(std::span<const Offset> offsets, double scale, int power) {
  double sum = 0.0;
  for (const Offset& offset : offsets) sum += std::pow(offset.distance / scale, power);
  return sum;
}

double max_over(std::span<const Offset> offsets) {
  double largest = 0.0;
  for (const Offset& offset : offsets) largest = std::max(largest, offset.distance);
  return largest;
}

class Polish {
 public:
  Polish(const TypicalStroke& type, const Path& path)
      : variables_(type), path_(path), chords_(stroke_chords(type.elements, curve_steps)) {
    constexpr double tolerance = 2e-4;  // [em]
    const Path outline = simplified(path, 64, tolerance);
    for (std::size_t i = 1; i < outline.size(); ++i) outline_.add(outline[i - 1], outline[i]);
  }

  std::vector<Point> run(std::vector<Point> points) const {
    constexpr double good_enough = 5e-4;  // [em]
    Eigen::VectorXd values = variables_.values_of(points);
    for (const int power : {4, 16, 64}) {
      step_down(values, power);
      if (max_over(offsets_of(variables_.control_points_of(values))) < good_enough) break;
    }
    return variables_.control_points_of(values);
  }

 private:
  static constexpr int curve_steps = 16;
  static constexpr int line_steps = 8;

  /// Newton's method with Levenberg damping on the sum of one power.
  void step_down(Eigen::VectorXd& values, int power) const {
    constexpr int max_steps = 20;
    double damping = 1e-3;
    std::vector<Point> points = variables_.control_points_of(values);
    std::vector<Offset> offsets = offsets_of(points);
    for (int step = 0; step < max_steps; ++step) {
      const double scale = std::max(max_over(offsets), 1e-9);
      const Penalty penalty = reduced(penalty_of(offsets, static_cast<int>(2 * points.size()), scale, power), points);
      const double floor = 1e-3 * penalty.curvature.diagonal().maxCoeff() + 1e-12;
      bool better = false;
      for (; !better && damping < 1e6; damping *= better ? 0.1 : 6.0) {
        Eigen::MatrixXd damped = penalty.curvature;
        damped.diagonal().array() += damping * (damped.diagonal().array() + floor);
        const Eigen::VectorXd moved = values - damped.ldlt().solve(penalty.gradient);
        if (!moved.allFinite()) continue;
        std::vector<Point> next = variables_.control_points_of(moved);
        std::vector<Offset> next_offsets = offsets_of(next);
        if (!(sum_of(next_offsets, scale, power) < penalty.sum)) continue;
        better = true;
        values = variables_.values_of(next);
        points = std::move(next);
        offsets = std::move(next_offsets);
      }
      if (!better || sum_of(offsets, scale, power) > 0.99 * penalty.sum) break;
    }
  }

  /// Derivatives with respect to the variables.
  Penalty reduced(Penalty penalty, std::span<const Point> points) const {
    if (variables_.plain()) return penalty;
    const Eigen::MatrixXd slopes = variables_.slopes_at(points);
    return {penalty.sum, slopes.transpose() * penalty.gradient, slopes.transpose() * penalty.curvature * slopes};
  }

  std::vector<Offset> offsets_of(std::span<const Point> points) const {
    std::vector<Offset> offsets;
    OutlineSegments stroke;
    for (const StrokeChord& chord : chords_)
      stroke.add(mixed(chord, chord.from, points), mixed(chord, chord.to, points));
    for (const Point& point : path_) {
      const ClosestPoint closest = stroke.closest_to(point);
      add(offsets, closest.segment, closest.share, stroke, point);
    }
    for (std::size_t segment = 0; segment < chords_.size(); ++segment) {
      const int steps = chords_[segment].count == 2 ? line_steps : 1;
      for (int step = segment == 0 ? 0 : 1; step <= steps; ++step) {
        const double share = static_cast<double>(step) / steps;
        const ClosestPoint closest = outline_.closest_to(stroke.from[segment] + share * stroke.along[segment]);
        add(offsets, segment, share, stroke,
            outline_.from[closest.segment] + closest.share * outline_.along[closest.segment]);
      }
    }
    return offsets;
  }

  /// Offset of a point on the stroke from a point on the path.
  void add(std::vector<Offset>& offsets, std::size_t segment, double share, const OutlineSegments& stroke,
           const Point& target) const {
    const StrokeChord& chord = chords_[segment];
    const Point away = stroke.from[segment] + share * stroke.along[segment] - target;
    const double distance = away.norm();
    Offset offset{chord.first, chord.count, {}, distance, distance > 0.0 ? Point(away / distance) : Point(0.0, 0.0)};
    for (int i = 0; i < chord.count; ++i) offset.weights[i] = (1.0 - share) * chord.from[i] + share * chord.to[i];
    offsets.push_back(offset);
  }

  static Point mixed(const StrokeChord& chord, const std::array<double, 4>& weights, std::span<const Point> points) {
    Point place = Point::Zero();
    for (int i = 0; i < chord.count; ++i) place += weights[i] * points[chord.first + i];
    return place;
  }

  StrokeVariables variables_;
  const Path& path_;
  std::vector<StrokeChord> chords_;
  OutlineSegments outline_;
};

}  // namespace

std::vector<Point> polished(const TypicalStroke& type, const Path& path, std::vector<Point> control_points) {
  return Polish(type, path).run(std::move(control_points));
}

}  // namespace calligraphy::recognition
