// A lesson at a device in words: while it is held, and afterwards.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/judge/language.hpp>
#include <calligraphy/practice/lesson_event.hpp>
#include <calligraphy/practice/lesson_score.hpp>
#include <calligraphy/practice/lesson_view.hpp>
#include <calligraphy/practice/page.hpp>

namespace calligraphy::tools {

/// What a person is told of an event, as it happens. Empty where writing on says enough.
std::string event_text(const LessonEvent& event, const LessonView& lesson, const PracticePage& page,
                       const Language& language);

/// For each character that was begun, how many strokes were right at once, and what else the table does not tell: the
/// strokes skipped and the attempts, at most usual_remarks.
std::string lines(const std::vector<LessonWriting>& lessons, const Language& language);

}  // namespace calligraphy::tools
