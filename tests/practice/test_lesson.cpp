#include <calligraphy/practice/lesson.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/practice/session.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"
#include "../sanitized.hpp"
#include "lesson_pupil.hpp"
#include "pages.hpp"

namespace lesson_tests {

using namespace calligraphy;
using calligraphy_test::page_of;
using calligraphy_test::Pupil;

namespace {

LessonOptions options_for(LessonMode mode = LessonMode::guided) {
  LessonOptions options;
  options.mode = mode;
  options.mapping = MotionMapping();  // the pupil moves in page axes
  options.renderer = RendererOptions::for_device(device_profile("desktop"));
  return options;
}

Lesson lesson_on(std::string_view text, const LessonOptions& options = options_for()) {
  return Lesson({page_of(text)}, device_profile("desktop"), options);
}

/// All of an event but its place.
auto said(const LessonEvent& event) {
  return std::tuple(event.tick, event.kind, event.reason, event.hint, event.character, event.stroke, event.misses,
                    event.pen_down);
}

/// A lesson with misses and commands at given ticks, looked at after every so many ticks.
std::vector<LessonEvent> troubled_lesson(std::uint64_t ticks_per_look) {
  Lesson lesson = lesson_on("三");
  std::vector<LessonEvent> events;
  Pupil pupil(lesson);
  const auto look = [&] {
    lesson.look();
    for (LessonEvent event; lesson.take_event(event);) events.push_back(event);
  };
  pupil.on_tick = [&] {
    if (pupil.ticks % ticks_per_look == 0) look();
  };
  using Kind = LessonCommandKind;
  for (const LessonCommand& command : {LessonCommand{Kind::show, 100}, {Kind::skip, 3000}, {Kind::undo, 3500},
                                       {Kind::pause, 4000}, {Kind::resume, 4500}, {Kind::skip, 9000}}) {
    CHECK(lesson.send(command));
  }
  lesson.again(12'000);
  pupil.write(pupil.backwards(0));
  pupil.write(pupil.path(1));
  for (std::size_t stroke = 0; stroke < 3; ++stroke) pupil.write(pupil.path(stroke));
  while (pupil.ticks < 13'000) pupil.wait(0.01);
  for (std::size_t stroke = 0; stroke < 3; ++stroke) pupil.write(pupil.path(stroke));
  look();
  return events;
}

}  // namespace

TEST_CASE("what was written right is accepted, and what was not is refused with its reason", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  CHECK(pupil.events() == "restarted 1");
  pupil.write(pupil.backwards(0));
  CHECK(pupil.events() == "refused backwards 1");
  CHECK(lesson.look().reason == RefusalReason::backwards);
  std::vector<Point> half = pupil.path(0);
  half.resize(half.size() / 3);
  pupil.write(half);
  CHECK(pupil.events() == "begun 1, refused lifted_early 1, shown 1");
  CHECK(lesson.look().demonstration.stroke == 0);
  for (std::size_t stroke = 0; stroke < 3; ++stroke) pupil.write(pupil.path(stroke));
  CHECK(pupil.events() == "begun 1, accepted 1, begun 2, accepted 2, begun 3, accepted 3, finished 3");
  const LessonView& view = lesson.look();
  CHECK(view.accepted == 3);
  CHECK(view.right_at_once == 2);
  CHECK(view.strokes[0].misses == 2);
  std::vector<StrokeFate> fates;
  for (const LessonInk& ink : view.ink) fates.push_back(ink.fate);
  using enum StrokeFate;
  CHECK(fates == std::vector<StrokeFate>{refused, refused, accepted, accepted, accepted});
}

TEST_CASE("a lesson decides the same however often it is looked at", "[lesson]") {
  const std::vector<LessonEvent> events = troubled_lesson(1);
  CHECK(events.size() > 20);
  for (const std::uint64_t ticks_per_look : {std::uint64_t{16}, std::uint64_t{1000}}) {
    const std::vector<LessonEvent> others = troubled_lesson(ticks_per_look);
    CHECK(std::equal(events.begin(), events.end(), others.begin(), others.end(),
                     [](const LessonEvent& a, const LessonEvent& b) { return said(a) == said(b); }));
  }
}

TEST_CASE("a full queue loses events, and the view is right all the same", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  for (int i = 0; i < 1100; ++i) {
    lesson.send({LessonCommandKind::skip});
    lesson.send({LessonCommandKind::undo});
    pupil.wait(0.001);
  }
  pupil.write(pupil.path(0));
  lesson.send({LessonCommandKind::skip});
  pupil.wait(0.001);
  const LessonView& view = lesson.look();
  CHECK(view.lost_events > 1000);
  CHECK(view.accepted == 1);
  CHECK(view.skipped == 1);
  CHECK(view.due == 2);
  CHECK(view.ink.back().fate == StrokeFate::accepted);
}

TEST_CASE("a bounce, and a palm at any moment, is no miss", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  pupil.write(pupil.path(0));
  pupil.events();
  const Point end = pupil.path(0).back();
  pupil.speed = 1.0;
  pupil.go(end, -0.001);
  pupil.go(end, 0.004);
  pupil.go(end, -0.001);
  pupil.go(end, 0.004);
  pupil.wait(0.3);
  CHECK(lesson.look().strokes[1].misses == 1);  // of the first touch alone
  pupil.speed = 0.1;
  pupil.events();
  for (const double share : {0.2, 0.5, 0.7}) {
    const std::vector<Point> path = pupil.path(1);
    pupil.go(path.front(), 0.005);
    const auto part = static_cast<std::size_t>(share * static_cast<double>(path.size()));
    for (std::size_t i = 0; i < part; ++i) pupil.go(path[i], -0.001);
    lesson.ignore();
    pupil.go(path[part], 0.005);
    pupil.wait(0.3);
    CHECK(pupil.events() == "begun 2, ignored 2");
  }
  pupil.write(pupil.path(1));
  CHECK(pupil.events() == "begun 2, accepted 2");
}

TEST_CASE("a pen-down that is ignored or paused is no writing, even if it is then written to its end", "[lesson]") {
  using Kind = LessonCommandKind;
  for (const std::vector<Kind>& commands : {std::vector{Kind::ignore}, std::vector{Kind::pause, Kind::resume}}) {
    Lesson lesson = lesson_on("三");
    Pupil pupil(lesson);
    const std::vector<Point> path = pupil.path(0);
    pupil.go(path.front(), 0.005);
    for (const Point& point : path) {
      pupil.go(point, -0.001);
      if (&point != &path[path.size() / 2]) continue;
      for (const Kind kind : commands) lesson.send({kind, pupil.ticks + (kind == Kind::resume ? 5 : 0)});
      pupil.wait(0.02);
    }
    pupil.go(path.back(), 0.005);
    pupil.wait(0.3);
    CHECK(pupil.events() == "restarted 1, begun 1, ignored 1");
    CHECK(lesson.look().due == 0);
  }
}

TEST_CASE("a stroke that is followed and lifted early is told so, a dot too", "[lesson]") {
  LessonOptions options = options_for();
  options.renderer.tolerances = StrokeTolerances::strict();
  for (const auto& [text, stroke, share] : {std::tuple("三", 2, 0.85), {"三", 2, 0.7}, {"永", 0, 0.5}}) {
    Lesson lesson = lesson_on(text, options);
    Pupil pupil(lesson);
    for (int before = 0; before < stroke; ++before) lesson.send({LessonCommandKind::skip});
    std::vector<Point> path = pupil.path(static_cast<std::size_t>(stroke));
    path.resize(static_cast<std::size_t>(share * static_cast<double>(path.size())));
    pupil.write(path);
    CHECK(lesson.look().reason == RefusalReason::lifted_early);
  }
}

TEST_CASE("no force is dropped at once by a change, and none sets in at once after a pause", "[lesson]") {
  LessonOptions options = options_for();
  options.strength = 0.6;
  Lesson lesson = lesson_on("三", options);
  Pupil pupil(lesson);
  double last = 0.0, largest_step = 0.0;
  pupil.on_tick = [&] {
    const double force = lesson.force().head<2>().norm();
    largest_step = std::max(largest_step, std::abs(force - last));
    last = force;
  };
  std::vector<Point> path = pupil.path(0);
  path.resize(path.size() / 2);
  for (Point& point : path) point.y() += 0.003;  // pulled aside
  pupil.go(path.front(), 0.005);
  for (const Point& point : path) pupil.go(point, -0.001);
  const double pull = last;
  CHECK(pull > 0.5);
  pupil.go(path.back(), 0.005);
  lesson.again();
  pupil.wait(0.5);
  CHECK(largest_step < 0.2 * pull);
  pupil.events();

  lesson.send({LessonCommandKind::pause});
  pupil.wait(0.1);
  pupil.go(path.back(), -0.006);  // leans on paper that is not felt
  lesson.send({LessonCommandKind::resume});
  pupil.wait(0.2);
  CHECK(lesson.force() == Eigen::Vector3d(0, 0, 0));
  CHECK(lesson.look().is_paused);
  pupil.go(path.back(), 0.002);
  pupil.wait(0.02);
  CHECK_FALSE(lesson.look().is_paused);
}

TEST_CASE("commands keep their ticks, whatever waits beside them", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  lesson.send({LessonCommandKind::skip, 400});
  lesson.send({LessonCommandKind::pause});
  pupil.wait(0.02);
  CHECK(lesson.look().is_paused);
  lesson.send({LessonCommandKind::resume});
  lesson.again(200);
  LessonOptions changed = options_for();
  changed.strength = 0.5;
  lesson.change(changed);
  pupil.wait(0.1);
  CHECK(pupil.events() == "restarted 1");
  pupil.wait(0.1);
  CHECK(pupil.events() == "restarted 1");
  pupil.wait(0.3);
  CHECK(pupil.events() == "skipped 1");
}

TEST_CASE("undo takes back one stroke, also one that is in doubt", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  pupil.write(pupil.path(0));
  std::vector<Point> early = pupil.path(1);
  early.resize(early.size() * 7 / 10);
  pupil.write(early);
  CHECK(lesson.look().ink.back().is_doubted);
  lesson.send({LessonCommandKind::undo});
  pupil.wait(0.01);
  CHECK(lesson.look().due == 1);
  CHECK(lesson.look().ink.back().fate == StrokeFate::ignored);
}

TEST_CASE("ink that was lost is no reproach to the pupil", "[lesson]") {
  LessonOptions options = options_for();
  options.max_absence = 0.1;
  Lesson lesson = lesson_on("三", options);
  Pupil pupil(lesson);
  for (std::size_t stroke = 0; stroke < 3; ++stroke) pupil.write(pupil.path(stroke));
  CHECK(lesson.look().lost_ticks > 100);
  const LessonScore score = score_lesson(lesson.writing()).front();
  CHECK(score.right_at_once == 3);
  CHECK(score.remarks.empty());
}

TEST_CASE("another strength, mode or page begins once the pen is off the paper", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  pupil.write(pupil.path(0));
  LessonOptions changed = options_for();
  changed.strength = 0.3;
  const std::vector<Point> path = pupil.path(1);
  pupil.go(path.front(), 0.005);
  for (const Point& point : path) {
    pupil.go(point, -0.001);
    if (&point == &path[path.size() / 2]) lesson.change(changed);
  }
  pupil.go(path.back(), 0.005);
  pupil.wait(0.3);
  CHECK(pupil.events() == "restarted 1, begun 1, accepted 1, begun 2, accepted 2");
  CHECK(lesson.look().due == 2);
  changed.mode = LessonMode::watch;
  lesson.change(changed);
  pupil.wait(5.0);
  CHECK(pupil.events() == "restarted 1, finished 3");
  changed.mode = LessonMode::memory;
  lesson.change(changed);
  pupil.wait(0.02);
  CHECK(lesson.look().due == 0);
  CHECK_FALSE(lesson.look().strokes[0].is_shown);
  lesson.begin({page_of("十"), page_of("人")});
  pupil.wait(0.02);
  CHECK(lesson.look().strokes.size() == 2);
  CHECK(lesson.page().characters.front().character.code == U'十');
  lesson.next();
  pupil.wait(0.02);
  lesson.look();
  CHECK(lesson.page().characters.front().character.code == U'人');
  changed.hint_time = -1.0;
  CHECK_THROWS_AS(lesson.change(changed), ValueError);
  CHECK(lesson.options().hint_time > 0.0);
}

TEST_CASE("guidance fades with success, and comes back with failure", "[lesson]") {
  LessonOptions options = options_for();
  options.renderer.guidance.assist.enabled = true;
  Lesson lesson = lesson_on("三", options);
  Pupil pupil(lesson);
  for (std::size_t stroke = 0; stroke < 3; ++stroke) pupil.write(pupil.path(stroke));
  const double faded = lesson.look().assistance;
  CHECK(faded < 0.6);
  lesson.again();
  pupil.wait(0.1);
  pupil.write(pupil.path(2));
  CHECK(lesson.look().assistance > faded);
  CHECK(lesson.look().assistance < 1.0);
}

TEST_CASE("every tick can be made again from what came in, unless a command led the renderer", "[lesson]") {
  LessonOptions options = options_for();
  options.records_all = true;
  using Kind = LessonCommandKind;
  const auto can_be_made_again = [&](const auto& act) {
    Lesson lesson = lesson_on("三", options);
    Pupil pupil(lesson);
    pupil.write(pupil.path(0));
    pupil.write(pupil.backwards(1));
    act(lesson, pupil);
    pupil.write(pupil.path(1));
    lesson.look();
    const Recording& recording = lesson.recording();
    if (!recording.setup) return false;
    const Recording again = replayed(recording);
    CHECK(std::equal(again.samples.begin(), again.samples.end(), recording.samples.begin(), recording.samples.end(),
                     [](const RecordedSample& a, const RecordedSample& b) {
                       return a.force == b.force && a.stroke == b.stroke && a.events == b.events;
                     }));
    return true;
  };
  const auto send = [&](Kind kind, bool is_on_paper = false) {
    return can_be_made_again([=](Lesson& lesson, Pupil& pupil) {
      const std::vector<Point> path = pupil.path(1);
      const std::vector<Point> half(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(path.size() / 2));
      if (!is_on_paper) lesson.send({kind});
      pupil.go(half.front(), 0.005);
      for (const Point& point : half) pupil.go(point, -0.001);
      if (is_on_paper) lesson.send({kind});
      pupil.go(half.back(), -0.001);
      pupil.go(half.back(), 0.005);
      lesson.send({Kind::resume});
      pupil.wait(0.3);
    });
  };
  CHECK(can_be_made_again([](Lesson&, Pupil&) {}));
  CHECK(send(Kind::show));
  CHECK(send(Kind::pause));
  CHECK(send(Kind::ignore));
  CHECK_FALSE(send(Kind::skip));
  CHECK_FALSE(send(Kind::undo));
  CHECK_FALSE(send(Kind::pause, true));
  CHECK_FALSE(send(Kind::ignore, true));
  CHECK(can_be_made_again([](Lesson& lesson, Pupil& pupil) {
    lesson.send({Kind::skip});
    lesson.again(pupil.ticks + 10);
  }));
  CHECK_FALSE(can_be_made_again([&](Lesson& lesson, Pupil&) { lesson.change(options); }));
  options.renderer.guidance.assist.enabled = true;
  CHECK_FALSE(can_be_made_again([](Lesson&, Pupil&) {}));  // guidance has come back after a refusal
}

TEST_CASE("what is judged is what was written in the end, and attempts are counted", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  for (int i = 0; i < 25; ++i) pupil.write(pupil.backwards(0));
  for (std::size_t stroke = 0; stroke < 3; ++stroke) pupil.write(pupil.path(stroke));
  lesson.look();
  const LessonScore right = score_lesson(lesson.writing()).front();
  CHECK(right.score.fidelity > 0.97);
  CHECK(right.score.strokes_completed == 3);
  CHECK(right.right_at_once == 2);
  REQUIRE(right.remarks.size() == 1);
  CHECK(lesson_remark_text(right.remarks[0], right.score.match.character) == "Stroke 1: 25 tries backwards.");
  CHECK(lesson_remark_text(right.remarks[0], right.score.match.character, Language("zh")) == "第1笔：25次写反了方向。");

  lesson.begin({page_of("永")});
  pupil.wait(0.02);
  lesson.look();
  for (const std::size_t stroke : {0, 1, 2, 4, 4}) pupil.write(pupil.path(stroke));
  lesson.send({LessonCommandKind::skip});
  pupil.write(pupil.path(4));
  CHECK(lesson.look().is_finished);
  const LessonScore skipped = score_lesson(lesson.writing()).front();
  CHECK(skipped.score.rms_error < 0.01 * lesson.page().characters.front().placement.em);
  CHECK(skipped.score.strokes_written == 4);
  std::string texts;
  for (const LessonRemark& remark : skipped.remarks) {
    texts += lesson_remark_text(remark, skipped.score.match.character) + "\n";
  }
  CHECK(texts == "Stroke 4 was skipped.\nStroke 4: 2 tries as another stroke.\n");
}

TEST_CASE("where the pupil's own hand is known, it is judged, and the error of the guided pen is told", "[lesson]") {
  Lesson lesson = lesson_on("三");
  Pupil pupil(lesson);
  const double em = lesson.page().characters.front().placement.em;
  pupil.beside_hand = Point(0.0, 0.03 * em);
  for (std::size_t stroke = 0; stroke < 3; ++stroke) pupil.write(pupil.path(stroke));
  lesson.look();
  const LessonScore score = score_lesson(lesson.writing()).front();
  CHECK(score.score.rms_error == Approx(0.03 * em).epsilon(0.05));
  CHECK(score.guided_error < 0.002 * em);
}

TEST_CASE("whatever a pen and commands do, the counts add up and no force acts unseen", "[lesson]") {
  constexpr int steps = calligraphy_test::sanitized ? 200'000 : 1'000'000;
  LessonOptions options = options_for();
  Lesson lesson = lesson_on("三十", options);
  Random random(7);
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(random.next() * static_cast<double>(count));
  };
  DeviceState state;
  Eigen::Vector3d velocity(0, 0, 0), goal(0.08, 0.06, 0.005);
  std::vector<Point> plan;  // of the hand on the paper, the next point last
  state.position = goal;
  std::size_t allocated = 0;
  int wrong = 0, pushed = 0, unseen = 0;
  std::array<int, 11> seen = {};
  for (int step = 0; step < steps; ++step) {
    if (random.next() < 1e-3) {
      const PracticePage& page = lesson.page();
      const LessonStroke& due = lesson.look().strokes[below(lesson.look().strokes.size())];
      const PlacedCharacter& placed = page.characters[static_cast<std::size_t>(due.character)];
      const Stroke stroke = strokes(placed.character)[static_cast<std::size_t>(due.stroke)];
      plan = calligraphy_test::path_of(stroke, placed.placement, 1e-4);
      if (random.next() < 0.8) std::reverse(plan.begin(), plan.end());
      if (random.next() < 0.3) plan.resize(below(plan.size()) + 1);
      goal = {plan.back().x(), plan.back().y(), 0.005};
    } else if (!plan.empty() && (goal - state.position).norm() < 2e-3) {
      goal = {plan.back().x() + 2e-4 * random.normal(), plan.back().y() + 2e-4 * random.normal(), -0.002};
      plan.pop_back();
      if (plan.empty()) goal.z() = 0.006;
    }
    const auto later = static_cast<std::uint64_t>(step) + below(50);
    if (random.next() < 5e-4) lesson.send({static_cast<LessonCommandKind>(below(6)), later});
    if (random.next() < 1e-4) lesson.send({LessonCommandKind::resume, later});
    if (random.next() < 1e-4) {
      options.mode = random.next() < 0.5 ? LessonMode::guided : static_cast<LessonMode>(below(5));
      options.strength = 0.8 * random.next();
      lesson.change(options, later);
    }
    velocity += 1e-3 * (9e3 * (goal - state.position) - 150.0 * velocity);
    state.position += 1e-3 * velocity;
    state.time += 1e-3;
    state.status = random.next() < 1e-4 ? DeviceStatus::disconnected : DeviceStatus::ok;
    const std::size_t before = calligraphy_test::allocations();
    lesson.update(state);
    allocated += calligraphy_test::allocations() - before;
    const LessonView& view = lesson.look();
    for (LessonEvent event; lesson.take_event(event);) ++seen[static_cast<std::size_t>(event.kind)];
    const auto total = static_cast<int>(view.strokes.size());
    const bool is_watched = view.mode == LessonMode::watch;
    wrong += !is_watched && view.accepted + view.skipped + (total - view.due) != total;
    for (const LessonStroke& stroke : view.strokes) {
      wrong += !is_watched && (stroke.fate == StrokeFate::open) != (&stroke - view.strokes.data() >= view.due);
    }
    if (step % 1000 == 0) {
      std::size_t inked = 0, judged = 0;
      for (const LessonInk& ink : view.ink) inked += ink.fate == StrokeFate::accepted ? ink.end - ink.begin : 0;
      const LessonWriting writing = lesson.writing();
      for (const RecordedSample& sample : writing.recording.samples) judged += sample.events == TickEvent::none;
      wrong += judged != inked;
    }
    unseen = view.is_paused || is_watched ? unseen + 1 : 0;
    pushed += unseen > 60 && lesson.force() != Eigen::Vector3d(0, 0, 0);
  }
  CHECK(allocated == 0);
  CHECK(wrong == 0);
  CHECK(pushed == 0);
  CHECK(*std::min_element(seen.begin(), seen.end()) > 3);  // every kind of event
}

}  // namespace lesson_tests
