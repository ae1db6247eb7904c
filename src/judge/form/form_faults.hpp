// What is wrong with the form of strokes that were read: how they meet, cross and lie beside each other, their shapes
// and places.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <calligraphy/judge/stroke_remark.hpp>

#include "character_form.hpp"
#include "written_form.hpp"

namespace calligraphy {

/// A fault of form, in the coordinates of the character.
struct FormFault {
  StrokeRemarkKind kind = StrokeRemarkKind::place;
  std::size_t stroke = 0;
  std::optional<std::size_t> other = std::nullopt;
  StrokeEnd end = StrokeEnd::none;
  double amount = std::numeric_limits<double>::quiet_NaN();  ///< StrokeRemark::amount [em]
  double evidence = 0.0;                                     ///< StrokeRemark::evidence [1]
  Point place = Point::Zero();                               ///< where it is seen, on the writing [em]
  Point offset = Point::Zero();                              ///< StrokeRemark::offset [em]
  double length = std::numeric_limits<double>::quiet_NaN();  ///< over that of the stroke, beside the others [1]
  std::vector<std::size_t> strokes = {};                     ///< of a fault of the whole: those at fault
  bool is_shift = false;                                     ///< of a place: the stroke is as it should be otherwise
};

/// Every fault with evidence of at least `least`, not sorted: a fault of one stroke may show in several.
std::vector<FormFault> form_faults(const CharacterForm& form, const WrittenForm& written, double least);

}  // namespace calligraphy
