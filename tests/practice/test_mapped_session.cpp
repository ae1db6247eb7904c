// Sessions on a desk and at motion scales other than 1.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/practice/live_session.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;
using calligraphy_test::page_of;
using calligraphy_test::same;
using calligraphy_test::session;

namespace {

MotionMapping desk(const PracticePage& page, double scale = 1.0) { return desk_page(page.width, page.height, scale); }
MotionMapping upright(const PracticePage& page, double scale = 1.0) {
  return upright_page(page.width, page.height, scale);
}

/// The largest difference of the pen tips [m], or infinity if one session lasted longer.
double difference(const Recording& a, const Recording& b) {
  if (a.samples.size() != b.samples.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    largest = std::max(largest, (a.samples[i].pen_tip - b.samples[i].pen_tip).norm());
  }
  return largest;
}

/// A session at a motion scale that is similar to `at_one`: the device and the grip, seen from the page, are the same.
/// With v_page = K v and f_page = f / K, impedances are K^2 times as large on the device, forces K times, lengths 1 /
/// K.
SessionOptions similar(SessionOptions at_one, double scale) {
  const double square = scale * scale;
  Capabilities& device = at_one.device;
  for (double* impedance :
       {&device.apparent_mass, &device.viscous_friction, &device.usable_stiffness, &at_one.skill.grip.mass,
        &at_one.skill.grip.damping, &at_one.skill.grip.stiffness, &at_one.renderer.grip_stiffness}) {
    *impedance *= square;
  }
  for (double* force : {&device.peak_force, &device.continuous_force, &device.force_step, &device.coulomb_friction,
                        &at_one.renderer.limits.in_plane_rate, &at_one.renderer.limits.normal_rate}) {
    *force *= scale;
  }
  for (double* length : {&device.encoder_step, &at_one.renderer.limits.max_speed}) *length /= scale;
  return at_one;
}

}  // namespace

TEST_CASE("a page on a desk is written as one upright, to the last digit", "[practice]") {
  const PracticePage page = page_of("永北");
  for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
    SessionOptions options = session(WriterSkill::novice(), mode, 5);
    const Recording standing = write_page(page, options);
    options.mapping = desk(page);
    const Recording lying = write_page(page, options);
    CHECK(same(standing, lying));
    for (const CharacterScore& score : score_page(page, lying)) CHECK(score.strokes_completed == score.stroke_count);
  }
}

TEST_CASE("a motion scale acts as a change of the device's and the hand's impedance by its square", "[practice]") {
  const PracticePage page = page_of("永");
  SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force, 2);
  options.renderer.stiffness_check = StiffnessCheck::off;  // clipped already
  const Recording at_one = write_page(page, options);
  REQUIRE(score_page(page, at_one).front().strokes_completed == 5);
  for (const double scale : {0.5, 2.0, 4.0}) {  // powers of two: nothing is rounded
    SessionOptions scaled = similar(options, scale);
    for (const MotionMapping& mapping : {upright(page, scale), desk(page, scale)}) {
      scaled.mapping = mapping;
      CAPTURE(scale, difference(at_one, write_page(page, scaled)));
      CHECK(same(at_one, write_page(page, scaled)));
    }
  }
}

TEST_CASE("a whole character is written on a desk at motion scales of one half, one and two", "[practice]") {
  const PracticePage page = page_of("永");
  for (const std::string name : {"omni", "touch", "desktop", "premium-1.5", "ideal"}) {
    for (const double scale : {0.5, 1.0, 2.0}) {
      SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force, 1);
      options.device = device_profile(name);
      // Dry friction of 0.26 N in a hand of 300 N/m, twice as far on the page: 1.7 mm that this writer does not notice.
      if (scale > 1.0 && options.device.coulomb_friction > 0.1) continue;
      options.renderer = RendererOptions::for_device(options.device, scale);
      options.mapping = desk(page, scale);
      const Recording recording = write_page(page, options);
      const CharacterScore score = score_page(page, recording).front();
      CAPTURE(name, scale, score.rms_error);
      CHECK(score.strokes_completed == 5);
      CHECK(scale * score.peak_force <= options.device.peak_force * (1.0 + 1e-12));
      // The hand lowers and raises the pen in metres of the page: it rests on the paper while it writes.
      int lifts = 0;
      double deepest = 0.0;
      for (const RecordedSample& sample : recording.samples) {
        lifts += has_event(sample.events, TickEvent::lift);
        deepest = std::min(deepest, sample.device_point.z());
      }
      CHECK(lifts >= 5);
      CHECK(deepest < 0.0);
      CHECK(deepest > -0.004);  // the hand means to be at -2.5 mm, and overshoots where the paper is soft to it
    }
  }
}

TEST_CASE("the more of the guidance the hand feels, the smaller the error", "[practice]") {
  // Two springs: with K_g clipped to 545, 600 and 250 N/m on the page, the hand of 300 N/m feels K_S^2 K_g, that is
  // 136, 600 and 1000 N/m; at rest 31, 67 and 77 % of its miss would be gone.
  const PracticePage page = page_of("永");
  const auto mean_error = [&page](FeedbackMode mode, double scale) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      SessionOptions options = session(WriterSkill::novice(), mode, seed);
      options.mapping = upright(page, scale);
      const CharacterScore score = score_page(page, write_page(page, options)).front();
      CHECK(score.strokes_completed == 5);
      sum += score.rms_error / 10.0;
    }
    return sum;
  };
  const double half = mean_error(FeedbackMode::force, 0.5), one = mean_error(FeedbackMode::force, 1.0),
               two = mean_error(FeedbackMode::force, 2.0);
  CHECK(half < mean_error(FeedbackMode::vision, 0.5));
  CHECK(one < half);
  CHECK(two < one);
}

TEST_CASE("options made for a motion scale guide the hand as much as at scale 1", "[practice]") {
  const PracticePage page = page_of("永");
  const auto reduction = [&page](double scale, double made_for) {
    double errors[2] = {0.0, 0.0};
    for (const FeedbackMode mode : {FeedbackMode::vision, FeedbackMode::force}) {
      for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SessionOptions options = session(WriterSkill::novice(), mode, seed);
        options.renderer = RendererOptions::for_device(options.device, made_for);
        options.mapping = upright(page, scale);
        const CharacterScore score = score_page(page, write_page(page, options)).front();
        CHECK(score.strokes_completed == 5);
        errors[mode == FeedbackMode::force] += score.rms_error;
      }
    }
    return 1.0 - errors[1] / errors[0];
  };
  const double one = reduction(1.0, 1.0), half = reduction(0.5, 0.5), unscaled = reduction(0.5, 1.0);
  CAPTURE(one, half, unscaled);
  // Two springs: the share of the miss that is gone depends on their ratio only. What differs is the device: its mass
  // and friction count four times on the page.
  CHECK(std::abs(half - one) < 0.15 * one);
  CHECK(unscaled < 0.75 * one);
}

TEST_CASE("a trace is followed on a desk as on a page upright, to the last digit", "[practice]") {
  const PracticePage page = page_of("一");
  const PenTrace trace{U'一', "test", 1.0, {{{{0.1, 0.52}, 0.0}, {{0.5, 0.5}, 0.5}, {{0.9, 0.55}, 1.0}}}};
  SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force);
  const Recording standing = follow_trace(page, trace, options);
  options.mapping = desk(page);
  CHECK(same(standing, follow_trace(page, trace, options)));
}

TEST_CASE("a recording made on a desk at a motion scale is replayed by the same mapping", "[practice]") {
  const PracticePage page = page_of("十");
  SessionOptions options = session(WriterSkill::skilled(), FeedbackMode::force);
  options.mapping = desk(page, 2.0);
  const Recording first = write_page(page, options);
  ReplayDevice device(device_states(first, *options.mapping), options.device);
  const Recording again = replay_page(page, device, options);
  CHECK(difference(first, again) < 1e-9);
  CHECK(score_page(page, again).front().strokes_completed == 2);

  ReplayDevice other(device_states(first, *options.mapping), options.device);
  options.mapping.reset();
  CHECK(score_page(page, replay_page(page, other, options)).front().strokes_completed == 0);
}

TEST_CASE("every session refuses a wrong mapping, naming what is wrong", "[practice]") {
  const PracticePage page = page_of("一");
  const PenTrace trace{U'一', "test", 1.0, {{{{0.1, 0.5}, 0.0}, {{0.9, 0.5}, 1.0}}}};
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  struct Wrong {
    MotionMapping mapping;
    std::string named;
  };
  std::vector<Wrong> wrong;
  for (const double scale : {0.0, -1.0, 1e-9, 1e9, nan, std::numeric_limits<double>::infinity()}) {
    wrong.push_back({upright(page, scale), "motion mapping: scale"});
    wrong.push_back({desk(page, scale), "motion mapping: scale"});
  }
  wrong.push_back({upright(page), "motion mapping: rotation"});
  wrong.back().mapping.rotation(1, 1) = -1.0;
  wrong.push_back({desk(page), "motion mapping: offset"});
  wrong.back().mapping.offset.x() = nan;
  for (const Wrong& each : wrong) {
    SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force);
    options.mapping = each.mapping;
    const auto refused = Catch::Matchers::Contains(each.named);
    CHECK_THROWS_WITH(write_page(page, options), refused);
    CHECK_THROWS_WITH(follow_trace(page, trace, options), refused);
    ReplayDevice replayed(std::vector<DeviceState>(1), options.device);
    CHECK_THROWS_WITH(replay_page(page, replayed, options), refused);
    ReplayDevice held(std::vector<DeviceState>(1), options.device);
    LiveOptions live;
    live.mapping = each.mapping;
    CHECK_THROWS_WITH(write_with_device(page, held, live), refused);
  }
}
