#include <calligraphy/importers/stroke_warnings.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/model/bezier.hpp>

#include "base/enum_name.hpp"
#include "base/parallel.hpp"
#include "importers/fit/polyline.hpp"
#include "importers/read/stroke_labels.hpp"
#include "shape_contradiction.hpp"

namespace calligraphy {
namespace {

using recognition::Path;

constexpr double overlap_distance = 0.01;                     // [em]; a printed line is wider
constexpr double outside_distance = 0.01;                     // [em]
// From the typical start [rad]: of a single element, perhaps a dot that falls to the left, and of the first of several.
constexpr double against = 100.0 * std::numbers::pi / 180.0;
constexpr double first_against = 80.0 * std::numbers::pi / 180.0;
constexpr double max_dot = 0.15;    // [em]
constexpr double min_start = 0.02;  // [em]; anything shorter has no direction
constexpr int curve_steps = 24;
constexpr double max_step = 0.02;  // [em]

// For a stroke compared with its drawing.
constexpr double most_turn = 135.0;     // [degree]; a hook turns back less
constexpr double fragment = 1.0 / 3.0;  // [1]; of the size of the outline
constexpr double least_length = 0.8;    // [1]; of the drawing without the ends that the tip of the brush covers
constexpr double most_length = 1.1;     // [1]
constexpr double round_corner = 0.03;   // [em]; within this, the drawing rounds the same corner
constexpr double most_distance = 0.04;  // [em]

/// One element of a stroke as a polyline, without its first point.
template <int Degree>
void append_curve(std::span<const Point> points, Path& path) {
  Bezier<Degree> curve;
  std::copy_n(points.begin(), Degree + 1, curve.control_points.begin());
  for (int i = 1; i <= curve_steps; ++i) path.push_back(curve.point(static_cast<double>(i) / curve_steps));
}

/// The stroke as a polyline with steps that are short relative to the thresholds.
Path sampled(const Stroke& stroke) {
  Path path{stroke.control_points.front()};
  std::size_t at = 0;
  for (const char kind : stroke.elements) {
    if (kind == static_cast<char>(ElementKind::line)) {
      const Point from = stroke.control_points[at];
      const Point along = stroke.control_points[at + 1] - from;
      const int steps = static_cast<int>(std::ceil(along.norm() / max_step)) + 1;
      for (int i = 1; i <= steps; ++i) path.push_back(from + (static_cast<double>(i) / steps) * along);
      at += 1;
    } else if (stroke.curve_degree == 3) {
      append_curve<3>(stroke.control_points.subspan(at), path);
      at += 3;
    } else {
      append_curve<4>(stroke.control_points.subspan(at), path);
      at += 4;
    }
  }
  return path;
}

/// Chord of the first element.
Point start_of(const Stroke& stroke) {
  const auto end = static_cast<std::size_t>(stroke.elements.front() == 'L' ? 1 : stroke.curve_degree);
  return stroke.control_points[end] - stroke.control_points.front();
}

Point typical_start(const TypicalStroke& type) {
  const auto end = static_cast<std::size_t>(type.elements.front() == 'L' ? 1 : 3);
  return Point(type.shape[end][0], type.shape[end][1]) - Point(type.shape[0][0], type.shape[0][1]);
}

double distance_outside(const Path& path) {
  double farthest = 0.0;
  for (const Point& point : path) {
    farthest = std::max({farthest, -point.minCoeff(), point.maxCoeff() - 1.0});
  }
  return farthest;
}

double squared_distance(const Point& point, const Path& path) {
  double nearest = (point - path.front()).squaredNorm();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point closest = recognition::nearest_on_segment(point, path[i - 1], path[i]);
    nearest = std::min(nearest, (point - closest).squaredNorm());
  }
  return nearest;
}

bool lies_on(const Path& path, const Path& other) {
  return std::all_of(path.begin(), path.end(), [&](const Point& point) {
    return squared_distance(point, other) <= overlap_distance * overlap_distance;
  });
}

std::string name_with_id(int id) {
  const TypicalStroke& type = typical_stroke(id);
  return std::to_string(id) + " (" + std::string(type.name) + " " + std::string(type.pinyin) + ")";
}

/// How the curve contradicts the recorded type, in words; empty if it does not. A short element has the shape of
/// many types, a heng may rise like a ti, and a heng zhe end with the lift of a brush, which looks like a hook.
std::string other_shape(const Stroke& stroke, const Path& path) {
  const int id = stroke.type->id;
  const bool is_single = stroke.elements.size() == 1;
  if (is_single && recognition::path_length(path) < max_dot) return {};
  const int found = fit_stroke(path).recognised;
  if (std::min(found, id) == 1 && (std::max(found, id) == 1 || std::max(found, id) == 10)) return {};
  if (id == 16 && found == 18) return {};
  if (recognition::contradicts(path, false, {&id, 1}, found)) return "has the shape of " + name_with_id(found);
  if (is_single && recognition::is_misdirected(path, {&id, 1})) return "runs in another direction";
  return {};
}

/// "5.1 %".
std::string percents(double share) {
  const long tenths = std::lround(1000.0 * share);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " %";
}

std::string percent_of_em(double length) { return percents(length) + " of the em"; }

/// A label and the typical strokes that it allows: "g (竖钩)".
std::string label_with_names(const std::string& label) {
  std::span<const int> ids = ids_of_kanjivg_label(label);
  if (ids.empty() && label.size() == 1) ids = ids_of_stroke_letter(label[0]);
  std::string names;
  for (const int id : ids) names += (names.empty() ? "" : ", ") + std::string(typical_stroke(id).name);
  return label + " (" + names + ")";
}

std::string description_of(const LabelConflict& conflict) {
  const std::string recognised = name_with_id(conflict.recognised);
  if (conflict.resolution == LabelResolution::unknown)
    return "label " + conflict.label + " is unknown; the shape is that of " + recognised;
  return "is labelled " + label_with_names(conflict.label) + " but has the shape of " + recognised;
}

/// The warnings of one character's strokes against their source.
using SourceWarnings = std::map<std::pair<char32_t, std::string>, std::vector<StrokeWarning>>;

void add_measures(const StrokeMeasures& stroke, std::vector<StrokeWarning>& warnings) {
  const auto add = [&](StrokeWarningKind kind, std::string what) {
    warnings.push_back({stroke.place.stroke, kind, std::move(what)});
  };
  if (stroke.backward > most_backward) {
    add(StrokeWarningKind::fold, "runs back by " + percents(stroke.backward) + " of its length");
  } else if (stroke.reversal > most_turn) {
    add(StrokeWarningKind::fold,
        "the drawing turns back by " + std::to_string(std::lround(stroke.reversal)) + " degrees");
  }
  if (stroke.source_length < fragment * stroke.outline_size) {
    add(StrokeWarningKind::length, "the median is " + percent_of_em(stroke.source_length) + " long, its outline " +
                                       percents(stroke.outline_size));
  } else if (stroke.length < least_length * (stroke.source_length - 2.0 * stroke.half_width) ||
             stroke.length > most_length * stroke.source_length) {
    add(StrokeWarningKind::length,
        "is " + percent_of_em(stroke.length) + " long, the drawing " + percents(stroke.source_length));
  }
  if (stroke.false_distance > round_corner) {
    add(StrokeWarningKind::corner,
        "has a corner that the drawing lacks, " + percent_of_em(stroke.false_distance) + " off it");
  }
  if (stroke.lost_inside > brush_end) {
    add(StrokeWarningKind::corner, "the drawing has a corner " + percent_of_em(stroke.lost_inside) +
                                       " from its end that the stroke lacks: a jagged drawing, or another kind");
  }
  if (stroke.frechet > most_distance) {
    add(StrokeWarningKind::distance, "is up to " + percent_of_em(stroke.frechet) + " off the drawing");
  }
}

/// The warnings that follow from the labels, measures and crossings of an import.
SourceWarnings source_warnings(const ImportReport& report) {
  SourceWarnings warnings;
  const auto warnings_of = [&](const StrokeReference& place) -> std::vector<StrokeWarning>& {
    return warnings[{place.code, place.order}];
  };
  for (const LabelConflict& conflict : report.label_conflicts) {
    if (!conflict.certain && conflict.resolution != LabelResolution::unknown) continue;
    warnings_of(conflict.place).push_back({conflict.place.stroke, StrokeWarningKind::label, description_of(conflict)});
  }
  for (const StrokeMeasures& stroke : report.measures) add_measures(stroke, warnings_of(stroke.place));
  for (const auto& [place, other] : report.lost_crossings) {
    warnings_of(place).push_back({place.stroke, StrokeWarningKind::crossing,
                                  "crosses stroke " + std::to_string(other) + " in the drawing, but not as imported"});
  }
  return warnings;
}

/// The warnings of a character, by stroke and kind, without those about the type where a label contradicts the drawing.
std::vector<StrokeWarning> merged(std::vector<StrokeWarning> warnings, const std::vector<StrokeWarning>& of_source) {
  std::erase_if(warnings, [&](const StrokeWarning& warning) {
    return warning.kind == StrokeWarningKind::type &&
           std::any_of(of_source.begin(), of_source.end(), [&](const StrokeWarning& other) {
             return other.kind == StrokeWarningKind::label && other.stroke == warning.stroke;
           });
  });
  warnings.insert(warnings.end(), of_source.begin(), of_source.end());
  std::stable_sort(warnings.begin(), warnings.end(), [](const StrokeWarning& a, const StrokeWarning& b) {
    return std::tie(a.stroke, a.kind) < std::tie(b.stroke, b.kind);
  });
  return warnings;
}

}  // namespace

const char* to_string(StrokeWarningKind kind) noexcept {
  static constexpr const char* names[] = {
      "type", "direction", "overlap", "outside", "label", "fold", "crossing", "length", "corner", "distance"};
  return name_of<StrokeWarningKind::distance>(kind, names, "distance");
}

double start_direction_error(const Stroke& stroke) {
  const Point start = start_of(stroke);
  const Point typical = typical_start(*stroke.type);
  if (start.norm() < min_start || typical.norm() < min_start) return 0.0;  // a dot, a circle
  return std::acos(std::clamp(start.normalized().dot(typical.normalized()), -1.0, 1.0));
}

std::vector<StrokeWarning> stroke_warnings(const Character& character) {
  std::vector<StrokeWarning> warnings;
  std::vector<Path> paths;
  int number = 0;
  for (const Stroke& stroke : strokes(character)) {
    ++number;
    paths.push_back(sampled(stroke));
    const Path& path = paths.back();
    // A stroke written backwards has the shape of another: one warning suffices.
    const bool is_single = stroke.elements.size() == 1;
    if (start_direction_error(stroke) > (is_single ? against : first_against)) {
      warnings.push_back(
          {number, StrokeWarningKind::direction, "starts against the direction of " + name_with_id(stroke.type->id)});
    } else if (const std::string other = other_shape(stroke, path); !other.empty()) {
      warnings.push_back(
          {number, StrokeWarningKind::type, "is of type " + name_with_id(stroke.type->id) + " but " + other});
    }
    if (const double outside = distance_outside(path); outside > outside_distance) {
      warnings.push_back({number, StrokeWarningKind::outside, "leaves the em square by " + percent_of_em(outside)});
    }
    for (std::size_t other = 0; other + 1 < paths.size(); ++other) {
      if (!lies_on(path, paths[other]) && !lies_on(paths[other], path)) continue;
      warnings.push_back({number, StrokeWarningKind::overlap, "overlaps stroke " + std::to_string(other + 1)});
    }
  }
  return warnings;
}

std::vector<CharacterWarnings> import_warnings(const ImportResult& import, int threads,
                                               const std::function<void(double)>& progress) {
  const std::vector<Character>& characters = import.list.characters;
  const SourceWarnings of_source = source_warnings(import.report);
  std::vector<std::vector<StrokeWarning>> warnings(characters.size());
  parallel_for(characters.size(), threads, progress, [&](std::size_t i) {
    warnings[i] = stroke_warnings(characters[i]);
    const auto found = of_source.find({characters[i].code, characters[i].order});
    if (found != of_source.end()) warnings[i] = merged(std::move(warnings[i]), found->second);
  });
  std::vector<CharacterWarnings> found;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    if (!warnings[i].empty()) found.push_back({characters[i].code, characters[i].order, std::move(warnings[i])});
  }
  return found;
}

}  // namespace calligraphy
