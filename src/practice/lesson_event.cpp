#include <calligraphy/practice/lesson_event.hpp>

#include "base/enum_name.hpp"

namespace calligraphy {

const char* to_string(LessonEventKind kind) noexcept {
  static constexpr const char* names[] = {"begun",   "accepted", "refused",  "ignored",   "hinted",  "shown",
                                          "skipped", "undone",   "declined", "restarted", "finished"};
  return name_of<LessonEventKind::finished>(kind, names, "");
}

const char* to_string(RefusalReason reason) noexcept {
  static constexpr const char* names[] = {"none",    "too_short", "backwards", "lifted_early",    "not_along",
                                          "too_far", "at_end",    "in_middle", "wrong_direction", "another_stroke"};
  return name_of<RefusalReason::another_stroke>(reason, names, "");
}

const char* to_string(LessonCommandKind kind) noexcept {
  static constexpr const char* names[] = {"skip", "undo", "show", "pause", "resume", "ignore"};
  return name_of<LessonCommandKind::ignore>(kind, names, "");
}

std::string refusal_text(RefusalReason reason, const Language& language) {
  const std::string own = language.text(std::string("refused.") + to_string(reason));
  return own.empty() ? language.text(std::string("hint.") + to_string(reason)) : own;
}

}  // namespace calligraphy
