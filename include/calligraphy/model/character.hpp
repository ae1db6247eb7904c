// A character as a sequence of typical strokes (Wang 2006, sec. 3.2, 3.5, Table 3).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

/// Shape: the control points of all strokes, one stroke after the other [em].
struct StructuralData {
  std::vector<Point> control_points;
};

/// Order: which typical stroke is written when, and which control points are feature points.
struct SequenceData {
  std::vector<int> stroke_ids;      ///< typical stroke ids, in writing order
  std::vector<int> feature_points;  ///< indices into StructuralData::control_points, in writing order
};

/// Feel: the force attraction factor at each feature point, a multiple of the guidance stiffness [1].
struct PhysicalData {
  std::vector<double> attraction_factors;  ///< one per feature point
};

/// One stroke of a character, as a view that lives as long as the character.
struct Stroke {
  const TypicalStroke* type;
  int curve_degree;
  std::span<const Point> control_points;       ///< [em]
  std::span<const double> attraction_factors;  ///< one per feature point [1]
};

/// A character: structural, sequence and physical data apart from each other. Frame: em square, y up.
struct Character {
  char32_t code = 0;     ///< Unicode code point
  std::string order;     ///< name of an alternate stroke order; empty for the standard one
  int curve_degree = 3;  ///< degree of every CSE: 3, or 4 as eq. (1) prints
  StructuralData structure;
  SequenceData sequence;
  PhysicalData physics;

  int stroke_count() const { return static_cast<int>(sequence.stroke_ids.size()); }
};

/// A stroke as input to make_character: control points [em], and a factor per feature point (none: all 1).
struct StrokeInput {
  int id;
  std::vector<Point> control_points;
  std::vector<double> attraction_factors = {};
};

/// Builds a character from its strokes in writing order.
/// @throws ValueError naming the stroke when an id, a count, a coordinate or a factor is out of its domain
Character make_character(char32_t code, std::span<const StrokeInput> strokes, int curve_degree = 3);

/// The strokes of a valid character in writing order; the views point into it. O(strokes).
std::vector<Stroke> strokes(const Character& character);

/// The same shape with quartic curves, as eq. (1) prints (exact degree elevation).
Character with_quartic_curves(const Character& character);

/// What a validator has to say: where (stroke, counted from 1; 0 for the character as a whole) and what.
struct ValidationIssue {
  int stroke;
  std::string what;
};

/// Everything that makes a character unusable: counts, ids, indices, non-finite or far-off points, missing factors,
/// elements without length (but a stroke of a single LSE may be a point), a joint that its typical stroke calls smooth
/// and that bends by more than 15 degrees. Empty when the character is valid.
std::vector<ValidationIssue> validate(const Character& character);

}  // namespace calligraphy
