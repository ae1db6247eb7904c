// Scores through the C interface are those of C++, to the last bit.
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

#include "c_interface.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

Owned<calligraphy_recording> recording_of(const calligraphy_page* page) {
  calligraphy_recording* recording = nullptr;
  REQUIRE(calligraphy_recording_create(page, 0.0, &recording) == CALLIGRAPHY_OK);
  return Owned<calligraphy_recording>(recording);
}

Owned<calligraphy_score> score_of(const calligraphy_recording* recording,
                                  calligraphy_tolerance tolerance = CALLIGRAPHY_TOLERANCE_NORMAL) {
  calligraphy_score* score = nullptr;
  REQUIRE(calligraphy_score_recording(recording, tolerance, &score) == CALLIGRAPHY_OK);
  return Owned<calligraphy_score>(score);
}

/// What a recording needs of a tick.
calligraphy_tick tick_of(const RecordedSample& sample) {
  auto tick = sized<calligraphy_tick>();
  tick.status = static_cast<std::int32_t>(sample.status);
  tick.state = static_cast<std::int32_t>(sample.state);
  tick.events = static_cast<std::uint32_t>(sample.events);
  tick.character = sample.character;
  tick.stroke = sample.stroke;
  tick.time = sample.time;
  for (int i = 0; i < 3; ++i) {
    tick.page_force[i] = sample.force[i];
    tick.device_point[i] = sample.device_point[i];
    tick.pen_tip[i] = sample.pen_tip[i];
  }
  return tick;
}

/// Equal, or both not measured.
bool equal(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void check_character(const calligraphy_character_score& here, const CharacterScore& there) {
  CHECK(here.code == there.character);
  CHECK(here.stroke_count == there.stroke_count);
  CHECK(here.strokes_written == there.strokes_written);
  CHECK(here.strokes_completed == there.strokes_completed);
  CHECK(here.pen_down_count == static_cast<int>(there.pen_downs.size()));
  CHECK(here.order_mistakes == there.order_mistakes());
  CHECK(here.direction_mistakes == there.direction_mistakes());
  CHECK(here.lost_samples == there.lost_samples);
  CHECK(here.pen_ups == there.motion.pen_ups);
  CHECK(here.velocity_peaks == there.motion.velocity_peaks);
  CHECK(equal(here.time, there.time));
  CHECK(equal(here.rms_error, there.rms_error));
  CHECK(equal(here.max_error, there.max_error));
  CHECK(equal(here.overall_error, there.overall_error));
  CHECK(equal(here.coverage, there.coverage));
  CHECK(equal(here.dtw_distance, there.dtw_distance));
  CHECK(equal(here.contour, there.contour));
  CHECK(equal(here.external_sequence, there.external_sequence));
  CHECK(equal(here.internal_sequence, there.internal_sequence));
  CHECK(equal(here.fidelity, there.fidelity));
  CHECK(equal(here.mean_pressure, there.mean_pressure));
  CHECK(equal(here.peak_force, there.peak_force));
  CHECK(equal(here.max_force_step, there.max_force_step));
  CHECK(equal(here.duration, there.motion.duration));
  CHECK(equal(here.time_on_paper, there.motion.time_on_paper));
  CHECK(equal(here.time_in_air, there.motion.time_in_air));
  CHECK(equal(here.path_length, there.motion.path_length));
  CHECK(equal(here.mean_speed, there.motion.mean_speed));
  CHECK(equal(here.peak_speed, there.motion.peak_speed));
  CHECK(equal(here.smoothness, there.motion.smoothness));
}

void check_stroke(const calligraphy_stroke_score& here, const StrokeScore& there) {
  CHECK(here.pen_down == there.pen_down);
  CHECK((here.completed != 0) == there.completed);
  CHECK(equal(here.coverage, there.coverage));
  CHECK(equal(here.rms_error, there.rms_error));
  CHECK(equal(here.max_error, there.max_error));
  CHECK(equal(here.overall_error, there.overall_error));
  CHECK(equal(here.dtw_distance, there.dtw_distance));
}

void check_pen_down(const calligraphy_pen_down_score& here, const PenDownScore& there) {
  CHECK(here.velocity_peaks == there.motion.velocity_peaks);
  CHECK(here.begin == there.motion.begin);
  CHECK(here.end - here.begin == Approx(there.motion.duration).margin(1e-12));
  CHECK(equal(here.path_length, there.motion.path_length));
  CHECK(equal(here.mean_speed, there.motion.mean_speed));
  CHECK(equal(here.peak_speed, there.motion.peak_speed));
  CHECK(equal(here.smoothness, there.motion.smoothness));
  CHECK(equal(here.mean_pressure, there.mean_pressure));
}

void check_match(const calligraphy_match* here, const MatchResult& there) {
  auto drawn = sized<calligraphy_drawn_stroke>();
  for (std::size_t i = 0; i < there.drawn.size(); ++i) {
    REQUIRE(calligraphy_match_drawn(here, static_cast<std::int32_t>(i), &drawn) == CALLIGRAPHY_OK);
    CHECK(drawn.stroke == there.drawn[i].stroke);
    CHECK(drawn.direction == static_cast<std::int32_t>(there.drawn[i].direction));
  }
  std::int32_t count = 0;
  REQUIRE(calligraphy_match_remark_count(here, &count) == CALLIGRAPHY_OK);
  REQUIRE(count == static_cast<std::int32_t>(there.remarks.size()));
  const char* reason = nullptr;
  for (std::int32_t i = 0; i < count; ++i) {
    REQUIRE(calligraphy_match_remark_text(here, i, "zh", &reason) == CALLIGRAPHY_OK);
    CHECK(reason == remark_text(there.remarks[static_cast<std::size_t>(i)], there.character, Language("zh")));
  }
}

void check_scores(const calligraphy_score* score, const std::vector<CharacterScore>& expected) {
  auto character = sized<calligraphy_character_score>();
  auto stroke = sized<calligraphy_stroke_score>();
  auto pen_down = sized<calligraphy_pen_down_score>();
  for (std::int32_t c = 0; c < static_cast<std::int32_t>(expected.size()); ++c) {
    const CharacterScore& there = expected[static_cast<std::size_t>(c)];
    REQUIRE(calligraphy_score_character(score, c, &character) == CALLIGRAPHY_OK);
    check_character(character, there);
    for (std::int32_t i = 0; i < there.stroke_count; ++i) {
      REQUIRE(calligraphy_score_stroke(score, c, i, &stroke) == CALLIGRAPHY_OK);
      check_stroke(stroke, there.strokes[static_cast<std::size_t>(i)]);
    }
    for (std::int32_t i = 0; i < character.pen_down_count; ++i) {
      REQUIRE(calligraphy_score_pen_down(score, c, i, &pen_down) == CALLIGRAPHY_OK);
      check_pen_down(pen_down, there.pen_downs[static_cast<std::size_t>(i)]);
    }
    calligraphy_match* match = nullptr;
    REQUIRE(calligraphy_score_match(score, c, &match) == CALLIGRAPHY_OK);
    check_match(Owned<calligraphy_match>(match).get(), there.match);
    CHECK(calligraphy_score_stroke(score, c, there.stroke_count, &stroke) == CALLIGRAPHY_INVALID_VALUE);
    CHECK(calligraphy_score_pen_down(score, c, character.pen_down_count, &pen_down) == CALLIGRAPHY_INVALID_VALUE);
    CHECK(error_says("path = "));
  }
  const auto count = static_cast<std::int32_t>(expected.size());
  CHECK(calligraphy_score_character(score, count, &character) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("character = " + std::to_string(count)));
}

/// A page, written tick by tick through the C interface.
struct Writing {
  explicit Writing(const char* text) : page(page_of(text)) {}

  Owned<calligraphy_page> page;
  Owned<calligraphy_renderer> renderer = renderer_of(page.get(), profile());
  Owned<calligraphy_recording> recording = recording_of(page.get());
  MotionMapping mapping = upright_page(0.16, 0.12);
  double time = 0.0;

  /// Puts the pen down, draws a stroke, turned about its middle [rad], and lifts the pen.
  void write(int stroke, double turn = 0.0) {
    double points[2 * 64];
    std::size_t count = 0;
    REQUIRE(calligraphy_page_polyline(page.get(), 0, stroke, CALLIGRAPHY_PATH, 0.0, points, 64, &count) ==
            CALLIGRAPHY_OK);
    std::vector<Point> corners;
    for (std::size_t i = 0; i < count; ++i) corners.emplace_back(points[2 * i], points[2 * i + 1]);
    const Point middle = 0.5 * (corners.front() + corners.back());
    for (Point& corner : corners) corner = middle + Eigen::Rotation2Dd(turn) * (corner - middle);
    hold(corners.front(), 0.008);
    for (std::size_t i = 1; i < corners.size(); ++i) {
      for (int step = 0; step <= 300; ++step) {
        tick(corners[i - 1] + (corners[i] - corners[i - 1]) * step / 300.0, -0.002);
      }
    }
    hold(corners.back(), 0.008);
  }

  void hold(const Point& at, double height) {
    for (int i = 0; i < 100; ++i) tick(at, height);
  }

  void tick(const Point& at, double height) {
    auto state = sized<calligraphy_device_state>();
    auto result = sized<calligraphy_tick>();
    const Eigen::Vector3d position = mapping.to_device({at.x(), at.y(), height});
    for (int i = 0; i < 3; ++i) state.position[i] = position[i];
    state.time = time += 1e-3;
    REQUIRE(calligraphy_renderer_update(renderer.get(), &state, &result) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_recording_add(recording.get(), &result) == CALLIGRAPHY_OK);
  }
};

}  // namespace

TEST_CASE("the scores of a page that a simulated writer wrote are those of C++") {
  const PracticePage page = page_in_cpp(U"永十");
  SessionOptions options;
  options.device = device_profile("desktop");
  options.renderer = RendererOptions::for_device(options.device);
  options.skill = WriterSkill::novice();
  options.skill.wrong_direction = options.skill.wrong_order = 0.4;
  const Recording written = write_page(page, options);
  const auto page_in_c = page_of("永十");
  const auto recording = recording_of(page_in_c.get());
  for (const RecordedSample& sample : written.samples) {
    const calligraphy_tick tick = tick_of(sample);
    REQUIRE(calligraphy_recording_add(recording.get(), &tick) == CALLIGRAPHY_OK);
  }
  const std::vector<CharacterScore> expected = score_page(page, written);
  REQUIRE(expected[0].match.remarks.size() > 1);
  REQUIRE(expected[0].mean_pressure > 0.0);
  check_scores(score_of(recording.get()).get(), expected);
}

TEST_CASE("a score reads what was written up to now") {
  Writing writing("十");
  auto character = sized<calligraphy_character_score>();
  const auto read = [&] {
    const auto score = score_of(writing.recording.get());
    REQUIRE(calligraphy_score_character(score.get(), 0, &character) == CALLIGRAPHY_OK);
  };
  read();
  CHECK(character.pen_down_count == 0);
  CHECK(character.strokes_written == 0);
  CHECK(std::isnan(character.overall_error));
  writing.write(0);
  read();
  CHECK(character.strokes_written == 1);
  CHECK(character.strokes_completed == 1);
  CHECK(std::isnan(character.time));
  writing.write(1);
  read();
  CHECK(character.strokes_completed == 2);
  CHECK(character.pen_down_count == 2);
  CHECK(character.rms_error < 2e-4);
  CHECK(character.time == Approx(0.8).margin(0.05));
  CHECK(character.fidelity > 0.95);
}

TEST_CASE("mistakes of order and direction are counted") {
  Writing writing("三");
  writing.write(2);
  writing.write(0);
  writing.write(1);
  auto character = sized<calligraphy_character_score>();
  REQUIRE(calligraphy_score_character(score_of(writing.recording.get()).get(), 0, &character) == CALLIGRAPHY_OK);
  CHECK(character.order_mistakes == 1);
  CHECK(character.direction_mistakes == 0);
  Writing another("三");
  for (const int stroke : {0, 1, 2}) another.write(stroke, stroke == 1 ? std::numbers::pi : 0.0);
  REQUIRE(calligraphy_score_character(score_of(another.recording.get()).get(), 0, &character) == CALLIGRAPHY_OK);
  CHECK(character.order_mistakes == 0);
  CHECK(character.direction_mistakes == 1);
}

TEST_CASE("a stroke that is turned is scored by the tolerance") {
  Writing writing("一");
  writing.write(0, 0.9);
  const std::pair<calligraphy_tolerance, int> expected[] = {{CALLIGRAPHY_TOLERANCE_STRICT, 1},
                                                            {CALLIGRAPHY_TOLERANCE_NORMAL, 0}};
  for (const auto& [tolerance, remarks] : expected) {
    calligraphy_match* match = nullptr;
    std::int32_t count = -1;
    REQUIRE(calligraphy_score_match(score_of(writing.recording.get(), tolerance).get(), 0, &match) == CALLIGRAPHY_OK);
    const Owned<calligraphy_match> owned(match);
    REQUIRE(calligraphy_match_remark_count(match, &count) == CALLIGRAPHY_OK);
    CHECK(count == remarks);
  }
}

TEST_CASE("a skipped stroke leaves a character that was not completed") {
  for (const int skipped : {0, 1}) {
    Writing writing("十");
    std::int32_t was_skipped = 0;
    for (const int stroke : {0, 1}) {
      if (stroke != skipped) {
        writing.write(stroke);
        continue;
      }
      REQUIRE(calligraphy_renderer_skip_stroke(writing.renderer.get(), &was_skipped) == CALLIGRAPHY_OK);
      CHECK(was_skipped == 1);
      writing.hold({0.08, 0.06}, 0.008);
    }
    CHECK(calligraphy_renderer_skip_stroke(writing.renderer.get(), &was_skipped) == CALLIGRAPHY_OK);
    CHECK(was_skipped == 0);
    CHECK(calligraphy_renderer_skip_stroke(writing.renderer.get(), nullptr) == CALLIGRAPHY_OK);
    const auto score = score_of(writing.recording.get());
    auto character = sized<calligraphy_character_score>();
    REQUIRE(calligraphy_score_character(score.get(), 0, &character) == CALLIGRAPHY_OK);
    CHECK(character.strokes_written == 1);
    CHECK(character.strokes_completed == 1);
    CHECK(character.pen_down_count == 1);
    CHECK(std::isnan(character.time));
    for (const int stroke : {0, 1}) {
      auto result = sized<calligraphy_stroke_score>();
      REQUIRE(calligraphy_score_stroke(score.get(), 0, stroke, &result) == CALLIGRAPHY_OK);
      CHECK(result.completed == (stroke != skipped));
      CHECK((result.pen_down < 0) == (stroke == skipped));
    }
  }
}

TEST_CASE("ticks of another page, or in another order, are refused") {
  Writing writing("十");
  writing.write(0);
  calligraphy_score* score = nullptr;
  auto tick = sized<calligraphy_tick>();
  tick.time = 0.5 * writing.time;
  REQUIRE(calligraphy_recording_add(writing.recording.get(), &tick) == CALLIGRAPHY_OK);
  CHECK(calligraphy_score_recording(writing.recording.get(), CALLIGRAPHY_TOLERANCE_NORMAL, &score) ==
        CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("time"));
  const auto other = recording_of(writing.page.get());
  tick.stroke = 3;
  REQUIRE(calligraphy_recording_add(other.get(), &tick) == CALLIGRAPHY_OK);
  CHECK(calligraphy_score_recording(other.get(), CALLIGRAPHY_TOLERANCE_NORMAL, &score) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("the recording is of another page"));
  CHECK(score == nullptr);
}

TEST_CASE("a recording and a score outlive what they were made from") {
  Writing writing("十");
  writing.write(0);
  writing.page.reset();
  writing.renderer.reset();
  const auto score = score_of(writing.recording.get());
  writing.recording.reset();
  auto character = sized<calligraphy_character_score>();
  REQUIRE(calligraphy_score_character(score.get(), 0, &character) == CALLIGRAPHY_OK);
  CHECK(character.strokes_completed == 1);
}
