// Warnings about strokes that are valid but look wrong.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// What looks wrong about a stroke.
enum class StrokeWarningKind {
  type,       ///< it has the shape of another typical stroke
  direction,  ///< it starts against the direction in which its typical stroke is written
  overlap,    ///< it lies on another stroke
  outside,    ///< it leaves the em square
  label,      ///< the drawing contradicts its label, or the label is unknown
  fold,       ///< it, or its drawing, runs back on itself
  crossing,   ///< it does not cross a stroke that it crosses in the drawing
  length,     ///< it is much shorter or longer than the drawing, or a median than its outline
  corner,     ///< it has a corner that the drawing lacks, or lacks one
  distance    ///< it is far from the drawing
};

/// "type", "direction", and so on.
const char* to_string(StrokeWarningKind kind) noexcept;

/// A warning about one stroke.
struct StrokeWarning {
  int stroke;              ///< from 1
  StrokeWarningKind kind;  ///< what looks wrong
  std::string what;        ///< a description, with the values
};

/// Angle between the chord of a stroke's first element and that of its typical stroke [rad], 0 to pi; 0 if one of them
/// is too short to have a direction.
double start_direction_error(const Stroke& stroke);

/// Checks type, direction, overlap and em square of every stroke of a valid character; docs/import.md lists the
/// thresholds. The type is doubted if geometry alone recognises the curve of the stroke as another and the curve is
/// clearly not of the recorded one. O(strokes^2), about one fit per stroke.
std::vector<StrokeWarning> stroke_warnings(const Character& character);

/// The warnings about the strokes of one character.
struct CharacterWarnings {
  char32_t code;                        ///< Unicode code point
  std::string order;                    ///< name of the stroke order; empty for the standard one
  std::vector<StrokeWarning> warnings;  ///< at least one
};

/// The characters with warnings, in the order of the list, from `threads` threads (0: one per core): those of
/// stroke_warnings() and, of a source that was measured (ImportOptions::report), label, fold, crossing, length, corner
/// and distance. A label that contradicts the drawing makes a warning about the type redundant. `progress` is called
/// with the fraction done, in the calling thread.
std::vector<CharacterWarnings> import_warnings(const ImportResult& import, int threads = 0,
                                               const std::function<void(double)>& progress = {});

}  // namespace calligraphy
