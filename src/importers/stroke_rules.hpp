// The numbers by which typical strokes are told apart; private to the model. docs/strokes.md has them in words.
#pragma once

#include <span>
#include <vector>

#include "direction_range.hpp"
#include "stroke_piece.hpp"

namespace calligraphy::recognition {

inline constexpr Range any_direction{-180.0, 180.0};
inline constexpr Range any_bulge{-10.0, 10.0};
inline constexpr Range any_share{0.0, 1.0};

/// What an element of a compound stroke must look like.
struct ElementRule {
  Range direction;                 ///< of the chord [degree]
  Range share = any_share;         ///< of the stroke's length [1]
  Range leaving = any_direction;   ///< [degree]
  Range arriving = any_direction;  ///< [degree]
  Range bulge = any_bulge;         ///< left of travel positive [1]
};

struct CompoundRule {
  int id;
  std::vector<ElementRule> elements;
};

/// The compound strokes as sequences of limbs. Ranges are those of Kai forms with some slack: what lies outside is
/// dearer, not forbidden, so that every path has a best stroke.
const std::vector<CompoundRule>& compound_rules();

/// Cost of a piece as this element of a compound stroke [em].
double cost_of(const ElementRule& rule, char kind, const Piece& piece, double stroke_length);

/// Cost of the path as one element, with which compound strokes compete [em].
double simple_cost(const Piece& piece, char kind, double stroke_length);

/// Some curves follow two strokes equally well, and then what is measured here decides and not the cost: the stroke
/// that a path found to be `id`, with elements that begin and end at `splits`, really is.
int sibling_of(int id, const Path& path, std::span<const std::size_t> splits, bool brush);

}  // namespace calligraphy::recognition
