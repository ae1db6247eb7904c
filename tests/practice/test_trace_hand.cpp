#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

#include "../catch.hpp"
#include "../judge/pen_traces.hpp"
#include "pages.hpp"
#include "practice/trace_hand.hpp"

using namespace calligraphy;
using calligraphy_test::copy_of;
using calligraphy_test::page_of;
using calligraphy_test::session;
using calligraphy_test::trace_of;

namespace {

const Eigen::Vector3d start(0.08, 0.06, 0.02);

double max_traced_step(const Recording& recording) {
  double largest = 0.0;
  for (std::size_t i = 1; i < recording.samples.size(); ++i) {
    largest = std::max(largest, (recording.samples[i].force - recording.samples[i - 1].force).norm());
  }
  return largest;
}

/// Checks that there is no fault, force and force step are within their limits, and the hand reaches its end.
void check_bounded(const Character& character, const PenTrace& trace, const SessionOptions& options) {
  const PracticePage page = lay_out(std::span(&character, 1)).front();
  const Recording recording = follow_trace(page, trace, options);
  const HapticRenderer renderer(page.characters, upright_page(page.width, page.height), options.device,
                                options.renderer);
  CAPTURE(encode_utf8(trace.character), trace.strokes.size());
  REQUIRE(recording.samples.size() > 100);
  CHECK(std::all_of(recording.samples.begin(), recording.samples.end(), [](const RecordedSample& sample) {
    return sample.status == TickStatus::ok && sample.force.allFinite();
  }));
  CHECK(max_traced_step(recording) <= renderer.max_force_step() * (1.0 + 1e-12));
  CHECK(score_page(page, recording).front().peak_force <= options.device.peak_force);
  const double written = trace.strokes.back().back().time - trace.strokes.front().front().time;
  CHECK(recording.samples.back().time > std::min(written, 1.0));
  CHECK(recording.samples.back().device_point.z() > 0.004);
}

}  // namespace

TEST_CASE("a hand on a trace is at the pen's recorded position at the recorded time", "[practice]") {
  const PracticePage page = page_of("十");
  const PlacedCharacter& placed = page.characters.front();
  const PenTrace trace = trace_of(U'十', copy_of(placed.character));
  const TraceHand hand(trace, placed, start);
  CHECK(hand.at(0.0).point == start);
  CHECK(hand.at(-1.0).point == start);
  const BoxMap map = fit_box(pen_paths(trace), placed.character);
  const auto pressed = [&hand](double time) { return std::abs(hand.at(time).point.z() + 0.0025) < 1e-12; };
  constexpr double step = 1e-4;
  double time = 0.0;
  for (const PenStroke& stroke : trace.strokes) {
    while (time < hand.duration() && !pressed(time)) time += step;
    const double shift = time - stroke.front().time;  // accurate to a step, in which the pen moves 0.002 mm
    for (const TimedPoint& timed : stroke) {
      const Point expected = placed.placement.to_page(map(timed.point));
      CHECK((hand.at(timed.time + shift).point.head<2>() - expected).norm() < 5e-6);
    }
    while (pressed(time)) time += step;
    CHECK(time - shift == Approx(stroke.back().time).margin(2.0 * step));
  }
  CHECK(hand.at(hand.duration()).point.z() == Approx(0.008));
  CHECK(hand.at(hand.duration() + 10.0).point == hand.at(hand.duration()).point);
}

TEST_CASE("a recording keeps what the pen sensed: a person's on the paper, a simulated writer's everywhere", "[practice]") {
  const PracticePage page = page_of("十");
  PenTrace trace = trace_of(U'十', copy_of(page.characters.front().character));
  const StylusState leaning = {0.3, not_a_number, 1.0, -2.0, not_a_number, 0.0};
  for (PenStroke& stroke : trace.strokes) {
    for (TimedPoint& point : stroke) point.stylus = leaning;
  }
  const SessionOptions options = session({}, FeedbackMode::force);
  const Recording followed = follow_trace(page, trace, options), written = write_page(page, options);
  for (const Recording* recording : {&followed, &written}) {
    REQUIRE(recording->inputs.size() == recording->samples.size());
    for (std::size_t i = 1; i < recording->inputs.size(); ++i) {  // 0: before the hand has moved
      const DeviceState& input = recording->inputs[i];
      CHECK(upright_page(page.width, page.height).to_page(input.position) == recording->samples[i].device_point);
      const bool is_person = recording == &followed && input.stylus == leaning;
      const bool is_pressed = input.stylus.pressure > 0.0 && input.stylus.height == 0.0;
      const bool is_in_air = input.stylus.pressure == 0.0 && input.stylus.height >= 0.0;
      CHECK(is_person + is_pressed + is_in_air == 1 + (is_person && is_pressed));
    }
  }
  const auto is = [&](const DeviceState& input) { return input.stylus == leaning; };
  CHECK(std::count_if(followed.inputs.begin(), followed.inputs.end(), is) > 500);
  const auto half = [](const DeviceState& input) { return input.stylus.pressure == 0.5; };  // while writing
  CHECK(std::count_if(written.inputs.begin(), written.inputs.end(), half) > 500);
}

TEST_CASE("a hand on a trace never jumps", "[practice]") {
  const PracticePage page = page_of("永");
  const TraceHand hand(trace_of(U'永', copy_of(page.characters.front().character)), page.characters.front(), start);
  for (double time = 0.0; time < hand.duration(); time += 1e-3) {
    CHECK((hand.at(time + 1e-3).point - hand.at(time).point).norm() < 0.6e-3);  // 0.6 m/s
  }
}

TEST_CASE("the pen-downs of a recording are its contacts, without bounces and rejected samples", "[practice]") {
  const Placement placement{{0.05, 0.04}, 0.04};
  Recording recording;
  const auto add = [&](double seconds, InteractionState state, TickStatus status = TickStatus::ok) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds * 1e3)); ++i) {
      RecordedSample sample;
      sample.time = 1e-3 * static_cast<double>(recording.samples.size());
      sample.pen_tip = {0.06, 0.05, 0.0};
      sample.state = state;
      sample.status = status;
      recording.samples.push_back(sample);
    }
  };
  constexpr auto up = InteractionState::separation;
  add(0.1, up);
  add(0.2, InteractionState::calibration);
  add(0.03, up);  // nobody lifts a pen for 30 ms
  add(0.2, InteractionState::writing);
  add(0.08, up);
  add(0.01, InteractionState::adjusting);
  add(0.04, InteractionState::adjusting, TickStatus::bad_sample);
  add(0.01, InteractionState::adjusting);
  add(0.09, InteractionState::separation, TickStatus::bad_sample);  // nobody is at another stroke within 90 ms
  add(0.01, InteractionState::adjusting);
  add(0.11, InteractionState::separation, TickStatus::bad_sample);
  add(0.04, InteractionState::adjusting);
  add(0.04, InteractionState::adjusting, TickStatus::bad_sample);
  add(0.005, up);  // a lift was seen
  add(0.04, InteractionState::adjusting, TickStatus::bad_sample);
  add(0.05, InteractionState::adjusting);
  const std::vector<PenPath> paths = pen_paths(recording, placement);
  REQUIRE(paths.size() == 4);
  CHECK(paths[0].size() == 400);
  CHECK(paths[1].size() == 30);
  CHECK(paths[2].size() == 40);
  CHECK(paths[3].size() == 50);
  CHECK(paths[0].front().isApprox(Point(0.25, 0.25)));
}

TEST_CASE("a lift of exactly 50 ms is a bounce at any time", "[practice]") {
  for (int start = 0; start < 300; ++start) {
    Recording recording;
    for (int i = 0; i < 100; ++i) {
      RecordedSample sample;
      sample.time = 1e-3 * (start + i);
      sample.pen_tip = {0.06, 0.05, 0.0};
      sample.state = 25 < i && i < 75 ? InteractionState::separation : InteractionState::writing;
      recording.samples.push_back(sample);
    }
    CAPTURE(start);
    CHECK(pen_paths(recording, {{0.05, 0.04}, 0.04}).size() == 1);
  }
}

TEST_CASE("the bounding box of the writing is mapped onto that of the character", "[practice]") {
  const Character ten = page_of("十").characters.front().character;
  std::vector<PenPath> paths = copy_of(ten);
  const auto box_after = [&] {
    const BoxMap map = fit_box(paths, ten);
    Eigen::AlignedBox2d box;
    for (const PenPath& path : paths) {
      for (const Point& point : path) box.extend(map(point));
    }
    return box;
  };
  const Eigen::AlignedBox2d wanted = bounding_box({ten, {Point::Zero(), 1.0}});
  for (PenPath& path : paths) {
    for (Point& point : path) point = Point(0.3 * point.x() + 2.0, 0.4 * point.y() - 1.0);
  }
  CHECK(box_after().isApprox(wanted, 1e-9));

  SECTION("a bounce far away does not count") {
    const BoxMap before = fit_box(paths, ten);
    paths.push_back({{9.0, 9.0}});
    CHECK(fit_box(paths, ten).offset.isApprox(before.offset));
    CHECK(fit_box(paths, ten).scale.isApprox(before.scale));
  }
  SECTION("a heng is not stretched into a band") {
    const Character one = page_of("一").characters.front().character;
    const PenPath heng = {{0.2, 0.5}, {0.5, 0.51}, {0.6, 0.5}};
    const BoxMap map = fit_box(std::vector<PenPath>{heng}, one);
    CHECK(map.scale.x() == map.scale.y());
  }
  SECTION("the two scales differ by a factor of at most 1.5") {
    for (PenPath& path : paths) {
      for (Point& point : path) point.x() *= 10.0;
    }
    const BoxMap map = fit_box(paths, ten);
    CHECK(map.scale.y() / map.scale.x() == Approx(1.5));
  }
  SECTION("without paths the map is the identity") {
    const BoxMap map = fit_box({}, ten);
    CHECK(map.scale == Point(1.0, 1.0));
    CHECK(map.offset == Point(0.0, 0.0));
  }
}

TEST_CASE("a trace drawn exactly on the template is completed under guidance, and the device draws the same strokes",
          "[practice]") {
  for (const char* const text : {"十", "永", "北", "书"}) {
    const PracticePage page = page_of(text);
    const PlacedCharacter& placed = page.characters.front();
    const PenTrace trace = trace_of(placed.character.code, copy_of(placed.character));
    const Recording recording = follow_trace(page, trace, session({}, FeedbackMode::force));
    CAPTURE(text);
    CHECK(score_page(page, recording).front().strokes_completed == placed.character.stroke_count());
    const std::vector<PenPath> drawn = pen_paths(recording, placed.placement);
    CHECK(drawn.size() == trace.strokes.size());
    for (const StrokeRemark& remark : match_strokes(placed.character, drawn).remarks) {
      FAIL_CHECK(remark_text(remark, placed.character));
    }
  }
}

TEST_CASE("a hand on a trace waits for what becomes of the last stroke", "[practice]") {
  const PracticePage page = page_of("国");  // its other strokes span its box, to which the trace is fitted
  const PlacedCharacter& placed = page.characters.front();
  std::vector<PenPath> paths = copy_of(placed.character);
  const Point start = paths.back().front(), end = paths.back().back();
  paths.back() = {start, start + 0.4 * (end - start), start + 0.8 * (end - start)};
  const PenTrace trace = trace_of(placed.character.code, paths);
  const Recording recording = follow_trace(page, trace, session({}, FeedbackMode::vision));
  CHECK(has_event(recording.samples.back().events | recording.samples[recording.samples.size() - 2].events,
                  TickEvent::page_finished));
  CHECK(score_page(page, recording).front().strokes_completed == placed.character.stroke_count());
}

TEST_CASE("the device's path matches the same strokes as the pen's, accepted by the renderer or not", "[practice]") {
  const PracticePage page = page_of("北");
  const PlacedCharacter& placed = page.characters.front();
  std::vector<PenPath> paths = copy_of(placed.character);
  std::swap(paths[1], paths[3]);
  std::reverse(paths[4].begin(), paths[4].end());
  const MatchResult written = match_strokes(placed.character, paths);
  for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
    const Recording recording = follow_trace(page, trace_of(placed.character.code, paths), session({}, mode));
    const MatchResult drawn = match_strokes(placed.character, pen_paths(recording, placed.placement));
    for (const StrokeRemark& remark : drawn.remarks) INFO(remark_text(remark, drawn.character));
    REQUIRE(drawn.remarks.size() == written.remarks.size());
    for (std::size_t i = 0; i < drawn.remarks.size(); ++i) {
      CHECK(remark_text(drawn.remarks[i], drawn.character) == remark_text(written.remarks[i], written.character));
    }
  }
}

TEST_CASE("people's pens hold the device without a fault, and no force or force step exceeds its limit",
          "[practice][corpus]") {
  const bool everything = GENERATE(false, true);
  CAPTURE(everything);
  SessionOptions options = session({}, FeedbackMode::force);
  if (everything) options.renderer = RendererOptions::everything(options.device);
  const auto traces = calligraphy_test::traces_of_people();
  const auto set = calligraphy_test::imported_characters();
  const std::size_t stride = 1;
  for (std::size_t i = 0; i < traces.size(); i += stride) {
    const auto stored = set ? set->find(traces[i].character) : std::nullopt;
    const Character character = stored ? stored->character() : calligraphy_test::own_character(traces[i]);
    check_bounded(character, traces[i], options);
  }
}

TEST_CASE("a person who writes the wrong character causes no fault and no force step above the limit",
          "[practice][corpus]") {
  const bool everything = GENERATE(false, true);
  SessionOptions options = session({}, FeedbackMode::force);
  if (everything) options.renderer = RendererOptions::everything(options.device);
  const auto traces = calligraphy_test::traces_of_people();
  for (std::size_t i = 0; i < traces.size(); i += 8) {
    check_bounded(page_of("永").characters.front().character, traces[i], options);
  }
}

TEST_CASE("synthetic hands cause no fault and no force step above the limit on any device", "[practice]") {
  const std::string name = GENERATE("omni", "touch", "desktop", "premium-1.5", "ideal");
  const bool everything = GENERATE(false, true);
  CAPTURE(name, everything);
  SessionOptions options = session({}, FeedbackMode::force);
  options.device = device_profile(name);
  const Capabilities& capabilities = options.device;
  options.renderer = everything ? RendererOptions::everything(capabilities) : RendererOptions::for_device(capabilities);
  const Character eternal = page_of("永").characters.front().character;
  std::vector<PenPath> paths = copy_of(eternal);
  std::swap(paths[0], paths[3]);
  std::reverse(paths[1].begin(), paths[1].end());
  check_bounded(eternal, trace_of(U'永', paths), options);
}

TEST_CASE("a trace that no hand can follow is rejected", "[practice]") {
  const PracticePage page = page_of("十");
  const auto refused = [&](const PenTrace& trace) {
    CHECK_THROWS_AS(follow_trace(page, trace, session({}, FeedbackMode::force)), ValueError);
  };
  refused({U'十', "none", 1000.0, {}});
  refused({U'十', "none", 1000.0, {{}}});
  refused({U'十', "none", 1000.0, {{{Point(0, 0), 1.0}, {Point(0, 0), 0.5}}}});
  refused({U'十', "none", 1000.0, {{{Point(0, 0), std::nan("")}}}});
  refused({U'十', "none", 1000.0, {{{Point(0, std::nan("")), 0.0}}}});
  CHECK_THROWS_AS(follow_trace(page_of("十人"), trace_of(U'十', copy_of(page.characters[0].character)),
                               session({}, FeedbackMode::force)),
                  ValueError);
}
