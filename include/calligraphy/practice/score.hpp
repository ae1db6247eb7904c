// Scores of a written page: what was written of each stroke, how far off, and every mistake with its reason (Wang 2006,
// sec. 2.2).
#pragma once

#include <limits>
#include <span>
#include <vector>

#include <calligraphy/judge/pen_kinematics.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/judge/writing_motion.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// A quantity that was not measured.
inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// What was written of a stroke of the character.
struct StrokeScore {
  int pen_down = -1;       ///< the first one that wrote it, an index into MatchResult::drawn; -1: none
  bool completed = false;  ///< the session took it for finished
  /// Share of its length that was written in order, wherever the writing lies; 0 if it was written backwards [1].
  double coverage = 0.0;
  double rms_error = not_measured;  ///< distance of the pen from the stroke, over the length of the pen's path [m]
  double max_error = not_measured;  ///< the largest distance of the pen from the stroke [m]
  /// `rms_error` with what was left out: the rest of the stroke, over its length, as far as it is from what was written
  /// of it. Of a stroke that was not written, all of it, as far as it is from the strokes that were. What was left out
  /// of a stroke is never nearer than the `rms_error` of what was written of it [m].
  double overall_error = not_measured;
  double dtw_distance = not_measured;  ///< dtw_distance() of what was written of it from the stroke [m]
};

/// One pen-down of a character.
struct PenDownScore {
  PenKinematics motion;                 ///< in metres
  double mean_pressure = not_measured;  ///< mean force across the paper (CharacterScore::mean_pressure) [N]
};

/// Score of a written character. What was not measured is NaN: errors where no stroke was written, the time of a
/// character that was not completed.
struct CharacterScore {
  char32_t character = 0;  ///< its Unicode code point
  /// From the first pen-down to the tick in which the session took the last stroke for finished; NaN unless the
  /// character was completed [s].
  double time = not_measured;
  double rms_error = not_measured;  ///< of the strokes written: distance of the pen, over the length of its path [m]
  double max_error = not_measured;  ///< of the strokes written: the largest distance of the pen [m]
  /// `rms_error` with what was left out, of all strokes (StrokeScore::overall_error): a character that was broken off
  /// gains less by it. NaN if none was written [m].
  double overall_error = not_measured;
  double coverage = 0.0;      ///< share of the length of all strokes that was written in order [1]
  int stroke_count = 0;       ///< strokes of the character
  int strokes_written = 0;    ///< of these, strokes that a pen-down wrote, wholly or for the most part
  int strokes_completed = 0;  ///< of these, strokes that the session took for finished
  int lost_samples = 0;       ///< without a usable position (TickStatus) while the character was active; left out
  WritingMotion motion;       ///< of all pen-downs, in metres
  double dtw_distance = not_measured;  ///< mean of those of the strokes written [m]
  /// Mean force across the paper over the samples with the pen on it: how hard the pen is pressed. NaN where no force
  /// was rendered, as with vision alone [N].
  double mean_pressure = not_measured;
  double peak_force = 0.0;              ///< on the page, while the character was active (RecordedSample::force) [N]
  double max_force_step = 0.0;          ///< of that, from one tick to the next [N]
  MatchResult match;                    ///< what each pen-down wrote, and every mistake
  std::vector<PenDownScore> pen_downs;  ///< of those in `match`
  std::vector<StrokeScore> strokes;     ///< one per stroke of the character

  // The perceptible elements of Fig. 2, each in [0, 1]. A stroke that was not written counts as 0 in each.
  /// Mean of exp(-StrokeScore::overall_error / 5 % of the em) over all strokes.
  double contour = 0.0;
  double external_sequence = 0.0;  ///< strokes written in order / (all strokes + extra pen-downs)
  double internal_sequence = 0.0;  ///< strokes not written backwards / all strokes
  double fidelity = 0.0;           ///< geometric mean of the three

  /// Number of remarks on strokes written out of order; strokes that were joined have one.
  int order_mistakes() const noexcept { return match.count(StrokeRemarkKind::order); }
  /// Number of remarks on strokes written backwards; strokes that were joined have one.
  int direction_mistakes() const noexcept { return match.count(StrokeRemarkKind::direction); }
};

/// One score per character of the page. A pen-down belongs to the character in whose square it lies, or to the nearest;
/// which of its strokes it wrote, in which order and direction, match_strokes() tells. A character that was broken off
/// is matched as though the strokes still to come had been written in their places. Distances are those on the page,
/// without the alignment by which match_strokes() recognises what is meant.
/// @throws ValueError when the page or a tolerance is invalid, when the recording was made on another page
/// (Recording::page, or events that this page cannot have had), when its time runs backwards, or as match_strokes()
std::vector<CharacterScore> score_page(const PracticePage& page, const Recording& recording,
                                       const JudgeTolerances& tolerances = {});

/// Means over characters, and over how much of them.
struct MeanScore {
  double rms_error = not_measured;      ///< over the characters of which a stroke was written [m]
  double overall_error = not_measured;  ///< over the same, what was left out included [m]
  double coverage = not_measured;       ///< over all characters [1]
  int characters = 0;                   ///< all of them
  int characters_written = 0;           ///< those of which a stroke was written
  int stroke_count = 0;                 ///< strokes of all characters
  int strokes_written = 0;              ///< of these, those over which `rms_error` is
};

/// The mean of scores: of a page, or of one character written several times.
MeanScore mean_score(std::span<const CharacterScore> scores);

}  // namespace calligraphy
