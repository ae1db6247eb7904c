// Warnings about strokes that are valid but look wrong.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

enum class StrokeWarningKind {
  type,       ///< it has the shape of another typical stroke
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

/// Angle between the chord of a stroke's first element and that of its typical stroke [rad], 0 to pi; 0 if one of them
/// is too short to have a direction.
double start_direction_error(const Stroke& stroke);

/// Checks every stroke of a valid character; docs/import.md lists the thresholds. The type is questioned if geometry
/// alone recognises the curve of the stroke as another type, unless the two differ only in degree (as pie and short
/// pie) or the stroke is a dot. O(strokes^2), about one fit per stroke.
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
