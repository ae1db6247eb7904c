#include "lesson_report.hpp"

#include <cstddef>

#include <calligraphy/base/text.hpp>
#include <calligraphy/model/typical_stroke.hpp>
#include <calligraphy/practice/hint_text.hpp>

namespace calligraphy::tools {

std::string event_text(const LessonEvent& event, const LessonView& lesson, const PracticePage& page,
                       const Language& language) {
  const Point to_start = lesson.start - event.place;
  const Character& character = page.characters[static_cast<std::size_t>(event.character)].character;
  const std::string number = std::to_string(event.stroke + 1), name = encode_utf8(character.code);
  const TypicalStroke& type = typical_stroke(character.sequence.stroke_ids[static_cast<std::size_t>(event.stroke)]);
  const std::string stroke =
      language.text("stroke", {{"number", number}, {"pinyin", type.pinyin}, {"name", type.name}});
  switch (event.kind) {
    case LessonEventKind::hinted:
      return hint_text(event.hint, to_start, language);
    case LessonEventKind::refused:
      return language.text("write.refused", {{"character", name},
                                             {"stroke", stroke},
                                             {"reason", refusal_text(event.reason, language)}});
    case LessonEventKind::shown:
      return language.text("write.shown",
                           {{"character", name}, {"stroke", stroke}, {"way", way_text(to_start, language)}});
    case LessonEventKind::skipped:
      return language.text_for(1, "lesson.skipped", {{"list", number}});
    case LessonEventKind::undone:
      return language.text("write.undone", {{"character", name}, {"stroke", stroke}});
    case LessonEventKind::declined:
      return language.text("write.declined");
    default:
      return "";
  }
}

std::string lines(const std::vector<LessonWriting>& lessons, const Language& language) {
  std::string text;
  for (const LessonWriting& lesson : lessons) {
    for (const LessonScore& score : score_lesson(lesson)) {
      const Character& character = score.score.match.character;
      std::string told;
      int count = 0;
      for (const LessonRemark& remark : score.remarks) {
        if (remark.kind == LessonRemarkKind::written || count++ == usual_remarks) continue;
        told += "  " + lesson_remark_text(remark, character, language) + "\n";
      }
      if (score.accepted == 0 && told.empty()) continue;
      text += language.text("write.right_at_once", {{"character", encode_utf8(score.score.character)},
                                                    {"right", std::to_string(score.right_at_once)},
                                                    {"strokes", std::to_string(score.score.stroke_count)}}) +
              "\n" + told;
    }
  }
  return text.empty() ? "" : "\n" + text;
}

}  // namespace calligraphy::tools
