#include <calligraphy/experiments/force_field.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include <calligraphy/render/force_terms.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// What pulls the pen at a place.
struct Pull {
  Point force;
  bool passed_feature;
};
using Field = std::function<Pull(const Point&)>;

/// Step of the pen that writes up to the progress at which the field is computed [m].
constexpr double writing_step = 1e-4;
/// The pen goes this far beyond each feature point, since the plane as printed must be crossed [m].
constexpr double overshoot = 2e-4;

Pull pull(const StrokeContact& contact, const Point& tip, double stiffness) {
  return {attraction_force(stiffness * contact.attraction * contact.weight, tip, contact.closest.point),
          contact.passed_feature};
}

/// The state of the stroke once a pen on its middle line has come as far as `progress`.
ActiveStroke written(const Stroke& stroke, const Placement& placement, double progress, const StrokeOptions& options) {
  ActiveStroke active;
  active.load(stroke, placement);
  const double end = progress * active.length();
  double before = 0.0;
  for (int i = 0; i < active.element_count(); ++i) {
    const StrokeElement& element = active.element(i);
    const double length = element.length();
    const double here = std::min(end - before, length);
    const int steps = static_cast<int>(std::ceil(here / writing_step));
    for (int k = 0; k <= steps; ++k) active.update(element.point(element.parameter_at(here * k / steps)), options);
    before += length;
    if (before >= end) break;
    active.update(element.point(1.0) + overshoot * element.tangent(1.0), options);
  }
  return active;
}

Field active_stroke_field(const Stroke& stroke, const Placement& placement, double progress,
                          const ForceFieldOptions& options) {
  const ActiveStroke active = written(stroke, placement, progress, options.stroke);
  return [active, options](const Point& tip) {
    ActiveStroke copy = active;
    return pull(copy.update(tip, options.stroke), tip, options.stiffness);
  };
}

/// The nearest of all elements of all strokes; the attraction factor as the rules say.
Field nearest_stroke_field(const PlacedCharacter& placed, const ForceFieldOptions& options) {
  struct Candidate {
    StrokeElement element;
    double first_factor, last_factor;
  };
  std::vector<Candidate> candidates;
  for (const Stroke& stroke : strokes(placed.character)) {
    const std::vector<StrokeElement> elements = place_elements(stroke, placed.placement);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const double first = stroke.attraction_factors[i];
      const bool linear = !is_printed(options.stroke.rules);
      candidates.push_back({elements[i], first, linear ? stroke.attraction_factors[i + 1] : first});
    }
  }
  return [candidates, options, em = placed.placement.em](const Point& tip) {
    const Candidate* nearest = nullptr;
    NearestPoint closest;
    for (const Candidate& candidate : candidates) {
      const NearestPoint found = nearest_point(candidate.element, tip, options.stroke.nearest);
      if (nearest != nullptr && !(found.distance < closest.distance)) continue;
      nearest = &candidate;
      closest = found;
    }
    StrokeContact contact;
    contact.closest = closest;
    contact.weight = guidance_weight(options.stroke.space, em, nearest->element, tip, closest, options.stroke.rules);
    const double length = nearest->element.length();
    const double along = length > 0.0 ? nearest->element.arc_length(closest.parameter) / length : 0.0;
    contact.attraction = nearest->first_factor + along * (nearest->last_factor - nearest->first_factor);
    return pull(contact, tip, options.stiffness);
  };
}

struct Crossing {
  Point place;
  double jump;
  bool passes_feature;
};

/// Bisects to where the force jumps between two places: a continuous change shrinks with the interval, a jump does not.
std::optional<Crossing> crossing(const Field& field, Point begin, Point end, Pull at_begin, Pull at_end,
                                 double min_jump) {
  if ((at_end.force - at_begin.force).norm() < min_jump) return {};
  for (int i = 0; i < 10; ++i) {
    const Point middle = 0.5 * (begin + end);
    const Pull at_middle = field(middle);
    const bool first = (at_middle.force - at_begin.force).norm() > (at_end.force - at_middle.force).norm();
    (first ? end : begin) = middle;
    (first ? at_end : at_begin) = at_middle;
  }
  const double jump = (at_end.force - at_begin.force).norm();
  if (jump < min_jump) return {};
  return Crossing{0.5 * (begin + end), jump, at_begin.passed_feature != at_end.passed_feature};
}

/// The pull at each place of a square, and the lines across which it jumps.
class Scan {
 public:
  Scan(const Field& field, const ForceField& square, const ForceFieldOptions& options)
      : field_(field), square_(square), options_(options) {
    for (int row = 0; row < square.columns; ++row) {
      report_progress(row);
      for (int column = 0; column < square.columns; ++column) pulls_.push_back(field(square.place(column, row)));
    }
  }

  const std::vector<Pull>& pulls() const { return pulls_; }

  /// Joins the crossings on the edges of each four neighbouring places.
  std::vector<ForceJump> jumps() const {
    const int n = square_.columns;
    std::vector<std::optional<Crossing>> right(pulls_.size()), above(pulls_.size());
    for (int row = 0; row < n; ++row) {
      report_progress(n + row);
      for (int column = 0; column < n; ++column) {
        if (column + 1 < n) right[index(column, row)] = between(column, row, column + 1, row);
        if (row + 1 < n) above[index(column, row)] = between(column, row, column, row + 1);
      }
    }
    std::vector<ForceJump> jumps;
    for (int row = 0; row + 1 < n; ++row) {
      for (int column = 0; column + 1 < n; ++column) {
        std::vector<Crossing> found;
        for (const auto& edge : {right[index(column, row)], right[index(column, row + 1)], above[index(column, row)],
                                 above[index(column + 1, row)]}) {
          if (edge) found.push_back(*edge);
        }
        join(found, jumps);
      }
    }
    return jumps;
  }

  /// Every row counts twice: once for the forces and once for the jumps.
  void report_progress(int rows_done) const {
    if (options_.progress) options_.progress(0.5 * rows_done / square_.columns);
  }

 private:
  std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * square_.columns + column); }

  std::optional<Crossing> between(int column, int row, int next_column, int next_row) const {
    return crossing(field_, square_.place(column, row), square_.place(next_column, next_row),
                    pulls_[index(column, row)], pulls_[index(next_column, next_row)], options_.min_jump);
  }

  static void join(const std::vector<Crossing>& found, std::vector<ForceJump>& jumps) {
    if (found.size() < 2) return;  // the line ends here
    const auto piece = [&jumps](const Crossing& from, const Point& to) {
      jumps.push_back({from.place, to, from.jump, 0.0, from.passes_feature});
    };
    if (found.size() == 2 && found[0].passes_feature == found[1].passes_feature) {
      const std::size_t larger = found[0].jump > found[1].jump ? 0 : 1;
      return piece(found[larger], found[1 - larger].place);
    }
    Point middle = Point::Zero();
    for (const Crossing& each : found) middle += each.place / static_cast<double>(found.size());
    for (const Crossing& each : found) piece(each, middle);
  }

  const Field& field_;
  const ForceField& square_;
  const ForceFieldOptions& options_;
  std::vector<Pull> pulls_;
};

double distance_to(const std::vector<StrokeElement>& elements, const Point& point) {
  double distance = std::numeric_limits<double>::infinity();
  for (const StrokeElement& element : elements) {
    distance = std::min(distance, nearest_point(element, point).distance);
  }
  return distance;
}

}  // namespace

Point ForceField::place(int column, int row) const noexcept {
  return corner + edge / columns * Point(column + 0.5, row + 0.5);
}

const Point& ForceField::force(int column, int row) const noexcept {
  return forces[static_cast<std::size_t>(row * columns + column)];
}

double ForceField::max_force() const noexcept {
  double largest = 0.0;
  for (const Point& each : forces) largest = std::max(largest, each.norm());
  return largest;
}

ForceField guidance_field(const PlacedCharacter& placed, int stroke, double progress, const Point& corner, double edge,
                          const ForceFieldOptions& options) {
  require(stroke >= 0 && stroke < placed.character.stroke_count(), "force field: stroke", stroke, "",
          "the index of one of " + std::to_string(placed.character.stroke_count()) + " strokes");
  require_within("force field: progress", progress, "", 0.0, 1.0);
  for (const double coordinate : corner) {
    require(std::isfinite(coordinate), "force field: corner", coordinate, "m", "finite");
  }
  require_above_zero("force field: edge", edge, "m");
  require_within("force field: columns", options.columns, "", 2, 4096);
  require_not_negative("force field: stiffness", options.stiffness, "N/m");
  require_above_zero("force field: min_jump", options.min_jump, "N");
  const Stroke active = strokes(placed.character)[static_cast<std::size_t>(stroke)];
  const Field pulls = options.attractor == Attractor::nearest_stroke
                          ? nearest_stroke_field(placed, options)
                          : active_stroke_field(active, placed.placement, progress, options);
  ForceField field{corner, edge, options.columns, {}, {}};
  const Scan scan(pulls, field, options);
  for (const Pull& each : scan.pulls()) field.forces.push_back(each.force);
  field.jumps = scan.jumps();
  const std::vector<StrokeElement> elements = place_elements(active, placed.placement);
  for (ForceJump& jump : field.jumps) jump.from_stroke = distance_to(elements, 0.5 * (jump.begin + jump.end));
  scan.report_progress(2 * options.columns);
  return field;
}

}  // namespace calligraphy
