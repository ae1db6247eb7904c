// Strokes that are valid and yet look wrong.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

enum class DoubtKind {
  type,       ///< the shape is that of another typical stroke
  direction,  ///< it starts against the direction in which its typical stroke is written
  overlap,    ///< it lies on another stroke
  outside     ///< it leaves the em square
};

/// "type", "direction", "overlap", "outside".
const char* name_of(DoubtKind kind) noexcept;

struct Doubt {
  int stroke;  ///< from 1
  DoubtKind kind;
  std::string what;
};

/// How far the chord of a stroke's first element is turned from that of its typical stroke [rad], 0 to pi; 0 where one
/// of them is too short to have a direction.
double turn_from_typical_start(const Stroke& stroke);

/// Looks at every stroke of a valid character; docs/import.md has the bounds. A type is doubted when geometry alone
/// recognises another in the stroke's own curve, unless the two differ by a matter of degree (as pie and short pie) or
/// the stroke is a dot. O(strokes^2), about a fit per stroke.
std::vector<Doubt> doubtful_strokes(const Character& character);

}  // namespace calligraphy
