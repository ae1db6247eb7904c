#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <calligraphy/practice/hint_text.hpp>

#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"
#include "ticks.hpp"

namespace calligraphy::c {
namespace {

LessonOptions lesson_options_of(const Capabilities& device, double scale, const calligraphy_renderer_options* options,
                                const calligraphy_lesson_options* held) {
  LessonOptions result;
  result.renderer = options ? options_of(options) : RendererOptions::for_device(device, scale);
  if (!held) return result;
  const calligraphy_lesson_options given = read_struct(held, "calligraphy_lesson_options");
  result.mode = enumeration("mode", given.mode, LessonMode::watch);
  if (given.misses_until_shown != 0) result.misses_until_shown = std::max(0, given.misses_until_shown);
  if (given.has_strength) result.strength = given.strength;
  set_if_given(result.hint_time, given.hint_time, "hint_time", "s");
  return result;
}

/// A tick without what only its renderer's page says.
void write_lesson_tick(const HapticTick& from, const Eigen::Vector3d& force, calligraphy_tick* to) noexcept {
  calligraphy_tick tick;
  fill_tick(from, {}, &tick);
  to_array(force, tick.force);
  put_struct(to, tick);
}

/// Writes numbers one after the other, as far as they fit, and counts them.
class NumberWriter {
 public:
  NumberWriter(double* to, std::size_t capacity) : to_(to), capacity_(capacity) {}

  template <class... Numbers>
  void add(Numbers... numbers) {
    for (const double number : {static_cast<double>(numbers)...}) {
      if (count_ < capacity_) to_[count_] = number;
      ++count_;
    }
  }
  std::size_t count() const { return count_; }

 private:
  double* to_;
  std::size_t capacity_;
  std::size_t count_ = 0;
};

/// Reads them again. @throws Refusal if there are too few, or one is not a number that can be there
class NumberReader {
 public:
  NumberReader(const double* from, std::size_t size) : from_(from), size_(size) {}

  double number() {
    if (next_ >= size_) refuse_writing();
    return from_[next_++];
  }
  int integer(int least = -1, int most = std::numeric_limits<int>::max()) {
    const double value = number();
    if (!(value >= least && value <= most) || value != std::floor(value)) refuse_writing();
    return static_cast<int>(value);
  }
  /// Of items of so many numbers each.
  std::size_t count(std::size_t numbers) {
    const auto value = static_cast<std::size_t>(integer(0));
    if (value > size_ / numbers) refuse_writing();
    return value;
  }
  Point point() {
    const double x = number();
    return {x, number()};
  }

 private:
  [[noreturn]] static void refuse_writing() {
    throw Refusal(CALLIGRAPHY_INVALID_VALUE, "numbers: they are not what calligraphy_lesson_writing() wrote");
  }

  const double* from_;
  std::size_t size_;
  std::size_t next_ = 0;
};

void write_numbers(const LessonWriting& writing, NumberWriter& to) {
  const bool has_hand = !writing.hands.empty();
  to.add(writing.recording.rate, has_hand, writing.strokes.size(), writing.attempts.size(),
         writing.recording.samples.size());
  for (const LessonStroke& stroke : writing.strokes) {
    to.add(static_cast<int>(stroke.fate), stroke.misses, stroke.pen_down);
  }
  for (const LessonEvent& attempt : writing.attempts) {
    to.add(attempt.character, attempt.stroke, static_cast<int>(attempt.reason), attempt.place.x(), attempt.place.y());
  }
  for (std::size_t i = 0; i < writing.recording.samples.size(); ++i) {
    const RecordedSample& sample = writing.recording.samples[i];
    const Point hand = has_hand ? writing.hands[i] : Point(0.0, 0.0);
    to.add(sample.time, sample.pen_tip.x(), sample.pen_tip.y(), sample.force.z(), static_cast<int>(sample.state),
           static_cast<int>(sample.events), sample.character, sample.stroke, hand.x(), hand.y());
  }
}

LessonWriting read_numbers(const PracticePage& page, NumberReader from) {
  LessonWriting writing;
  writing.page = page;
  writing.recording.page = page_id(page);
  writing.recording.rate = from.number();
  const bool has_hand = from.integer(0, 1) != 0;
  const std::size_t strokes = from.count(3), attempts = from.count(5), samples = from.count(10);
  std::size_t expected = 0;
  for (const PlacedCharacter& placed : page.characters) {
    const int character = static_cast<int>(&placed - page.characters.data());
    for (int stroke = 0; stroke < placed.character.stroke_count(); ++stroke, ++expected) {
      const auto fate = static_cast<StrokeFate>(from.integer(0, static_cast<int>(StrokeFate::skipped)));
      const int misses = from.integer(0), pen_down = from.integer();
      writing.strokes.push_back({character, stroke, fate, misses, pen_down, false});
    }
  }
  if (expected != strokes) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "numbers: they are of a lesson on another page");
  for (std::size_t i = 0; i < attempts; ++i) {
    LessonEvent& attempt = writing.attempts.emplace_back();
    attempt.kind = LessonEventKind::refused;
    attempt.character = from.integer(0, static_cast<int>(page.characters.size()) - 1);
    const auto& written = page.characters[static_cast<std::size_t>(attempt.character)].character;
    attempt.stroke = from.integer(0, written.stroke_count() - 1);
    attempt.reason = static_cast<RefusalReason>(from.integer(0, static_cast<int>(RefusalReason::another_stroke)));
    attempt.place = from.point();
  }
  for (std::size_t i = 0; i < samples; ++i) {
    RecordedSample& sample = writing.recording.samples.emplace_back();
    sample.time = from.number();
    sample.pen_tip.head<2>() = from.point();
    sample.force.z() = from.number();
    sample.state = static_cast<InteractionState>(from.integer(0, static_cast<int>(InteractionState::writing)));
    sample.events = static_cast<TickEvent>(from.integer(0, 255));
    sample.character = from.integer(0);
    sample.stroke = from.integer(0);
    const Point hand = from.point();
    if (has_hand) writing.hands.push_back(hand);
  }
  return writing;
}

const LessonScore& lesson_score_of(const calligraphy_score* score, std::int32_t character) {
  const std::vector<LessonScore>& lessons = object<ScoreObject>(score).lessons;
  if (lessons.empty()) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "the score is not of a lesson");
  return item("character", lessons, character);
}

/// All that a remark is about, in order.
std::vector<int> strokes_of(const LessonRemark& remark) {
  std::vector<int> result = remark.strokes;
  if (remark.kind == LessonRemarkKind::written) {
    for (int i = 0; i < remark.remark.stroke_count; ++i) result.push_back(remark.remark.stroke + i);
    if (remark.remark.other_stroke >= 0 && remark.remark.other_path >= 0) result.push_back(remark.remark.other_stroke);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace

PointerLesson& pointer_lesson(const calligraphy_lesson* lesson) {
  LessonObject& found = object<LessonObject>(lesson);
  if (!found.pointer) throw Refusal(CALLIGRAPHY_INVALID_VALUE, "the lesson is not for a pointer: update it");
  return *found.pointer;
}

}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_lesson_create(const calligraphy_page* page, const calligraphy_mapping* mapping,
                                             const calligraphy_capabilities* capabilities,
                                             const calligraphy_renderer_options* options,
                                             const calligraphy_lesson_options* held, calligraphy_lesson** lesson) {
  return guarded([&] {
    target(lesson, "lesson");
    const PracticePage& written = object<PracticePage>(page);
    const MotionMapping used = mapping ? mapping_of(mapping) : upright_page(written.width, written.height);
    const Capabilities device = capabilities_of(capabilities);
    auto made = std::make_shared<LessonObject>();
    made->device = device;
    LessonOptions chosen = lesson_options_of(device, used.scale, options, held);
    chosen.mapping = used;
    made->scale = used.scale;
    made->own.emplace(std::vector{written}, device, chosen);
    hand_out(lesson, std::move(made));
  });
}

calligraphy_status calligraphy_lesson_create_for_pointer(const calligraphy_page* page,
                                                         const calligraphy_capabilities* capabilities,
                                                         const calligraphy_renderer_options* options,
                                                         const calligraphy_lesson_options* held,
                                                         calligraphy_lesson** lesson) {
  return guarded([&] {
    target(lesson, "lesson");
    const Capabilities device = capabilities_of(capabilities);
    auto made = std::make_shared<LessonObject>();
    made->device = device;
    const LessonOptions chosen = lesson_options_of(device, 1.0, options, held);
    made->pointer.emplace(std::vector{object<PracticePage>(page)}, device, chosen);
    hand_out(lesson, std::move(made));
  });
}

calligraphy_status calligraphy_lesson_update(calligraphy_lesson* lesson, const calligraphy_device_state* state,
                                             const double* hand, calligraphy_tick* tick) {
  if (const calligraphy_status status = check_tick(tick)) return status;
  auto* const found = find<LessonObject>(lesson);
  if (!found) return without_force(tick, refuse_handle(Kind::lesson, lesson));
  if (!found->own) {
    return without_force(tick, refuse(CALLIGRAPHY_INVALID_VALUE, "the lesson has a device of its own: advance it"));
  }
  if (const calligraphy_status status = check_given(state, "calligraphy_device_state")) {
    return without_force(tick, status);
  }
  LessonHand known;
  if (hand) known.place = Point(hand[0], hand[1]);
  const HapticTick& result = found->own->update(state_of(state), hand ? &known : nullptr);
  write_lesson_tick(result, found->own->force(), tick);
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_lesson_move_pointer(calligraphy_lesson* lesson, const calligraphy_pointer_sample* sample,
                                                   const calligraphy_stylus* stylus) {
  return guarded([&] {
    PointerLesson& moved = pointer_lesson(lesson);
    const calligraphy_pointer_sample given = read_struct(sample, "calligraphy_pointer_sample");
    PointerSample made;
    made.time = given.time;
    made.place = Point(given.place[0], given.place[1]);
    made.is_down = given.is_down != 0;
    made.is_cancelled = given.is_cancelled != 0;
    made.kind = enumeration("kind", given.kind, PointerKind::pen);
    made.id = given.id;
    made.buttons = given.buttons;
    if (const calligraphy_status status = read_stylus(stylus, made.stylus)) throw_refused(status);
    moved.move(made);
  });
}

calligraphy_status calligraphy_lesson_advance(calligraphy_lesson* lesson, double time, int32_t* busy) {
  return guarded([&] {
    PointerLesson& advanced = pointer_lesson(lesson);
    advanced.advance(time);
    if (busy) *busy = advanced.is_busy();
  });
}

calligraphy_status calligraphy_lesson_send(calligraphy_lesson* lesson, int32_t command) {
  return guarded([&] {
    const auto kind = enumeration("command", command, LessonCommandKind::ignore);
    if (!object<LessonObject>(lesson).lesson().send({kind, 0})) {
      throw Refusal(CALLIGRAPHY_TOO_SMALL, "64 commands wait already");
    }
  });
}

calligraphy_status calligraphy_lesson_again(calligraphy_lesson* lesson) {
  return guarded([&] { object<LessonObject>(lesson).lesson().again(); });
}

calligraphy_status calligraphy_lesson_begin(calligraphy_lesson* lesson, const calligraphy_page* page) {
  return guarded([&] { object<LessonObject>(lesson).lesson().begin({object<PracticePage>(page)}); });
}

calligraphy_status calligraphy_lesson_change(calligraphy_lesson* lesson, const calligraphy_renderer_options* options,
                                             const calligraphy_lesson_options* held) {
  return guarded([&] {
    LessonObject& changed = object<LessonObject>(lesson);
    const LessonOptions chosen = lesson_options_of(changed.device, changed.scale, options, held);
    changed.pointer ? changed.pointer->change(chosen) : changed.own->change(chosen);
  });
}

calligraphy_status calligraphy_lesson_look(calligraphy_lesson* lesson, calligraphy_lesson_view* view) {
  return guarded([&] {
    LessonObject& looked = object<LessonObject>(lesson);
    looked.view = looked.lesson().look();
    const LessonView& from = looked.view;
    calligraphy_lesson_view to = {};
    to.mode = static_cast<std::int32_t>(from.mode);
    to.due = from.due;
    to.stroke_count = static_cast<std::int32_t>(from.strokes.size());
    to.accepted = from.accepted;
    to.skipped = from.skipped;
    to.right_at_once = from.right_at_once;
    to.is_finished = from.is_finished;
    to.is_paused = from.is_paused;
    to.is_on_paper = from.is_on_paper;
    to.shows_start = from.shows_start;
    to.hint = static_cast<std::int32_t>(from.hint);
    to.reason = static_cast<std::int32_t>(from.reason);
    to.demonstrated = from.demonstration.stroke;
    to.ink_count = static_cast<std::int32_t>(from.ink.size());
    to.tick = from.tick;
    to.lost_ticks = from.lost_ticks;
    to.lost_events = from.lost_events;
    to.time = from.time;
    to_array(from.pen_tip, to.pen_tip);
    to_array(from.hand, to.hand);
    to_array(from.start, to.start);
    to_array(from.direction, to.direction);
    to_array(from.hint_place, to.hint_place);
    to.demonstrated_share = from.demonstration.share;
    to.assistance = from.assistance;
    write_struct(view, "calligraphy_lesson_view", to);
  });
}

calligraphy_status calligraphy_lesson_read_stroke(const calligraphy_lesson* lesson, int32_t index,
                                                  calligraphy_lesson_stroke* stroke) {
  return guarded([&] {
    const LessonStroke& found = item("index", object<LessonObject>(lesson).view.strokes, index);
    write_struct(stroke, "calligraphy_lesson_stroke",
                 {.size = 0,
                  .character = found.character,
                  .stroke = found.stroke,
                  .fate = static_cast<std::int32_t>(found.fate),
                  .misses = found.misses,
                  .pen_down = found.pen_down,
                  .is_shown = found.is_shown,
                  .reserved = 0});
  });
}

calligraphy_status calligraphy_lesson_read_ink(const calligraphy_lesson* lesson, int32_t index,
                                               calligraphy_lesson_ink* ink) {
  return guarded([&] {
    const LessonInk& found = item("index", object<LessonObject>(lesson).view.ink, index);
    write_struct(ink, "calligraphy_lesson_ink",
                 {.size = 0,
                  .pen_down = found.pen_down,
                  .begin = static_cast<std::int32_t>(found.begin),
                  .end = static_cast<std::int32_t>(found.end),
                  .fate = static_cast<std::int32_t>(found.fate),
                  .is_doubted = found.is_doubted});
  });
}

calligraphy_status calligraphy_lesson_ink_points(const calligraphy_lesson* lesson, int32_t begin, double* ink,
                                                 size_t capacity, size_t* count) {
  return guarded([&] {
    const Lesson& of = object<LessonObject>(lesson).lesson();
    const std::vector<RecordedSample>& samples = of.recording().samples;
    require_index("begin", begin, samples.size() + 1);
    const auto first = static_cast<std::size_t>(begin);
    const std::size_t written = std::min(capacity, samples.size() - first);
    if (written > 0) target(ink, "ink");
    for (std::size_t i = first; i < first + written; ++i) {
      const LessonHand& hand = of.hands()[i];
      for (const double number : {samples[i].pen_tip.x(), samples[i].pen_tip.y(), hand.place.x(), hand.place.y(),
                                  samples[i].time, hand.pressure}) {
        *ink++ = number;
      }
    }
    target(count, "count") = written;
  });
}

calligraphy_status calligraphy_lesson_take_event(calligraphy_lesson* lesson, calligraphy_lesson_event* event,
                                                 int32_t* found) {
  return guarded([&] {
    Lesson& of = object<LessonObject>(lesson).lesson();
    if (const calligraphy_status status = check_size(event, "calligraphy_lesson_event")) throw_refused(status);
    LessonEvent taken;
    target(found, "found") = of.take_event(taken);
    if (!*found) return;
    put_struct(event, {.size = 0,
                       .kind = static_cast<std::int32_t>(taken.kind),
                       .reason = static_cast<std::int32_t>(taken.reason),
                       .hint = static_cast<std::int32_t>(taken.hint),
                       .character = taken.character,
                       .stroke = taken.stroke,
                       .misses = taken.misses,
                       .pen_down = taken.pen_down,
                       .tick = taken.tick,
                       .time = taken.time,
                       .place = {taken.place.x(), taken.place.y()}});
  });
}

calligraphy_status calligraphy_lesson_hint_text(calligraphy_lesson* lesson, const char* language, const char** text) {
  return guarded([&] {
    LessonObject& of = object<LessonObject>(lesson);
    target(text, "text");
    const Language chosen = language ? Language(language) : Language();
    // A screen shows the page at another size: there, no millimetres.
    const Point unknown = Point::Constant(std::numeric_limits<double>::quiet_NaN());
    const Point to_start = of.pointer ? unknown : Point(of.view.start - of.view.hint_place);
    const bool is_hint = of.view.hint != WritingHint::none;
    of.text = is_hint ? hint_text(of.view.hint, to_start, chosen) : refusal_text(of.view.reason, chosen);
    *text = of.text.c_str();
  });
}

calligraphy_status calligraphy_lesson_writing(const calligraphy_lesson* lesson, double* numbers, size_t capacity,
                                              size_t* count) {
  return guarded([&] {
    NumberWriter to(numbers, numbers ? capacity : 0);
    write_numbers(object<LessonObject>(lesson).lesson().writing(), to);
    target(count, "count") = to.count();
    if (numbers && to.count() > capacity) {
      throw Refusal(CALLIGRAPHY_TOO_SMALL, "capacity = " + std::to_string(capacity) + ", but there are " +
                                               std::to_string(to.count()) + " numbers");
    }
  });
}

calligraphy_status calligraphy_score_writing(const calligraphy_page* page, const double* numbers, size_t size,
                                             int32_t tolerance, calligraphy_score** score) {
  return guarded([&] {
    const PracticePage& on = object<PracticePage>(page);
    const auto tolerances = tolerances_of<JudgeTolerances>(tolerance);
    target(numbers, "numbers");
    target(score, "score");
    auto made = std::make_shared<ScoreObject>();
    const LessonWriting writing = read_numbers(on, {numbers, size});
    made->has_hand = !writing.hands.empty();
    made->lessons = score_lesson(writing, tolerances);
    for (LessonScore& lesson : made->lessons) made->characters.push_back(lesson.score);
    hand_out(score, std::move(made));
  });
}

calligraphy_status calligraphy_score_lesson(const calligraphy_score* score, int32_t character,
                                            calligraphy_lesson_score* lesson) {
  return guarded([&] {
    const LessonScore& found = lesson_score_of(score, character);
    write_struct(lesson, "calligraphy_lesson_score",
                 {.size = 0,
                  .accepted = found.accepted,
                  .skipped = found.skipped,
                  .right_at_once = found.right_at_once,
                  .remark_count = static_cast<std::int32_t>(found.remarks.size()),
                  .has_hand = object<ScoreObject>(score).has_hand,
                  .guided_error = found.guided_error});
  });
}

calligraphy_status calligraphy_score_lesson_remark(const calligraphy_score* score, int32_t character, int32_t index,
                                                   calligraphy_lesson_remark* remark, int32_t* strokes,
                                                   size_t capacity) {
  return guarded([&] {
    const LessonRemark& found = item("index", lesson_score_of(score, character).remarks, index);
    const std::vector<int> about = strokes_of(found);
    write_struct(remark, "calligraphy_lesson_remark",
                 {.size = 0,
                  .kind = static_cast<std::int32_t>(found.kind),
                  .remark = static_cast<std::int32_t>(found.remark.kind),
                  .reason = static_cast<std::int32_t>(found.reason),
                  .count = found.count,
                  .stroke_count = static_cast<std::int32_t>(about.size()),
                  .place = {found.place.x(), found.place.y()}});
    if (strokes) std::copy_n(about.begin(), std::min(capacity, about.size()), strokes);
  });
}

calligraphy_status calligraphy_score_lesson_remark_text(const calligraphy_score* score, int32_t character,
                                                        int32_t index, const char* language, const char** text) {
  return guarded([&] {
    ScoreObject& of = object<ScoreObject>(score);
    const LessonScore& lesson = lesson_score_of(score, character);
    const LessonRemark& remark = item("index", lesson.remarks, index);
    const Language chosen = language ? Language(language) : Language();
    target(text, "text");
    const std::lock_guard lock(of.mutex);
    std::string& kept = of.texts[{character, index, std::string(chosen.code())}];
    if (kept.empty()) kept = lesson_remark_text(remark, lesson.score.match.character, chosen);
    *text = kept.c_str();
  });
}
