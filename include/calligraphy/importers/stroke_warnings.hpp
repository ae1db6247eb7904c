// Strokes that are valid and yet look wrong.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

enum class StrokeWarningKind {
  type,       ///< the shape is that of another typical stroke
  direction,  ///< it starts against the direction in which its typical stroke is written
  overlap,    ///< it lies on another stroke
  outside     ///< it leaves the em square
};

/// "type", "direction", "overlap", "outside".
const char* to_string(StrokeWarningKind kind) noexcept;

struct StrokeWarning {
  int stroke;  ///< from 1
  StrokeWarningKind kind;
  std::string what;
};

/// How far the chord of a stroke's first element is turned from that of its typical stroke [rad], 0 to pi; 0 where one
/// of them is too short to have a direction.
double start_direction_error(const Stroke& stroke);

/// Looks at every stroke of a valid character; docs/import.md has the bounds. A type is doubted when geometry alone
/// recognises another in the stroke's own curve, unless the two differ by a matter of degree (as pie and short pie) or
/// the stroke is a dot. O(strokes^2), about a fit per stroke.
std::vector<StrokeWarning> stroke_warnings(const Character& character);

struct CharacterWarnings {
  char32_t code;
  std::string order;  ///< empty for the standard one
  std::vector<StrokeWarning> warnings;
};

/// The characters with stroke warnings, in the order given, from `threads` threads (0: one per core). `progress` hears
/// the share that is done, in the calling thread.
std::vector<CharacterWarnings> character_warnings(std::span<const Character> characters, int threads = 0,
                                                  const std::function<void(double)>& progress = {});

}  // namespace calligraphy
