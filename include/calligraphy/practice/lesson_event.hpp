// What happens in a lesson, and what is asked of it.
#pragma once

#include <cstdint>
#include <string>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/model/point.hpp>
#include <calligraphy/render/haptic_tick.hpp>

namespace calligraphy {

/// Kind of an event of a lesson.
enum class LessonEventKind : std::uint8_t {
  begun,     ///< the first stretch of a stroke was written
  accepted,  ///< a stroke was written
  refused,   ///< a pen-down did not write the stroke that is due: a miss
  ignored,   ///< a pen-down was no writing, such as a bounce or a palm: it does not count
  hinted,    ///< a hint has lasted long enough to be given
  shown,     ///< the stroke that is due is shown, and written once
  skipped,   ///< a stroke was passed over
  undone,    ///< a stroke that was accepted or skipped is due again
  declined,  ///< a command could not be carried out: nothing is left to skip or to show, or nothing to undo
  restarted,  ///< a page has been begun, again or for the first time
  finished   ///< every stroke of the page was accepted or skipped, and the pen lifted
};

/// "begun", "accepted", "refused", "ignored", "hinted", "shown", "skipped", "undone", "declined", "restarted",
/// "finished".
const char* to_string(LessonEventKind kind) noexcept;

/// Why a pen-down did not write the stroke that is due.
enum class RefusalReason : std::uint8_t {
  none,             ///< it was not refused
  too_short,        ///< lifted before it could be told what it writes
  backwards,        ///< from the stroke's end to its start
  lifted_early,     ///< along the stroke, but not to its end
  not_along,        ///< begun as the stroke, but not written along it
  too_far,          ///< begun too far from the start
  at_end,           ///< begun at the stroke's end
  in_middle,        ///< begun in the middle of the stroke
  wrong_direction,  ///< begun at the start, but in another direction
  another_stroke    ///< another stroke was begun
};

/// "too_short", "backwards", "lifted_early", "not_along", "too_far", "at_end", "in_middle", "wrong_direction",
/// "another_stroke"; "none". For people refusal_text() puts it into words.
const char* to_string(RefusalReason reason) noexcept;

/// The reason in words: "backwards: the stroke begins here". Empty for `none`.
std::string refusal_text(RefusalReason reason, const Language& language = {});

/// Something that happened in a lesson.
struct LessonEvent {
  std::uint64_t tick = 0;                             ///< number of the sample with which it happened, from 0
  double time = 0.0;                                  ///< of that sample [s]
  LessonEventKind kind = LessonEventKind::begun;      ///< what happened
  RefusalReason reason = RefusalReason::none;         ///< of `refused`
  WritingHint hint = WritingHint::none;               ///< of `hinted`
  int character = 0;                                  ///< index on the page of the character concerned
  int stroke = 0;                                     ///< index within it of the stroke concerned
  int misses = 0;                                     ///< of that stroke so far
  int pen_down = -1;                                  ///< number of the pen-down concerned, from 0; -1: none
  Point place = Point::Zero();                        ///< where the pen was, or was lifted [m, page]
};

/// What a lesson can be asked to do while it goes on.
enum class LessonCommandKind : std::uint8_t {
  skip,    ///< pass over the stroke that is due; while it is being written, once the pen has left it unfinished
  undo,    ///< make the last stroke due again, whether it was accepted or skipped; once the pen writes none
  show,    ///< show the stroke that is due, and write it once
  pause,   ///< no force, and what the pen does is not seen
  resume,  ///< go on after a pause, once the pen is off the paper
  ignore   ///< what the pen-down that is going on has done, and will do, is no writing
};

/// "skip", "undo", "show", "pause", "resume", "ignore".
const char* to_string(LessonCommandKind kind) noexcept;

/// A command and when it is to be carried out.
struct LessonCommand {
  LessonCommandKind kind = LessonCommandKind::skip;  ///< what is to be done
  std::uint64_t tick = 0;  ///< number of the sample before which it is carried out; if that has passed: the next one
};

}  // namespace calligraphy
