// The score of a lesson: of what was written in the end, apart from the attempts.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/language.hpp>
#include <calligraphy/judge/stroke_remark.hpp>
#include <calligraphy/model/character.hpp>
#include <calligraphy/practice/lesson_event.hpp>
#include <calligraphy/practice/lesson_view.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/score.hpp>

namespace calligraphy {

/// What is judged of a lesson, on its own: another thread may score it (Lesson::writing()).
struct LessonWriting {
  PracticePage page;                  ///< that was written
  std::vector<LessonStroke> strokes;  ///< of the page, and what became of them
  /// The pen-downs that wrote the accepted strokes, each from the touch to the lift. Between two of them pass at least
  /// 52 ms, so that a quick one is not taken for a bounce; no ink that was refused is among them.
  Recording recording;
  std::vector<Point> hands;           ///< where the pupil's own hand was in each of its samples; empty: not known [m]
  std::vector<LessonEvent> attempts;  ///< the pen-downs that were refused (LessonEventKind::refused)
};

/// What a remark of a lesson is about.
enum class LessonRemarkKind {
  skipped,  ///< strokes that were passed over
  written,  ///< what was written in the end
  attempts  ///< pen-downs that were refused
};

/// "skipped", "written", "attempts".
const char* to_string(LessonRemarkKind kind) noexcept;

/// A remark on a character, in which those of a kind are one.
struct LessonRemark {
  LessonRemarkKind kind = LessonRemarkKind::written;  ///< what it is about
  StrokeRemark remark;                         ///< on what was written: the gravest of those that are one
  RefusalReason reason = RefusalReason::none;  ///< why attempts were refused
  int count = 1;             ///< number of strokes skipped, of remarks that are one, or of attempts
  std::vector<int> strokes;  ///< that it is about besides those of `remark`, from 0
  Point place = Point::Zero();  ///< where to point, in the square of the character [em]
};

/// How many remarks a pupil should hear at once: the others on request.
inline constexpr int usual_remarks = 3;

/// Score of a character of a lesson.
struct LessonScore {
  /// Of the pupil's own hand where it is known; otherwise of the pen, which was guided.
  CharacterScore score;
  double guided_error = not_measured;  ///< CharacterScore::rms_error of the pen, if the hand is known [m]
  int accepted = 0;                    ///< number of strokes that were written
  int skipped = 0;                     ///< number of strokes that were passed over
  int right_at_once = 0;               ///< number of strokes that were accepted without a miss
  std::vector<int> pen_downs;          ///< number in the lesson of each pen-down of `score`
  std::vector<LessonRemark> remarks;   ///< the gravest first
};

/// Scores each character of a lesson's page. A stroke that was skipped is told as skipped, and counts as one that was
/// not written. Takes as long as score_page(), twice where the hand is known.
/// @throws ValueError as score_page()
std::vector<LessonScore> score_lesson(const LessonWriting& writing, const JudgeTolerances& tolerances = {});

/// A remark in words. `character`: MatchResult::character of the score.
/// @throws ValueError as remark_text()
std::string lesson_remark_text(const LessonRemark& remark, const Character& character, const Language& language = {});

}  // namespace calligraphy
