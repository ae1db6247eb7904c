// The one state of the sequencer moves as docs/capture.md draws it.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/stroke_sequencer.hpp"
#include "../hard_cases.hpp"
#include "../scripted_pen.hpp"

namespace sequencer_tests {

using namespace calligraphy;
using calligraphy_test::placed;
using calligraphy_test::Sequence;
using calligraphy_test::test_device;
using Phase = WritingPhase;

namespace {

StrokeSequencer sequencer_of(char32_t code, const RendererOptions& options = {}) {
  return StrokeSequencer({placed(code)}, options, test_device(), {}, true);
}

PenState pen_at(const Point& tip, bool contact) {
  PenState pen;
  pen.contact = pen.on_paper = contact;
  pen.tip = pen.device_point = pen.position = {tip.x(), tip.y(), contact ? 0.0 : 0.005};
  return pen;
}

/// Whether the pen, lifted at `tip`, has written the stroke.
bool is_finished_in_air(StrokeSequencer& sequencer, const Point& tip) {
  bool finished = false;
  for (int i = 0; i < 25; ++i) {
    finished = finished || has_event(sequencer.update(pen_at(tip, false)).events, TickEvent::stroke_finished);
  }
  return finished;
}

/// The way of an accurate pen along stroke `index` of a page, in steps of 0.2 mm.
std::vector<Point> way_along(const StrokeSequencer& sequencer, int index) {
  const PlacedCharacter& character = sequencer.page()[0];
  return calligraphy_test::path_of(strokes(character.character)[static_cast<std::size_t>(index)], character.placement,
                                   2e-4);
}

/// Follows a sequencer in which pens wander about the strokes of a page: to their starts and ends, between them, along
/// the one that is due, pulled aside or not, and up from the paper now and then.
template <typename Visit>
void wander(StrokeSequencer& sequencer, Sequence& random, int ticks, Visit visit) {
  const int count = static_cast<int>(strokes(sequencer.page()[0].character).size());
  const WriterState* writer = &sequencer.update(pen_at({0.0, 0.0}, false));
  Point tip(0.0, 0.0);
  for (int done = 0; done < ticks;) {
    const bool writes = random.next() < 0.6 && writer->character == 0 && writer->stroke < count;
    const int stroke = writes ? writer->stroke : static_cast<int>(count * random.next());
    std::vector<Point> way = way_along(sequencer, stroke);
    const double kind = random.next();
    if (!writes && kind < 0.3) std::reverse(way.begin(), way.end());
    if (!writes && kind > 0.6)
      way = {way[static_cast<std::size_t>(random.next() * static_cast<double>(way.size() - 1))]};
    const Point aside(random.between(-1e-3, 1e-3), random.between(-1e-3, 1e-3));
    const bool strays = random.next() < 0.3, slides = random.next() < 0.3;
    const Point far(strays ? random.between(-0.02, 0.02) : 0.0, strays ? random.between(-0.02, 0.02) : 0.0);
    if (!slides) writer = &visit(sequencer.update(pen_at(tip, false)));
    for (std::size_t i = 0; i < way.size(); ++i, ++done) {
      const double middle = i > way.size() / 3 && i < way.size() / 2 ? 1.0 : 0.0;
      tip = way[i] + aside + middle * far;
      PenState pen = pen_at(tip, true);
      if (strays && i % 7 == 0) pen.force.setZero();
      writer = &visit(sequencer.update(pen));
      if (random.next() < 0.002) break;
    }
  }
}

/// The arrows of docs/capture.md.
bool is_drawn(Phase from, Phase to, const RendererOptions& options) {
  const auto is_one = [](Phase phase, std::initializer_list<Phase> phases) {
    return std::find(phases.begin(), phases.end(), phase) != phases.end();
  };
  const auto is_before = [&](Phase phase) {
    return is_one(phase, {Phase::away, Phase::in_middle, Phase::at_end, Phase::at_start, Phase::turned_away});
  };
  const auto writes = [&](Phase phase) { return is_one(phase, {Phase::guided, Phase::released}); };
  const auto is_up = [&](Phase phase) { return is_one(phase, {Phase::lifted, Phase::in_doubt}); };
  if (from == to || to == Phase::lifted) return true;
  if (to == Phase::in_doubt) return is_up(from) || writes(from) || is_before(from);
  if (is_up(from)) return is_before(to) || to == Phase::page_written;
  // Out of the box it takes up to 19 ticks until it is decided.
  if (is_before(from) && to == Phase::finished) return options.contact.lift_between_strokes;
  if (is_before(from)) return is_before(to) || is_one(to, {Phase::other_stroke, Phase::guided});
  if (!writes(from)) return false;  // finished, another stroke, page written: until the pen is lifted
  if (writes(to)) return true;
  if (to == Phase::finished) return options.contact.lift_between_strokes;
  return is_before(to) || (to == Phase::page_written && !options.contact.lift_between_strokes);
}

}  // namespace

TEST_CASE("the state of the writer moves along the arrows that are drawn, and refines the paper's", "[render]") {
  RendererOptions sliding;
  sliding.contact.lift_between_strokes = false;
  sliding.guidance.to_start = true;
  RendererOptions narrow;
  narrow.contact.box_margin = 0.0;
  std::set<std::pair<Phase, Phase>> seen;
  for (const RendererOptions& options : {RendererOptions(), sliding, narrow}) {
    for (const char32_t code : {U'三', U'永', U'北'}) {
      StrokeSequencer sequencer = sequencer_of(code, options);
      Sequence random(static_cast<unsigned>(code));
      Phase before = Phase::lifted;
      int wrong = 0, unlike_paper = 0, guided_wrongly = 0;
      for (int page = 0; page < 20; ++page) {
        sequencer.restart();
        before = Phase::lifted;
        wander(sequencer, random, 4000, [&](const WriterState& writer) -> const WriterState& {
          const Phase phase = writer.phase;
          if (before != phase) seen.emplace(before, phase);
          wrong += !is_drawn(before, phase, options);
          const bool is_lifted = phase == Phase::lifted || phase == Phase::in_doubt;
          const bool writes = phase == Phase::guided || phase == Phase::released;
          unlike_paper += is_lifted != (writer.state == InteractionState::separation);
          unlike_paper += writes != (writer.state == InteractionState::writing);
          const bool ends = has_event(writer.events, TickEvent::page_finished);
          unlike_paper += phase == Phase::page_written && !ends && writer.state != InteractionState::adjusting;
          const bool may_be_led = writer.state == InteractionState::calibration && phase != Phase::finished &&
                                  phase != Phase::other_stroke && phase != Phase::page_written;
          guided_wrongly += writer.guided && phase != Phase::guided && !may_be_led;
          guided_wrongly += !writer.guided && phase == Phase::guided;
          before = phase;
          return writer;
        });
      }
      CAPTURE(static_cast<int>(code), options.contact.lift_between_strokes, options.contact.box_margin);
      CHECK(wrong == 0);
      CHECK(unlike_paper == 0);
      CHECK(guided_wrongly == 0);
    }
  }
  // What is drawn was also walked: each phase was entered, and left for the air.
  for (const Phase phase : {Phase::page_written, Phase::finished, Phase::away, Phase::in_middle, Phase::at_end,
                            Phase::at_start, Phase::turned_away, Phase::other_stroke, Phase::guided, Phase::released}) {
    CAPTURE(static_cast<int>(phase));
    CHECK(std::any_of(seen.begin(), seen.end(), [&](const auto& arrow) { return arrow.second == phase; }));
    CHECK(seen.count({phase, Phase::lifted}) == 1);
  }
  CHECK(seen.count({Phase::guided, Phase::released}) == 1);
  CHECK(seen.count({Phase::released, Phase::guided}) == 1);
}

TEST_CASE("a page that is finished by sliding guides nobody, from that tick on", "[render]") {
  RendererOptions options;
  options.contact.lift_between_strokes = false;
  options.guidance.to_start = true;
  StrokeSequencer sequencer = sequencer_of(U'一', options);
  bool finished = false;
  std::vector<Point> way = way_along(sequencer, 0);
  way.insert(way.end(), 25, way.back());
  sequencer.update(pen_at(way.front(), false));
  for (const Point& tip : way) {
    const WriterState& writer = sequencer.update(pen_at(tip, true));
    finished = finished || has_event(writer.events, TickEvent::page_finished);
    CHECK((writer.phase == Phase::page_written) == finished);
    if (finished) CHECK_FALSE(writer.guided);
  }
  CHECK(finished);
}

TEST_CASE("the hint is that of the same tick: off the stroke as soon as guidance has let go", "[render]") {
  StrokeSequencer sequencer = sequencer_of(U'一');
  const std::vector<Point> way = way_along(sequencer, 0);
  sequencer.update(pen_at(way.front(), false));
  int released = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double aside = i > way.size() / 3 && i < way.size() / 2 ? 0.012 : 0.0;
    const WriterState& writer = sequencer.update(pen_at(way[i] + Point(0.0, aside), true));
    if (writer.state != InteractionState::writing) continue;
    CHECK((hint_in(writer.phase) == WritingHint::off_stroke) == !writer.guided);
    released += !writer.guided;
  }
  CHECK(released > 5);
}

TEST_CASE("a pen that rested on a stroke and is lifted rests on it no more where it is put down beside it",
          "[render]") {
  StrokeSequencer sequencer = sequencer_of(U'三');
  const std::vector<Point> way = way_along(sequencer, 0);
  sequencer.update(pen_at(way.front(), false));
  CHECK(sequencer.update(pen_at(way[way.size() / 2], true)).rests);
  CHECK_FALSE(sequencer.update(pen_at(way[way.size() / 2], false)).rests);
  CHECK_FALSE(sequencer.update(pen_at(way[way.size() / 2] + Point(0.0, 0.005), true)).rests);
}

TEST_CASE("a pen put down beside a stroke that it begins at once, but out of the box, feels nothing of the last one",
          "[render]") {
  // A line, and above its middle a dot without length, whose start is the whole of it.
  const std::vector<StrokeInput> inputs = {{1, {{0.2, 0.5}, {0.8, 0.5}}}, {1, {{0.5, 0.8}, {0.5, 0.8}}}};
  RendererOptions options;
  options.contact.box_margin = 0.05;
  StrokeSequencer sequencer({{make_character(U'\u4E0A', inputs), {{0.0, 0.0}, 0.04}}}, options, test_device(), {}, true);
  sequencer.update(pen_at(0.04 * Point(0.2, 0.5), false));
  for (int i = 0; i <= 110; ++i) sequencer.update(pen_at(0.04 * Point(0.2 + 0.005 * i, 0.5), true));
  for (int i = 0; i <= 26; ++i) sequencer.update(pen_at(0.04 * Point(0.75 - 0.005 * i, 0.5), true));
  CHECK(is_finished_in_air(sequencer, 0.04 * Point(0.62, 0.5)));
  sequencer.update(pen_at(0.04 * Point(0.5, 1.0), false));  // out of the box
  const WriterState& writer = sequencer.update(pen_at(0.04 * Point(0.5, 0.855), true));
  CHECK(writer.state == InteractionState::adjusting);
  CHECK(writer.rests);
  CHECK(writer.contact.backwards == 0.0);
  CHECK(writer.contact.closest.point.isApprox(0.04 * Point(0.5, 0.8)));
}

TEST_CASE("a stroke that is drawn exactly is finished with every preset, whichever way the entry of the brush points",
          "[render]") {
  for (const StrokeTolerances& tolerances :
       {StrokeTolerances::lenient(), StrokeTolerances::normal(), StrokeTolerances::strict()}) {
    RendererOptions options;
    options.tolerances = tolerances;
    for (const double entry : {0.03, 0.05, 0.07, 0.09, 0.11}) {
      for (double angle = -2.5; angle < 2.6; angle += 0.1) {
        const Point start(0.3, 0.5), way(std::cos(angle), std::sin(angle));
        const StrokeInput input{4, {start, start + 3.0 * entry * way, {0.5, 0.5}, {0.75, 0.4}}};
        StrokeSequencer sequencer({{make_character(U'\u4E3F', std::span(&input, 1)), {{0.0, 0.0}, 0.04}}}, options,
                                  test_device(), {}, true);
        for (const Point& tip : way_along(sequencer, 0)) sequencer.update(pen_at(tip, true));
        CAPTURE(tolerances.corridor, entry, angle);
        CHECK(is_finished_in_air(sequencer, {0.0, 0.0}));
      }
    }
  }
}

TEST_CASE("a stroke in doubt is decided by what is begun next", "[render]") {
  // 十 twice: 0.75 of its first stroke, then of its second.
  struct Twice {
    StrokeSequencer sequencer{{placed(U'\u5341'), placed(U'\u5341', {0.08, 0.02})}, {}, test_device(), {}, true};
    double time = 0.0;

    WriterState at(const Point& tip, bool contact) {
      PenState pen = pen_at(tip, contact);
      pen.time = time += 0.001;
      return sequencer.update(pen);
    }
    /// Says what happens on the way, from the touch to 30 ms after the lift.
    std::string write(std::size_t character, std::size_t stroke, double share = 1.0) {
      const PlacedCharacter& of = sequencer.page()[character];
      std::vector<Point> way = calligraphy_test::path_of(strokes(of.character)[stroke], of.placement, 2e-4);
      way.resize(static_cast<std::size_t>(share * static_cast<double>(way.size())));
      std::string events;
      const auto see = [&](const WriterState& writer) {
        const std::pair<TickEvent, char> names[] = {
            {TickEvent::stroke_finished, 'f'}, {TickEvent::stroke_abandoned, 'a'},
            {TickEvent::character_finished, 'c'}, {TickEvent::page_finished, 'p'}, {TickEvent::stroke_started, 's'}};
        for (const auto& [event, letter] : names) {
          if (has_event(writer.events, event)) events += letter;
        }
      };
      see(at(way.front(), false));
      for (const Point& tip : way) see(at(tip, true));
      for (int i = 0; i < 30; ++i) see(at(way.back(), false));
      return events;
    }
    Phase phase() { return at({0.0, 0.0}, false).phase; }
  };
  Twice twice;
  CHECK(twice.write(0, 0, 0.75) == "s");
  CHECK(twice.phase() == Phase::in_doubt);
  CHECK(hint_in(twice.phase()) == WritingHint::lifted_early);
  CHECK(twice.write(0, 0, 0.75) == "as");       // again
  CHECK(twice.write(0, 1, 0.75) == "fs");       // went on
  CHECK(twice.phase() == Phase::in_doubt);
  CHECK(twice.write(1, 0) == "fcsf");           // with the next character
  CHECK(twice.write(1, 1, 0.75) == "s");        // the last of the page
  for (int i = 0; i < 900; ++i) CHECK(twice.phase() == Phase::in_doubt);
  TickEvent events = TickEvent::none;
  for (int i = 0; i < 100; ++i) events |= twice.at({0.0, 0.0}, false).events;
  CHECK(events == (TickEvent::stroke_finished | TickEvent::character_finished | TickEvent::page_finished));
  CHECK(twice.phase() == Phase::lifted);

  Twice skipped;
  CHECK(skipped.write(0, 0, 0.75) == "s");
  CHECK(skipped.sequencer.skip());
  CHECK(skipped.phase() == Phase::lifted);
  CHECK(skipped.write(0, 1) == "sfc");
}

TEST_CASE("what was written is decided within 50 ms at any rate, of the loop and of the samples", "[render]") {
  for (const double rate : {200.0, 1000.0, 4000.0}) {
    for (const int every : {1, 4, 8}) {  // of so many ticks one has a fresh sample
      RendererOptions options;
      options.servo_rate = rate;
      StrokeSequencer sequencer = sequencer_of(U'\u4E09', options);
      std::vector<Point> way = way_along(sequencer, 0);
      way.resize(way.size() / 2);
      sequencer.update(pen_at(way.front(), false));
      for (const Point& tip : way) sequencer.update(pen_at(tip, true));
      int ticks = 0;
      for (bool decided = false; !decided && ticks < 1000; ++ticks) {
        PenState pen = pen_at(way.back(), false);
        if (ticks % every != 0) pen.status = TickStatus::stale;
        decided = has_event(sequencer.update(pen).events, TickEvent::stroke_abandoned);
      }
      CAPTURE(rate, every);
      CHECK(ticks / rate <= (every == 8 && rate < 1000.0 ? 0.1 : 0.05));
    }
  }
}

TEST_CASE("a pen that is put down again at once finds the stroke before decided", "[render]") {
  StrokeSequencer sequencer = sequencer_of(U'\u4E09');
  std::vector<Point> way = way_along(sequencer, 0);
  const std::vector<Point> next = way_along(sequencer, 1);
  sequencer.update(pen_at(way.front(), false));
  way.resize(way.size() / 3);
  for (const Point& tip : way) sequencer.update(pen_at(tip, true));
  CHECK_FALSE(has_event(sequencer.update(pen_at(way.back(), false)).events, TickEvent::stroke_abandoned));
  CHECK(sequencer.update(pen_at(next.front(), true)).events == (TickEvent::stroke_abandoned | TickEvent::contact));
}

TEST_CASE("one who goes on where the stroke in doubt was left does not begin the next", "[render]") {
  const std::vector<StrokeInput> inputs = {{1, {{0.1, 0.5}, {0.4, 0.5}}}, {1, {{0.5, 0.5}, {0.9, 0.5}}}};
  for (const double from : {0.31, 0.5}) {
    StrokeSequencer sequencer({{make_character(U'\u4E8C', inputs), {{0.0, 0.0}, 0.04}}}, {}, test_device(), {}, true);
    const auto draw = [&](double begin, double end) {
      sequencer.update(pen_at(0.04 * Point(begin, 0.5), false));
      for (int i = 0; i <= 100; ++i) sequencer.update(pen_at(0.04 * Point(begin + (end - begin) * i / 100, 0.5), true));
      is_finished_in_air(sequencer, 0.04 * Point(end, 0.5));
    };
    draw(0.1, 0.31);
    draw(from, from + 0.09);
    CAPTURE(from);
    CHECK(sequencer.update(pen_at({0.0, 0.0}, false)).stroke == (from > 0.4 ? 1 : 0));
  }
}

TEST_CASE("where the hand means to be does not lengthen what was written", "[render]") {
  const StrokeInput line{1, {{0.2, 0.5}, {0.34, 0.5}}, {}};
  for (const StrokeTolerances& tolerances : {StrokeTolerances::normal(), StrokeTolerances::strict()}) {
    for (const double ahead : {0.0, 0.0012}) {  // [m]
      RendererOptions options;
      options.tolerances = tolerances;
      StrokeSequencer sequencer({{make_character(U'\u4E36', std::span(&line, 1)), {{0.0, 0.0}, 0.04}}}, options,
                                test_device(), {}, true);
      std::vector<Point> way = way_along(sequencer, 0);
      way.resize(way.size() * 11 / 20);
      for (const Point& tip : way) {
        PenState pen = pen_at(tip, true);
        pen.force = {-ahead * options.grip_stiffness, 0.0, 0.0};
        sequencer.update(pen);
      }
      CAPTURE(tolerances.coverage, ahead);
      CHECK_FALSE(is_finished_in_air(sequencer, way.back()));
    }
  }
}

TEST_CASE("a pen that left the box is not guided before it is decided what it wrote", "[render]") {
  StrokeSequencer sequencer = sequencer_of(U'\u4E09');
  std::vector<Point> way = way_along(sequencer, 0);
  way.resize(way.size() / 2);
  sequencer.update(pen_at(way.front(), false));
  for (const Point& tip : way) sequencer.update(pen_at(tip, true));
  sequencer.update(pen_at(way.back() + Point(0.0, 0.1), true));
  TickEvent events = TickEvent::none;
  for (int i = 0; i < 25 && events == TickEvent::none; ++i) {
    const WriterState& writer = sequencer.update(pen_at(way.back(), true));
    events = writer.events;
    if (events != TickEvent::none) continue;
    CHECK(writer.phase == Phase::away);
    CHECK_FALSE(writer.guided);
  }
  CHECK(events == TickEvent::stroke_abandoned);
}

TEST_CASE("the start of the next character decides, however much the boxes overlap", "[render]") {
  StrokeSequencer sequencer({{*built_in_characters().find(U'\u4E00'), {{0.02, 0.02}, 0.04}},
                             {*built_in_characters().find(U'\u4E00'), {{0.025, 0.02}, 0.04}}},
                            {}, test_device(), {}, true);
  std::vector<Point> way = way_along(sequencer, 0);
  const Point again = way.front(), next = again + Point(0.005, 0.0);
  way.resize(way.size() * 3 / 4);
  sequencer.update(pen_at(way.front(), false));
  for (const Point& tip : way) sequencer.update(pen_at(tip, true));
  CHECK_FALSE(is_finished_in_air(sequencer, way.back()));
  CHECK(sequencer.update(pen_at(again, true)).character == 0);
  sequencer.update(pen_at(again, false));
  CHECK(sequencer.update(pen_at(next, true)).character == 1);
}

TEST_CASE("a bad sample changes nothing that is known of the writer, and happens nowhere", "[render]") {
  StrokeSequencer sequencer = sequencer_of(U'一');
  const std::vector<Point> way = way_along(sequencer, 0);
  sequencer.update(pen_at(way.front(), false));
  CHECK(has_event(sequencer.update(pen_at(way.front(), true)).events, TickEvent::contact));
  for (const TickStatus status : {TickStatus::stale, TickStatus::bad_sample, TickStatus::device_fault}) {
    PenState pen = pen_at(way.back(), false);
    pen.status = status;
    const WriterState& writer = sequencer.update(pen);
    CHECK(writer.events == TickEvent::none);
    CHECK(writer.phase == Phase::at_start);
    CHECK(writer.guided);
  }
}

}  // namespace sequencer_tests
