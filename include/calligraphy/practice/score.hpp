// Scores of a written page: one criterion per perceptible element, and every mistake with its reason (Wang 2006,
// sec. 2.2).
#pragma once

#include <string>
#include <vector>

#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// Kind of a mistake that a score counts.
enum class WritingMistakeKind {
  order,     ///< external sequence: a stroke was written out of order
  direction  ///< internal sequence: a stroke was written backwards
};

/// A mistake of the writer.
struct WritingMistake {
  WritingMistakeKind kind;  ///< of order or of direction
  int stroke;               ///< the expected stroke, from 0
  double time;              ///< of the pen-down [s]
  std::string reason;       ///< one line of explanation for people
};

/// Score of a written character.
struct CharacterScore {
  char32_t character = 0;  ///< its Unicode code point
  /// From the first pen-down (or the end of the previous character) to the end of the last stroke [s].
  double time = 0.0;
  double rms_error = 0.0;                ///< lateral, over the arc length of the completed strokes [m]
  double max_error = 0.0;                ///< lateral, over the same [m]
  int stroke_count = 0;                  ///< strokes of the character
  int strokes_completed = 0;             ///< of these, strokes that the writer finished
  double peak_force = 0.0;               ///< on the page (RecordedSample::force) [N]
  double max_force_step = 0.0;           ///< of that, from one tick to the next [N]
  std::vector<WritingMistake> mistakes;  ///< in the order of writing

  // The perceptible elements of Fig. 2, each in [0, 1].
  double contour = 0.0;            ///< exp(-rms error / 5 % of the em), in [0, 1]; 0 for strokes not completed
  double external_sequence = 0.0;  ///< completed strokes / (completed + order mistakes), in [0, 1]
  double internal_sequence = 0.0;  ///< completed strokes / (completed + direction mistakes), in [0, 1]
  double fidelity = 0.0;           ///< geometric mean of the three, in [0, 1]

  /// Number of strokes written out of order.
  int order_mistakes() const noexcept;
  /// Number of strokes written backwards.
  int direction_mistakes() const noexcept;
};

/// One score per character of the page.
std::vector<CharacterScore> score_page(const PracticePage& page, const Recording& recording);

}  // namespace calligraphy
