// A character as a sequence of typical strokes (Wang 2006, sec. 3.2, 3.5, Table 3).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>
#include <calligraphy/model/stroke_ink.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

/// Shape: the control points of all strokes, one stroke after the other.
struct StructuralData {
  std::vector<Point> control_points;  ///< adjacent elements of a stroke share one, adjacent strokes none [em]
};

/// Order: the typical strokes in writing order, their elements, and which control points are feature points.
struct SequenceData {
  std::vector<int> stroke_ids;        ///< typical stroke ids, in writing order
  std::vector<int> feature_points;    ///< indices into StructuralData::control_points, in writing order
  std::vector<ElementList> elements;  ///< of each stroke: as many as its typical stroke has, of the same or other kinds
};

/// Force: the attraction factor at each feature point, a multiple of the guidance stiffness [1]; and the width of the
/// brush, if known.
struct PhysicalData {
  std::vector<double> attraction_factors;  ///< one per feature point
  std::vector<StrokeInk> ink;              ///< of each stroke, or empty
};

/// One stroke of a character: a view, valid as long as the character.
struct Stroke {
  const TypicalStroke* type;                   ///< its entry of the stroke library; never null
  std::string_view elements;                   ///< its composition, a letter per element: "LCL"; in static storage
  int curve_degree;                            ///< of every CSE: 3, or 4 as printed in eq. (1)
  std::span<const Point> control_points;       ///< of its elements, which share their ends, in writing order [em]
  std::span<const double> attraction_factors;  ///< one per feature point [1]
  const StrokeInk* ink = nullptr;              ///< null if there is none
};

/// A character, with structural, sequence and physical data kept separate. Frame: em square, y up.
struct Character {
  char32_t code = 0;         ///< Unicode code point
  std::string order;         ///< name of an alternate stroke order; empty for the standard one
  int curve_degree = 3;      ///< degree of every CSE: 3, or 4 as printed in eq. (1)
  StructuralData structure;  ///< control points
  SequenceData sequence;     ///< strokes in writing order, their elements and feature points
  PhysicalData physics;      ///< attraction factors and ink

  /// Number of strokes.
  int stroke_count() const { return static_cast<int>(sequence.stroke_ids.size()); }
};

/// A stroke as input to make_character().
struct StrokeInput {
  int id;                                       ///< typical stroke id, 1 to 39
  std::vector<Point> control_points;            ///< of its elements, which share their ends, in writing order [em]
  std::vector<double> attraction_factors = {};  ///< one per feature point [1]; if empty, all 1
  ElementList elements = {};                    ///< as many as the typical stroke has; if empty, its own
  std::optional<StrokeInk> ink = std::nullopt;  ///< given for all strokes of a character or for none

  /// `elements`, or those of the typical stroke if empty. @throws ValueError if there is no such typical stroke
  ElementList composition() const { return elements.empty() ? ElementList(typical_stroke(id).elements) : elements; }
};

/// A stroke of a character as editable input. `elements` is empty if they are those of the typical stroke.
StrokeInput input_of(const Stroke& stroke);

/// Builds a character from its strokes in writing order.
/// @throws ValueError naming the stroke if an id, a count, a coordinate, a factor or a width is outside its domain
Character make_character(char32_t code, std::span<const StrokeInput> strokes, int curve_degree = 3);

/// The strokes of a valid character in writing order, as views into it. O(strokes).
std::vector<Stroke> strokes(const Character& character);

/// The same shape with quartic curves, as printed in eq. (1) (exact degree elevation).
Character with_quartic_curves(const Character& character);

/// A finding of validate().
struct ValidationIssue {
  int stroke;        ///< counted from 1; 0: the whole character
  std::string what;  ///< what is wrong, with the value
};

/// Everything that makes a character unusable: wrong counts, ids, compositions or indices, points that are not finite
/// or far outside the em square, missing factors, elements of zero length (except that a stroke of a single LSE may be
/// a point), joints that bend by more than 15 degrees although their typical stroke is smooth there, and ink that is
/// negative, beyond 1 em or not finite. Empty if the character is valid.
std::vector<ValidationIssue> validate(const Character& character);

}  // namespace calligraphy
