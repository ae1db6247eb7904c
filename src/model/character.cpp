#include <calligraphy/model/character.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/bezier.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr double max_coordinate = 16.0;                   // [em]; far outside any em square, far inside double's range
constexpr double smooth_angle = std::numbers::pi / 12.0;  // maximum bend at a smooth joint [rad]
constexpr double min_element = 1e-6;                      // [em]

std::string format_point(const Point& point) {
  return "(" + number_text(point.x()) + ", " + number_text(point.y()) + ")";
}

bool known_degree(int degree) { return degree == 3 || degree == 4; }

/// Direction in which a curve leaves its first control point; zero if all control points coincide.
Point leaving_direction(std::span<const Point> points) {
  for (const Point& point : points.subspan(1)) {
    const Point difference = point - points.front();
    if (difference.norm() > min_element) return difference.normalized();
  }
  return Point::Zero();
}

Point arriving_direction(std::span<const Point> points) {
  std::vector<Point> reversed(points.rbegin(), points.rend());
  return -leaving_direction(reversed);
}

void validate_ink(const Stroke& stroke, int number, std::vector<ValidationIssue>& problems) {
  const StrokeInk& ink = *stroke.ink;
  const auto [knots, corners] = ink_size(*stroke.type, stroke.elements);
  const auto check = [&](double value, double least, const char* name) {
    if (value >= least && value <= max_ink_length) return;  // false for NaN
    problems.push_back({number, std::string(name) + " of ink " + number_text(value) + " em is not within " +
                                    number_text(least) + " and " + number_text(max_ink_length)});
  };
  check(ink.start, 0.0, "start");
  check(ink.end, 0.0, "end");
  const auto check_all = [&](std::span<const double> values, std::size_t count, double least, const char* name) {
    for (const double value : values.first(count)) check(value, least, name);
    for (const double value : values.subspan(count)) {
      if (value == 0.0) continue;
      problems.push_back({number, std::string(name) + " of ink " + number_text(value) + " em follows the last of " +
                                      std::to_string(count) + ", which this stroke has"});
    }
  };
  check_all(ink.half_widths, knots, 0.0, "half-width");
  check_all(ink.offsets, knots, -max_ink_length, "offset");
  check_all(ink.shifts, corners, -max_ink_length, "shift");
}

void validate_stroke(const Stroke& stroke, int number, std::vector<ValidationIssue>& problems) {
  bool finite = true;
  for (const Point& point : stroke.control_points) {
    if (point.allFinite() && point.cwiseAbs().maxCoeff() <= max_coordinate) continue;
    problems.push_back({number, "control point " + format_point(point) + " is not within 16 em of the origin"});
    finite = false;
  }
  for (const double factor : stroke.attraction_factors) {
    if (std::isfinite(factor) && factor >= 0.0) continue;
    problems.push_back(
        {number, "attraction factor " + number_text(factor) + " is not a finite, non-negative number"});
  }
  if (stroke.ink != nullptr) validate_ink(stroke, number, problems);
  if (!finite) return;

  const std::vector<int> ends = feature_points(stroke.elements, stroke.curve_degree);
  Point arriving = Point::Zero();
  for (std::size_t element = 0; element + 1 < ends.size(); ++element) {
    const auto points = stroke.control_points.subspan(static_cast<std::size_t>(ends[element]),
                                                      static_cast<std::size_t>(ends[element + 1] - ends[element] + 1));
    const Point leaving = leaving_direction(points);
    const bool may_be_point = stroke.elements == "L";  // "line segment stroke include points" (sec. 3.3)
    if (leaving.isZero() && !may_be_point) {
      problems.push_back({number, "element " + std::to_string(element + 1) + " has zero length"});
    } else if (element > 0 && is_smooth_joint(*stroke.type, stroke.elements, element - 1) && !arriving.isZero()) {
      const double cosine = std::clamp(arriving.dot(leaving), -1.0, 1.0);
      if (std::acos(cosine) > smooth_angle) {
        problems.push_back({number, "the joint after element " + std::to_string(element) + " bends by " +
                                        std::to_string(std::lround(std::acos(cosine) * 180.0 / std::numbers::pi)) +
                                        " degrees, but typical stroke " + std::to_string(stroke.type->id) +
                                        " is smooth there"});
      }
    }
    arriving = arriving_direction(points);
  }
}

/// "typical stroke 31 (LLLL)", or "typical stroke 31" if the composition goes without saying.
std::string type_label(const TypicalStroke& type, ElementList elements) {
  const std::string label = "typical stroke " + std::to_string(type.id);
  return elements == type.elements ? label : label + " (" + std::string(elements.elements()) + ")";
}

/// Empty if a stroke of this type may have these elements, that is, as many as the typical stroke has.
std::string composition_error(const TypicalStroke& type, ElementList elements) {
  if (elements.size() == type.elements.size()) return {};
  return "typical stroke " + std::to_string(type.id) + " is " + std::string(type.elements) +
         "; a stroke of this type has as many elements, not '" + std::string(elements.elements()) + "'";
}

}  // namespace

StrokeInput input_of(const Stroke& stroke) {
  return {stroke.type->id,
          {stroke.control_points.begin(), stroke.control_points.end()},
          {stroke.attraction_factors.begin(), stroke.attraction_factors.end()},
          stroke.elements == stroke.type->elements ? ElementList() : ElementList(stroke.elements),
          stroke.ink == nullptr ? std::nullopt : std::optional(*stroke.ink)};
}

Character make_character(char32_t code, std::span<const StrokeInput> inputs, int curve_degree) {
  if (!known_degree(curve_degree)) {
    throw ValueError("curve degree " + std::to_string(curve_degree) + ": expected 3 or 4");
  }
  Character character;
  character.code = code;
  character.curve_degree = curve_degree;
  character.sequence.stroke_ids.reserve(inputs.size());
  character.sequence.elements.reserve(inputs.size());
  int number = 0;
  for (const StrokeInput& input : inputs) {
    const std::string place = "stroke " + std::to_string(++number) + ": ";
    if (input.id < 1 || input.id > typical_stroke_count) {
      throw ValueError(place + "typical stroke id " + std::to_string(input.id) + ": expected 1 to 39");
    }
    const TypicalStroke& type = typical_stroke(input.id);
    const ElementList elements = input.composition();
    if (const std::string error = composition_error(type, elements); !error.empty()) throw ValueError(place + error);
    const auto expected = static_cast<std::size_t>(control_point_count(elements, curve_degree));
    if (input.control_points.size() != expected) {
      const auto as_printed = static_cast<std::size_t>(control_point_count(type.as_printed(), curve_degree));
      const bool is_printed = expected != as_printed && input.control_points.size() == as_printed;
      throw ValueError(place + type_label(type, elements) + " takes " + std::to_string(expected) +
                       " control points, not " + std::to_string(input.control_points.size()) +
                       (is_printed ? ", unless its elements are " + std::string(type.as_printed()) : ""));
    }
    const auto features = static_cast<std::size_t>(feature_point_count(elements));
    if (!input.attraction_factors.empty() && input.attraction_factors.size() != features) {
      throw ValueError(place + type_label(type, elements) + " takes " + std::to_string(features) +
                       " attraction factors, not " + std::to_string(input.attraction_factors.size()));
    }

    auto& points = character.structure.control_points;
    const int first = static_cast<int>(points.size());
    points.insert(points.end(), input.control_points.begin(), input.control_points.end());
    character.sequence.stroke_ids.push_back(input.id);
    character.sequence.elements.push_back(elements);
    for (const int index : feature_points(elements, curve_degree)) {
      character.sequence.feature_points.push_back(first + index);
    }
    auto& factors = character.physics.attraction_factors;
    if (input.attraction_factors.empty()) {
      factors.insert(factors.end(), features, 1.0);
    } else {
      factors.insert(factors.end(), input.attraction_factors.begin(), input.attraction_factors.end());
    }
    if (input.ink.has_value() != inputs[0].ink.has_value()) {
      throw ValueError(place + (input.ink ? "has ink" : "has no ink") + ", unlike stroke 1");
    }
    if (input.ink) character.physics.ink.push_back(*input.ink);
  }
  const std::vector<ValidationIssue> problems = validate(character);
  if (!problems.empty()) {
    throw ValueError((problems[0].stroke > 0 ? "stroke " + std::to_string(problems[0].stroke) + ": " : std::string()) +
                     problems[0].what);
  }
  return character;
}

std::vector<Stroke> strokes(const Character& character) {
  std::vector<Stroke> views;
  const std::span<const Point> points(character.structure.control_points);
  const std::span<const double> factors(character.physics.attraction_factors);
  std::size_t first_point = 0;
  std::size_t first_factor = 0;
  for (std::size_t i = 0; i < character.sequence.stroke_ids.size(); ++i) {
    const ElementList elements = character.sequence.elements[i];
    const auto point_count = static_cast<std::size_t>(control_point_count(elements, character.curve_degree));
    const auto factor_count = static_cast<std::size_t>(feature_point_count(elements));
    views.push_back({&typical_stroke(character.sequence.stroke_ids[i]), elements.elements(), character.curve_degree,
                     points.subspan(first_point, point_count), factors.subspan(first_factor, factor_count),
                     character.physics.ink.empty() ? nullptr : &character.physics.ink[i]});
    first_point += point_count;
    first_factor += factor_count;
  }
  return views;
}

Character with_quartic_curves(const Character& character) {
  if (character.curve_degree == 4) return character;
  std::vector<StrokeInput> inputs;
  for (const Stroke& stroke : strokes(character)) {
    StrokeInput input = input_of(stroke);
    input.control_points.resize(1);
    std::size_t at = 0;
    for (const char kind : stroke.elements) {
      if (kind == static_cast<char>(ElementKind::line)) {
        input.control_points.push_back(stroke.control_points[++at]);
        continue;
      }
      const auto& p = stroke.control_points;
      const Bezier<4> quartic = Bezier<3>{{p[at], p[at + 1], p[at + 2], p[at + 3]}}.elevated();
      input.control_points.insert(input.control_points.end(), quartic.control_points.begin() + 1,
                                  quartic.control_points.end());
      at += 3;
    }
    inputs.push_back(std::move(input));
  }
  Character result = make_character(character.code, inputs, 4);
  result.order = character.order;
  return result;
}

std::vector<ValidationIssue> validate(const Character& character) {
  std::vector<ValidationIssue> problems;
  if (!known_degree(character.curve_degree)) {
    return {{0, "curve degree " + std::to_string(character.curve_degree) + ": expected 3 or 4"}};
  }
  if (character.sequence.stroke_ids.empty()) return {{0, "there is no stroke"}};

  const std::vector<int>& ids = character.sequence.stroke_ids;
  const std::vector<ElementList>& compositions = character.sequence.elements;
  if (compositions.size() != ids.size()) {
    return {{0, std::to_string(ids.size()) + " strokes have " + std::to_string(compositions.size()) + " compositions"}};
  }
  std::vector<int> indices;
  int points = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    if (ids[i] < 1 || ids[i] > typical_stroke_count) {
      return {{number, "typical stroke id " + std::to_string(ids[i]) + ": expected 1 to 39"}};
    }
    const TypicalStroke& type = typical_stroke(ids[i]);
    std::string error = composition_error(type, compositions[i]);
    if (!error.empty()) return {{number, std::move(error)}};
    for (const int index : feature_points(compositions[i], character.curve_degree)) indices.push_back(points + index);
    points += control_point_count(compositions[i], character.curve_degree);
  }
  if (static_cast<int>(character.structure.control_points.size()) != points) {
    problems.push_back({0, "the strokes take " + std::to_string(points) + " control points, not " +
                               std::to_string(character.structure.control_points.size())});
  }
  if (character.sequence.feature_points != indices) {
    problems.push_back({0, "the feature point indices do not match the strokes"});
  }
  if (character.physics.attraction_factors.size() != indices.size()) {
    problems.push_back({0, std::to_string(indices.size()) + " feature points have " +
                               std::to_string(character.physics.attraction_factors.size()) + " attraction factors"});
  }
  if (const std::size_t inks = character.physics.ink.size(); inks != 0 && inks != ids.size()) {
    problems.push_back({0, std::to_string(ids.size()) + " strokes have the ink of " + std::to_string(inks)});
  }
  if (!problems.empty()) return problems;

  int number = 0;
  for (const Stroke& stroke : strokes(character)) validate_stroke(stroke, ++number, problems);
  return problems;
}

}  // namespace calligraphy
