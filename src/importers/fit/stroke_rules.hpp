// The numbers that distinguish typical strokes (docs/strokes.md); private to the importers.
#pragma once

#include <span>
#include <vector>

#include "direction_range.hpp"
#include "stroke_piece.hpp"

namespace calligraphy::recognition {

inline constexpr Range any_direction{-180.0, 180.0};
inline constexpr Range any_bulge{-10.0, 10.0};
inline constexpr Range any_share{0.0, 1.0};

/// Expected shape of an element of a compound stroke.
struct ElementRule {
  Range direction;                 ///< of the chord [degree]
  Range share = any_share;         ///< fraction of the stroke's length [1]
  Range leaving = any_direction;   ///< [degree]
  Range arriving = any_direction;  ///< [degree]
  Range bulge = any_bulge;         ///< left of travel positive [1]
};

struct CompoundRule {
  int id;
  std::vector<ElementRule> elements;
};

/// The compound strokes as sequences of limbs. Ranges are those of Kai forms with some margin: values outside increase
/// the cost but are not forbidden, so that every path has a best stroke.
const std::vector<CompoundRule>& compound_rules();

/// Cost of interpreting a piece as this element of a compound stroke [em].
double cost_of(const ElementRule& rule, char kind, const Piece& piece, double stroke_length);

/// Cost of interpreting the path as one element, in competition with compound strokes [em].
double simple_cost(const Piece& piece, char kind, double stroke_length);

/// Resolves ambiguous strokes. Some paths fit two strokes equally well, and then the features measured here decide
/// instead of the cost: returns the id for a path recognised as `id` with elements that begin and end at `splits`.
int sibling_of(int id, const Path& path, std::span<const std::size_t> splits, bool brush);

}  // namespace calligraphy::recognition
