// Scores of a written page: how much of each stroke was written, how accurately, and every mistake with its reason
// (Wang 2006, sec. 2.2).
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

/// Score of one stroke of a character.
struct StrokeScore {
  int pen_down = -1;       ///< index into MatchResult::drawn of the first pen-down that wrote it; -1: none
  bool completed = false;  ///< whether the session counted it as finished
  /// Share of its length written in order, wherever the writing lies; 0 if it was written backwards [1].
  double coverage = 0.0;
  double rms_error = not_measured;  ///< RMS distance of the pen from the stroke, over the length of the pen's path [m]
  double max_error = not_measured;  ///< largest distance of the pen from the stroke [m]
  /// `rms_error` with the unwritten part included: it counts, over its length, with its distance from what was written
  /// of the stroke, or with `rms_error` where that is more. A stroke that was not written at all counts with its
  /// distance from the strokes that were [m].
  double overall_error = not_measured;
  double dtw_distance = not_measured;  ///< dtw_distance() between the stroke and what was written of it [m]
};

/// One pen-down of a character.
struct PenDownScore {
  PenKinematics motion;                 ///< motion of the pen, in metres
  double mean_pressure = not_measured;  ///< mean force normal to the paper (CharacterScore::mean_pressure) [N]
};

/// Score of a written character. Quantities that were not measured are NaN: errors if no stroke was written, the time
/// if the character was not completed.
struct CharacterScore {
  char32_t character = 0;  ///< its Unicode code point
  /// From the first pen-down to the tick in which the pen finished the last stroke or left it; NaN unless the character
  /// was completed [s].
  double time = not_measured;
  double rms_error = not_measured;  ///< RMS distance of the pen from the strokes written, over its path length [m]
  double max_error = not_measured;  ///< largest distance of the pen from the strokes written [m]
  /// `rms_error` over all strokes, unwritten parts included (StrokeScore::overall_error), so that breaking a character
  /// off gains less. NaN if no stroke was written [m].
  double overall_error = not_measured;
  double coverage = 0.0;      ///< share of the length of all strokes that was written in order [1]
  int stroke_count = 0;       ///< strokes of the character
  int strokes_written = 0;    ///< of these, the ones written, wholly or for the most part
  int strokes_completed = 0;  ///< of these, the ones that the session counted as finished
  int lost_samples = 0;       ///< samples without a usable position (TickStatus) while it was active; left out
  WritingMotion motion;       ///< motion over all pen-downs, in metres
  double dtw_distance = not_measured;  ///< mean StrokeScore::dtw_distance of the strokes written [m]
  /// Mean force normal to the paper while the pen is on it: how hard the pen is pressed. NaN if no force was rendered,
  /// as with vision alone [N].
  double mean_pressure = not_measured;
  double peak_force = 0.0;              ///< largest RecordedSample::force while the character was active [N]
  double max_force_step = 0.0;          ///< largest change of that force from one tick to the next [N]
  MatchResult match;                    ///< what each pen-down wrote, and every mistake
  std::vector<PenDownScore> pen_downs;  ///< one per pen-down in `match`
  std::vector<StrokeScore> strokes;     ///< one per stroke of the character

  // The perceptible elements of Fig. 2, each in [0, 1]. A stroke that was not written counts as 0 in each.
  /// Mean of exp(-StrokeScore::overall_error / 5 % of the em) over all strokes.
  double contour = 0.0;
  double external_sequence = 0.0;  ///< strokes written in order / (all strokes + extra pen-downs)
  double internal_sequence = 0.0;  ///< strokes not written backwards / all strokes
  double fidelity = 0.0;           ///< geometric mean of the three

  /// Number of remarks on strokes written out of order; joined strokes share one.
  int order_mistakes() const noexcept { return match.count(StrokeRemarkKind::order); }
  /// Number of remarks on strokes written backwards; joined strokes share one.
  int direction_mistakes() const noexcept { return match.count(StrokeRemarkKind::direction); }
};

/// One score per character of the page. A pen-down belongs to the character in whose square it lies, or to the nearest;
/// match_strokes() determines which of its strokes it wrote, in which order and direction. A character that was broken
/// off is matched as though its remaining strokes had been written in their places. Distances are measured on the page,
/// without the alignment by which match_strokes() recognises what was meant.
/// @throws ValueError when the page or a tolerance is invalid, when the recording was made on another page
/// (Recording::page, or events that are impossible on this page), when its time runs backwards, or as match_strokes()
std::vector<CharacterScore> score_page(const PracticePage& page, const Recording& recording,
                                       const JudgeTolerances& tolerances = {});

/// Means over characters, and the numbers of characters and strokes behind them.
struct MeanScore {
  double rms_error = not_measured;      ///< over characters with at least one stroke written [m]
  double overall_error = not_measured;  ///< over the same characters, unwritten parts included [m]
  double coverage = not_measured;       ///< over all characters [1]
  int characters = 0;                   ///< number of characters
  int characters_written = 0;           ///< of these, the ones with at least one stroke written
  int stroke_count = 0;                 ///< strokes of all characters
  int strokes_written = 0;              ///< of these, the ones written, which `rms_error` covers
};

/// Mean of the scores of a page, or of one character written several times.
MeanScore mean_score(std::span<const CharacterScore> scores);

}  // namespace calligraphy
