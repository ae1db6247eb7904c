#include <calligraphy/practice/lesson_score.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <calligraphy/judge/remark_text.hpp>

#include "base/enum_name.hpp"

namespace calligraphy {
namespace {

/// Strokes as people count them: "1, 3, 4".
std::string list_of(const std::vector<int>& strokes) {
  std::string text;
  for (const int stroke : strokes) text += (text.empty() ? "" : ", ") + std::to_string(stroke + 1);
  return text;
}

/// About the writing as a whole, which a stroke that is lacking may be to blame for.
bool is_on_whole(StrokeRemarkKind kind) {
  using Kind = StrokeRemarkKind;
  return kind == Kind::character || kind == Kind::lookalike || kind == Kind::unreadable || kind == Kind::several;
}

/// Whether a remark on one stroke holds for another in the same words, but for its number.
bool can_be_one(StrokeRemarkKind kind) {
  using Kind = StrokeRemarkKind;
  return kind == Kind::wavy || kind == Kind::bent || kind == Kind::straight || kind == Kind::hook;
}

/// Not of a stroke that was skipped, that is still to come, or whose ink was lost.
bool has_ink(const LessonStroke& stroke) { return stroke.fate == StrokeFate::accepted && stroke.pen_down >= 0; }

class LessonScorer {
 public:
  LessonScorer(const LessonWriting& writing, int character) : writing_(writing), character_(character) {
    for (const LessonStroke& stroke : writing.strokes) {
      if (stroke.character == character) strokes_.push_back(stroke);
    }
  }

  LessonScore run(CharacterScore score, double guided_error) {
    result_.score = std::move(score);
    result_.guided_error = guided_error;
    for (const LessonStroke& stroke : strokes_) {
      const bool is_accepted = stroke.fate == StrokeFate::accepted;
      result_.accepted += is_accepted;
      result_.skipped += stroke.fate == StrokeFate::skipped;
      result_.right_at_once += is_accepted && stroke.misses == 0;
      std::vector<int>& downs = result_.pen_downs;
      if (is_accepted && (downs.empty() || downs.back() != stroke.pen_down)) downs.push_back(stroke.pen_down);
    }
    add_skipped();
    add_written();
    add_attempts();
    return std::move(result_);
  }

 private:
  void add_skipped() {
    LessonRemark remark;
    remark.kind = LessonRemarkKind::skipped;
    remark.count = result_.skipped;
    for (const LessonStroke& stroke : strokes_) {
      if (stroke.fate == StrokeFate::skipped) remark.strokes.push_back(stroke.stroke);
    }
    if (remark.strokes.empty()) return;
    const std::vector<Stroke> drawn = calligraphy::strokes(placed().character);
    remark.place = drawn[static_cast<std::size_t>(remark.strokes.front())].control_points.front();
    result_.remarks.push_back(std::move(remark));
  }

  void add_written() {
    std::vector<StrokeRemark> all = result_.score.match.remarks;
    const bool is_whole = std::all_of(strokes_.begin(), strokes_.end(), has_ink);
    std::erase_if(all, [&](const StrokeRemark& remark) {
      if (!is_whole && is_on_whole(remark.kind)) return true;
      if (remark.kind != StrokeRemarkKind::missing) return false;
      const auto first = strokes_.begin() + remark.stroke;
      return std::none_of(first, first + remark.stroke_count, has_ink);  // the lesson knows why
    });
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.evidence > b.evidence; });
    for (const StrokeRemark& remark : all) {
      const auto is_alike = [&](const LessonRemark& other) {
        return can_be_one(remark.kind) && other.kind == LessonRemarkKind::written && other.remark.kind == remark.kind;
      };
      const auto other = std::find_if(result_.remarks.begin(), result_.remarks.end(), is_alike);
      if (other == result_.remarks.end()) {
        LessonRemark made;
        made.remark = remark;
        made.place = remark.place;
        result_.remarks.push_back(std::move(made));
        continue;
      }
      ++other->count;
      for (int i = 0; i < remark.stroke_count; ++i) other->strokes.push_back(remark.stroke + i);
    }
    for (LessonRemark& remark : result_.remarks) std::sort(remark.strokes.begin(), remark.strokes.end());
  }

  void add_attempts() {
    std::vector<LessonRemark> made;
    for (const LessonEvent& attempt : writing_.attempts) {
      if (attempt.character != character_) continue;
      const auto is_alike = [&](const LessonRemark& other) { return other.reason == attempt.reason; };
      auto remark = std::find_if(made.begin(), made.end(), is_alike);
      if (remark == made.end()) {
        const Placement& placement = placed().placement;
        remark = made.emplace(made.end());
        remark->kind = LessonRemarkKind::attempts;
        remark->reason = attempt.reason;
        remark->count = 0;
        remark->place = (attempt.place - placement.origin) / placement.em;
      }
      ++remark->count;
      std::vector<int>& strokes = remark->strokes;
      if (std::find(strokes.begin(), strokes.end(), attempt.stroke) == strokes.end()) strokes.push_back(attempt.stroke);
    }
    std::stable_sort(made.begin(), made.end(), [](const auto& a, const auto& b) { return a.count > b.count; });
    for (LessonRemark& remark : made) {
      std::sort(remark.strokes.begin(), remark.strokes.end());
      result_.remarks.push_back(std::move(remark));
    }
  }

  const PlacedCharacter& placed() const { return writing_.page.characters[static_cast<std::size_t>(character_)]; }

  const LessonWriting& writing_;
  const int character_;
  std::vector<LessonStroke> strokes_;
  LessonScore result_;
};

}  // namespace

const char* to_string(LessonRemarkKind kind) noexcept {
  static constexpr const char* names[] = {"skipped", "written", "attempts"};
  return name_of<LessonRemarkKind::attempts>(kind, names, "");
}

std::vector<LessonScore> score_lesson(const LessonWriting& writing, const JudgeTolerances& tolerances) {
  const bool has_hand = !writing.hands.empty();
  std::vector<CharacterScore> of_pen = score_page(writing.page, writing.recording, tolerances), of_hand;
  if (has_hand) {
    Recording hand = writing.recording;
    for (std::size_t i = 0; i < hand.samples.size(); ++i) hand.samples[i].pen_tip.head<2>() = writing.hands[i];
    of_hand = score_page(writing.page, hand, tolerances);
  }
  std::vector<LessonScore> result;
  for (std::size_t i = 0; i < of_pen.size(); ++i) {
    const double guided_error = has_hand ? of_pen[i].rms_error : not_measured;
    CharacterScore& score = has_hand ? of_hand[i] : of_pen[i];
    result.push_back(LessonScorer(writing, static_cast<int>(i)).run(std::move(score), guided_error));
  }
  return result;
}

std::string lesson_remark_text(const LessonRemark& remark, const Character& character, const Language& language) {
  const std::string list = list_of(remark.strokes), count = std::to_string(remark.count);
  const auto several = static_cast<long long>(remark.strokes.size());
  switch (remark.kind) {
    case LessonRemarkKind::skipped:
      return language.text_for(several, "lesson.skipped", {{"list", list}});
    case LessonRemarkKind::attempts: {
      const std::string where = language.text_for(several, "lesson.strokes", {{"list", list}});
      const std::string key = std::string("attempts.") + to_string(remark.reason);
      return language.text_for(remark.count, key, {{"where", where}, {"count", count}});
    }
    default:
      break;
  }
  const std::string text = remark_text(remark.remark, character, language);
  return remark.strokes.empty() ? text
                                : language.text_for(several, "lesson.likewise", {{"text", text}, {"list", list}});
}

}  // namespace calligraphy
