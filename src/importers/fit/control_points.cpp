#include "control_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include <Eigen/Dense>

namespace calligraphy::recognition {
namespace {

constexpr int most_steps = 24;
constexpr int unweighted_steps = 2;      // before distant points are given more weight
constexpr double close_enough = 0.010;   // [em]; the steps end once no point is farther off
constexpr double still_improving = 0.95; // [1]; unless the last step brought the distance below this share
constexpr double weight_of_ends = 3.0;
constexpr double least_weight = 0.02;
constexpr double ridge = 5e-2;  // pull towards the current points; steadies the handles of a nearly straight curve
constexpr double least_share = 0.15;  // [1]; no handle at a smooth joint shrinks below this in one step
constexpr double least_handle = 0.01;  // [em]; nor ever below this, so that it keeps its direction when rounded
constexpr int curve_pieces = 24;

constexpr std::size_t most_points = 1 + 3 * max_elements_per_stroke;
constexpr int most_unknowns = 2 * static_cast<int>(most_points);
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_unknowns, most_unknowns>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_unknowns, 1>;

Point unit(const Point& vector) {
  const double norm = vector.norm();
  return norm > 1e-12 ? Point(vector / norm) : Point(1.0, 0.0);
}

/// The control points at which the elements of a stroke begin, and the one at which the last element ends.
std::vector<std::size_t> starts_of(std::string_view elements) {
  std::vector<std::size_t> starts{0};
  for (const char kind : elements) starts.push_back(starts.back() + (kind == 'L' ? 1 : 3));
  return starts;
}

/// Weights of an element's control points at its parameter t.
struct Blend {
  int count;
  std::array<double, 4> weights;
};

Blend blend_at(char kind, double t) {
  const double s = 1.0 - t;
  if (kind == 'L') return {2, {s, t, 0.0, 0.0}};
  return {4, {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t}};
}

/// Solves for the control points of a stroke that is assigned to a path.
class ControlPointSolver {
 public:
  ControlPointSolver(const TypicalStroke& type, std::string_view elements, std::vector<Point> start)
      : type_(type), elements_(elements), starts_(starts_of(elements)), points_(std::move(start)) {
    straighten();
  }

  const std::vector<Point>& points() const { return points_; }

  /// Least squares of the weighted distances of the path from the stroke at parameters `places` (element + t). False if
  /// there is no unique solution; the points are then unchanged.
  bool solve(const Path& path, std::span<const double> places, std::span<const double> weights) {
    accumulate(path, places, weights);
    arrange_unknowns();
    Matrix normal = Matrix::Zero(unknowns_, unknowns_);
    Vector right = Vector::Zero(unknowns_);
    for (std::size_t row = 0; row < points_.size(); ++row) {
      for (int axis = 0; axis < 2; ++axis) {
        for_each_unknown(row, axis, [&](int unknown, double factor) {
          right[unknown] += factor * right_(static_cast<int>(row), axis);
          const std::size_t last = std::min(points_.size() - 1, row + 3);
          for (std::size_t column = row < 3 ? 0 : row - 3; column <= last; ++column) {
            const double entry = factor * gram_(static_cast<int>(row), static_cast<int>(column));
            if (entry == 0.0) continue;
            for_each_unknown(column, axis,
                             [&](int other, double also) { normal(unknown, other) += entry * also; });
          }
        });
      }
    }
    const Eigen::LDLT<Matrix> factors(normal);
    if (factors.info() != Eigen::Success || !factors.isPositive()) return false;
    const Vector solution = factors.solve(right);
    if (!solution.allFinite()) return false;
    take(solution);
    straighten();
    return true;
  }

 private:
  /// A handle at a smooth joint lies at joint + length * direction, of which only the length is unknown.
  struct Unknown {
    int first = 0;           ///< of x and y, or the length
    bool is_handle = false;  ///< at a smooth joint
    std::size_t joint = 0;
    Point direction = Point::Zero();
  };

  /// Calls action(joint, direction, handle before it or none, handle after it or none) for every smooth joint.
  template <typename Action>
  void for_each_smooth_joint(Action action) const {
    for (std::size_t i = 0; i + 1 < elements_.size(); ++i) {
      if (!is_smooth_joint(type_, elements_, i)) continue;
      const std::size_t joint = starts_[i + 1];
      const bool before = elements_[i] == 'C';
      const bool after = elements_[i + 1] == 'C';
      const Point& from = points_[before && !after ? joint : joint - 1];
      const Point& to = points_[after && !before ? joint : joint + 1];
      action(joint, unit(to - from), before, after);
    }
  }

  void accumulate(const Path& path, std::span<const double> places, std::span<const double> weights) {
    const int count = static_cast<int>(points_.size());
    gram_.setZero(count, count);
    right_.setZero(count, 2);
    double total = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const std::size_t element = std::min(static_cast<std::size_t>(places[i]), elements_.size() - 1);
      const Blend blend = blend_at(elements_[element], places[i] - static_cast<double>(element));
      const int first = static_cast<int>(starts_[element]);
      for (int row = 0; row < blend.count; ++row) {
        const double weighted = weights[i] * blend.weights[static_cast<std::size_t>(row)];
        right_.row(first + row) += weighted * path[i].transpose();
        for (int column = 0; column < blend.count; ++column) {
          gram_(first + row, first + column) += weighted * blend.weights[static_cast<std::size_t>(column)];
        }
      }
      total += weights[i];
    }
    const double pull = ridge * total / count;
    for (int row = 0; row < count; ++row) {
      gram_(row, row) += pull;
      right_.row(row) += pull * points_[static_cast<std::size_t>(row)].transpose();
    }
  }

  void arrange_unknowns() {
    of_point_.assign(points_.size(), {});
    for_each_smooth_joint([&](std::size_t joint, const Point& direction, bool before, bool after) {
      if (before) of_point_[joint - 1] = {0, true, joint, -direction};
      if (after) of_point_[joint + 1] = {0, true, joint, direction};
    });
    unknowns_ = 0;
    for (Unknown& unknown : of_point_) {
      unknown.first = unknowns_;
      unknowns_ += unknown.is_handle ? 1 : 2;
    }
  }

  /// Calls action(unknown, factor) for the unknowns that make up one coordinate of a control point.
  template <typename Action>
  void for_each_unknown(std::size_t point, int axis, Action action) const {
    const Unknown& unknown = of_point_[point];
    if (!unknown.is_handle) {
      action(unknown.first + axis, 1.0);
    } else {
      action(of_point_[unknown.joint].first + axis, 1.0);
      action(unknown.first, unknown.direction[axis]);
    }
  }

  void take(const Vector& solution) {
    std::vector<double> least(points_.size(), 0.0);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!of_point_[i].is_handle) continue;
      least[i] = std::max(least_handle, least_share * (points_[i] - points_[of_point_[i].joint]).norm());
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!of_point_[i].is_handle) points_[i] = solution.segment<2>(of_point_[i].first);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Unknown& unknown = of_point_[i];
      if (!unknown.is_handle) continue;
      points_[i] = points_[unknown.joint] + std::max(least[i], solution[unknown.first]) * unknown.direction;
    }
  }

  /// Aligns the handles at smooth joints with the other side of the joint.
  void straighten() {
    for_each_smooth_joint([&](std::size_t joint, const Point& direction, bool before, bool after) {
      if (before) points_[joint - 1] = points_[joint] - (points_[joint - 1] - points_[joint]).norm() * direction;
      if (after) points_[joint + 1] = points_[joint] + (points_[joint + 1] - points_[joint]).norm() * direction;
    });
  }

  const TypicalStroke& type_;
  std::string_view elements_;
  std::vector<std::size_t> starts_;
  std::vector<Point> points_;
  std::vector<Unknown> of_point_;
  int unknowns_ = 0;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_points, most_points> gram_;
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most_points, 2> right_;
};

/// A vertex of a stroke as a polyline.
struct Vertex {
  Point point;
  double place;  ///< element + t
  double arc;    ///< [em]
};

std::vector<Vertex> vertices_of(std::string_view elements, std::span<const Point> points) {
  std::vector<Vertex> vertices{{points[0], 0.0, 0.0}};
  const auto add = [&](const Point& point, double place) {
    vertices.push_back({point, place, vertices.back().arc + (point - vertices.back().point).norm()});
  };
  std::size_t at = 0;
  double element = 0.0;
  for (const char kind : elements) {
    if (kind == 'L') {
      add(points[++at], element + 1.0);
    } else {
      for (int piece = 1; piece <= curve_pieces; ++piece) {
        const double t = static_cast<double>(piece) / curve_pieces;
        const Blend blend = blend_at(kind, t);
        Point point = Point::Zero();
        for (std::size_t i = 0; i < 4; ++i) point += blend.weights[i] * points[at + i];
        add(point, element + t);
      }
      at += 3;
    }
    element += 1.0;
  }
  return vertices;
}

/// Makes the values non-decreasing, with the least sum of squared changes (pool adjacent violators).
void put_in_order(std::span<double> values) {
  struct Pool {
    double mean;
    std::size_t count;
  };
  std::vector<Pool> pools;
  for (const double value : values) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean > pools.back().mean) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& pool = pools.back();
      const double sum = pool.mean * static_cast<double>(pool.count) + last.mean * static_cast<double>(last.count);
      pool.count += last.count;
      pool.mean = sum / static_cast<double>(pool.count);
    }
  }
  std::size_t at = 0;
  for (const Pool& pool : pools) {
    for (std::size_t i = 0; i < pool.count; ++i) values[at++] = pool.mean;
  }
}

/// Assigns each point of the path to the nearest place on the stroke within reach of its current one, in order. Returns
/// the distances [em].
std::vector<double> assign(std::string_view elements, std::span<const Point> points, const Path& path,
                           std::span<double> places) {
  const std::vector<Vertex> vertices = vertices_of(elements, points);
  const double reach = 0.12 * vertices.back().arc + 0.02;  // [em]
  // Arc length at a place, from the segment that contains it; places are in order, so the segments are found in order.
  const auto share_in = [&](std::size_t segment, double place) {
    const double width = vertices[segment].place - vertices[segment - 1].place;
    return std::clamp((place - vertices[segment - 1].place) / width, 0.0, 1.0);
  };
  std::size_t segment = 1;
  std::size_t first = 1;
  for (std::size_t i = 0; i < path.size(); ++i) {
    while (segment + 1 < vertices.size() && vertices[segment].place < places[i]) ++segment;
    const double share = share_in(segment, places[i]);
    const double here = vertices[segment - 1].arc + share * (vertices[segment].arc - vertices[segment - 1].arc);
    while (first + 1 < vertices.size() && vertices[first].arc < here - reach) ++first;
    double nearest = std::numeric_limits<double>::infinity();
    double at = places[i];
    for (std::size_t k = first; k < vertices.size() && vertices[k - 1].arc <= here + reach; ++k) {
      const Vertex& from = vertices[k - 1];
      const Vertex& to = vertices[k];
      const double length = to.arc - from.arc;
      const Point along = to.point - from.point;
      double t = length > 0.0 ? (path[i] - from.point).dot(along) / (length * length) : 0.0;
      if (length > 0.0) t = std::clamp(t, (here - reach - from.arc) / length, (here + reach - from.arc) / length);
      t = std::clamp(t, 0.0, 1.0);
      const double squared = (path[i] - from.point - t * along).squaredNorm();
      if (squared >= nearest) continue;
      nearest = squared;
      at = from.place + t * (to.place - from.place);
    }
    places[i] = at;
  }
  const auto pin_ends = [&] {
    places.front() = 0.0;
    places.back() = static_cast<double>(elements.size());
  };
  pin_ends();
  put_in_order(places);
  pin_ends();
  std::vector<double> distances(path.size());
  segment = 1;
  for (std::size_t i = 0; i < path.size(); ++i) {
    while (segment + 1 < vertices.size() && vertices[segment].place < places[i]) ++segment;
    const Point& from = vertices[segment - 1].point;
    distances[i] = (path[i] - from - share_in(segment, places[i]) * (vertices[segment].point - from)).norm();
  }
  // A corner may be farther from the path than any point of the path is from the stroke.
  std::size_t after = 1;
  std::size_t at_joint = 0;
  for (std::size_t element = 0; element + 1 < elements.size(); ++element) {
    at_joint += elements[element] == 'L' ? 1 : 3;
    while (after + 1 < path.size() && places[after] < static_cast<double>(element + 1)) ++after;
    const Point& joint = points[at_joint];
    const double distance = (joint - nearest_on_segment(joint, path[after - 1], path[after])).norm();
    distances[after - 1] = std::max(distances[after - 1], distance);
    distances[after] = std::max(distances[after], distance);
  }
  return distances;
}

/// The initial control points: joints on the path, and curves through it at one and two thirds of an element.
std::vector<Point> first_points(std::string_view elements, const Path& path, std::span<const std::size_t> ends) {
  std::vector<Point> points{path[ends[0]]};
  for (std::size_t element = 0; element < elements.size(); ++element) {
    const std::size_t from = ends[element];
    const std::size_t to = ends[element + 1];
    if (elements[element] == 'C') {
      const Point& a = path[from];
      const Point& b = path[from + (to - from) / 3];
      const Point& c = path[from + 2 * (to - from) / 3];
      const Point& d = path[to];
      points.emplace_back((-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0);
      points.emplace_back((2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0);
    }
    points.push_back(path[to]);
  }
  return points;
}

/// The initial places of the path's points on the stroke, by their share of each element's arc.
std::vector<double> first_places(const Path& path, std::span<const std::size_t> ends) {
  std::vector<double> places(path.size());
  for (std::size_t element = 0; element + 1 < ends.size(); ++element) {
    const double width = static_cast<double>(ends[element + 1] - ends[element]);
    for (std::size_t i = ends[element]; i <= ends[element + 1]; ++i) {
      places[i] = static_cast<double>(element) + static_cast<double>(i - ends[element]) / width;
    }
  }
  return places;
}

/// Gives points more weight the farther off they are, which approaches the least maximum distance (Lawson 1961).
void weigh_by_distance(std::span<const double> distances, double farthest, std::span<double> weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] *= 0.25 + distances[i] / farthest;
    sum += weights[i];
  }
  const double mean = sum / static_cast<double>(weights.size());
  for (double& weight : weights) weight = std::max(least_weight, weight / mean);
}

}  // namespace

std::vector<Point> fit_control_points(const TypicalStroke& type, std::string_view elements, const Path& path,
                                      std::span<const std::size_t> ends) {
  ControlPointSolver solver(type, elements, first_points(elements, path, ends));
  std::vector<double> places = first_places(path, ends);
  std::vector<double> weights(path.size(), 1.0);
  weights.front() = weights.back() = weight_of_ends;
  std::vector<Point> best = solver.points();
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    if (!solver.solve(path, places, weights)) break;
    const std::vector<double> distances = assign(elements, solver.points(), path, places);
    const double farthest = *std::max_element(distances.begin(), distances.end());
    const bool improves = farthest < still_improving * least;
    if (farthest < least) {
      least = farthest;
      best = solver.points();
    }
    if (step < unweighted_steps) continue;
    if (farthest < close_enough && !improves) break;
    weigh_by_distance(distances, farthest, weights);
  }
  return best;
}

}  // namespace calligraphy::recognition
