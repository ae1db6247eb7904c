// The reproducible parts of the trade-offs: errors, force steps, stability, shapes.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/tradeoff.hpp>
#include <calligraphy/pictures/plot.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "../catch.hpp"
#include "../practice/pages.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::characters;

namespace {

using calligraphy_test::not_a_number;

NearestPointTradeoffOptions small_tradeoff() {
  NearestPointTradeoffOptions options;
  options.queries = 640;
  options.rounds = 1;
  return options;
}

const std::vector<NearestPointTradeoff>& nearest_point_of_all() {
  static const std::vector<NearestPointTradeoff> tradeoff =
      nearest_point_tradeoff(characters("永北京航"), small_tradeoff());
  return tradeoff;
}

const NearestPointTradeoff& setting(const std::string& name) {
  const auto& all = nearest_point_of_all();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.setting.name == name; });
  REQUIRE(found != all.end());
  return *found;
}

bool is_certified(const NearestPointTradeoff& entry) {
  const NearestPointMethod method = entry.setting.options.method;
  return method == NearestPointMethod::exact || method == NearestPointMethod::tracked;
}

}  // namespace

TEST_CASE("exact and tracked keep to their tolerance on every workload", "[tradeoff]") {
  for (const NearestPointTradeoff& entry : nearest_point_of_all()) {
    if (!is_certified(entry)) continue;
    CAPTURE(entry.setting.name);
    for (const NearestPointCost& cost : entry.workloads) {
      CAPTURE(cost.queries);
      CHECK(cost.error_worst <= entry.setting.options.tolerance);
      CHECK(cost.wrong == 0.0);
    }
    CHECK(entry.ticks.error_worst <= entry.setting.options.tolerance);
    CHECK(entry.ticks.wrong == 0.0);
    CHECK(entry.strokes.wrong == 0.0);
    CHECK(entry.arcs.wrong == 0.0);
  }
}

TEST_CASE("subdivision as printed takes wrong branches at every epsilon", "[tradeoff]") {
  for (const char* name : {"wang2006 1e-03", "wang2006 1e-06", "wang2006 1e-09"}) {
    CAPTURE(name);
    CHECK(setting(name).hard.wrong > 0.05);
    CHECK(setting(name).hard.error_worst > 0.1);
  }
}

TEST_CASE("samples without refinement are off by their spacing, refined ones are not", "[tradeoff]") {
  CHECK(setting("sampled 16 x 0").real.wrong > 0.1);
  CHECK(setting("sampled 16 x 1").real.wrong < 0.01);
  CHECK(setting("sampled 16 x 2").real.error < 1e-12);
  CHECK(setting("sampled 16 x 2").hard.error_worst > 1e-3);
}

TEST_CASE("errors are in ascending order: median, p99, maximum", "[tradeoff]") {
  for (const NearestPointTradeoff& entry : nearest_point_of_all()) {
    for (const NearestPointCost* cost : {&entry.real, &entry.hard, &entry.ticks}) {
      CHECK(cost->error >= 0.0);
      CHECK(cost->error_p99 >= cost->error);
      CHECK(cost->error_worst >= cost->error_p99);
      CHECK(cost->ns > 0.0);
      CHECK(cost->ns_p90 >= cost->ns);
    }
  }
}

TEST_CASE("the 19 workloads are listed separately, the two on real strokes form one group, all others the other",
          "[tradeoff]") {
  for (const NearestPointTradeoff& entry : nearest_point_of_all()) {
    REQUIRE(entry.workloads.size() == 19);
    double real = 0.0, hard = 0.0, worst_real = 0.0, worst_hard = 0.0;
    for (const NearestPointCost& cost : entry.workloads) {
      const bool is_real = cost.queries.starts_with("real strokes");
      (is_real ? real : hard) += cost.wrong / (is_real ? 2.0 : 17.0);
      double& worst = is_real ? worst_real : worst_hard;
      worst = std::max(worst, cost.error_worst);
    }
    CHECK(entry.real.wrong == Approx(real).margin(1e-12));
    CHECK(entry.hard.wrong == Approx(hard).margin(1e-12));
    CHECK(entry.real.error_worst == worst_real);
    CHECK(entry.hard.error_worst == worst_hard);
  }
}

TEST_CASE("along an arc a perfect closest point changes the force only in direction", "[tradeoff]") {
  // K d with d = 4 mm turns in each tick by 50 um over the pen's radius of 11 mm, that of the sharpest arc.
  const double turning = 1000.0 * 0.004 * 50e-6 / 0.011;
  for (const NearestPointTradeoff& entry : nearest_point_of_all()) {
    CAPTURE(entry.setting.name);
    if (is_certified(entry)) CHECK(entry.arcs.max_step == Approx(turning).epsilon(0.03));
  }
  CHECK(setting("wang2006 1e-03").arcs.max_step > 0.5);
  CHECK(setting("wang2006 1e-06").arcs.max_step > 2.0 * turning);
  CHECK(setting("sampled 16 x 0").arcs.max_step > 1.0);
}

TEST_CASE(
    "along real strokes a certified closest point steps the force no more than the pen's motion, the printed one more",
    "[tradeoff]") {
  const double moved = 1000.0 * 50e-6;  // K times the motion in a tick, if the pen moves straight away from the stroke
  CHECK(setting("exact 1e-09").strokes.max_step < 2.0 * moved);
  CHECK(setting("tracked 1e-09").strokes.max_step == Approx(setting("exact 1e-09").strokes.max_step));
  CHECK(setting("wang2006 1e-03").strokes.max_step > 4.0 * moved);
}

TEST_CASE("everything except the times is the same in every run", "[tradeoff]") {
  const auto again = nearest_point_tradeoff(characters("永北京航"), small_tradeoff());
  const auto& first = nearest_point_of_all();
  REQUIRE(again.size() == first.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    CHECK(again[i].setting.name == first[i].setting.name);
    CHECK(again[i].hard.error == first[i].hard.error);
    CHECK(again[i].hard.error_worst == first[i].hard.error_worst);
    CHECK(again[i].hard.wrong == first[i].hard.wrong);
    CHECK(again[i].ticks.error_worst == first[i].ticks.error_worst);
    CHECK(again[i].strokes.max_step == first[i].strokes.max_step);
    CHECK(again[i].arcs.wrong == first[i].arcs.wrong);
  }
  NearestPointTradeoffOptions other = small_tradeoff();
  other.seed = 2;
  CHECK(nearest_point_tradeoff(characters("永北京航"), other).back().hard.error != first.back().hard.error);
}

TEST_CASE("options of a trade-off out of their domain are rejected", "[tradeoff]") {
  CHECK_THROWS_AS(nearest_point_tradeoff({}), ValueError);
  CHECK_THROWS_AS(nearest_point_tradeoff(characters("一")), ValueError);  // no curve
  const auto refused = [](auto change) {
    NearestPointTradeoffOptions options = small_tradeoff();
    change(options);
    CHECK_THROWS_AS(nearest_point_tradeoff(characters("永"), options), ValueError);
  };
  refused([](auto& o) { o.queries = 0; });
  refused([](auto& o) { o.rounds = 0; });
  for (const double bad : {0.0, -1.0, not_a_number}) {
    refused([bad](auto& o) { o.stiffness = bad; });
    refused([bad](auto& o) { o.speed = bad; });
    refused([bad](auto& o) { o.rate = bad; });
  }
  CHECK_THROWS_AS(servo_rate_tradeoff({}), ValueError);
  ServoRateTradeoffOptions servo;
  servo.seeds = 0;
  CHECK_THROWS_AS(servo_rate_tradeoff(characters("一"), servo), ValueError);
  servo = {};
  servo.rates = {1000.0, -1.0};
  CHECK_THROWS_AS(servo_rate_tradeoff(characters("一"), servo), ValueError);
  servo = {};
  servo.device = "none";
  CHECK_THROWS_AS(servo_rate_tradeoff(characters("一"), servo), ValueError);
  CHECK_THROWS_AS(coordinate_width_tradeoff({}), ValueError);
  CHECK_THROWS_AS(with_coordinate_width(characters("一")[0], 0), ValueError);
  CHECK_THROWS_AS(with_coordinate_width(characters("一")[0], 33), ValueError);
}

// ---- servo rate

TEST_CASE("a faster loop tolerates stiffer paper, and has smaller force steps on the same paper", "[tradeoff]") {
  ServoRateTradeoffOptions options;
  options.rates = {250.0, 1000.0, 4000.0};
  options.seeds = 1;
  const std::vector<ServoRateTradeoff> tradeoff = servo_rate_tradeoff(characters("北"), options);
  REQUIRE(tradeoff.size() == 3);
  for (std::size_t i = 0; i < tradeoff.size(); ++i) {
    const ServoRateTradeoff& entry = tradeoff[i];
    CAPTURE(entry.rate);
    CHECK(entry.rate == options.rates[i]);
    CHECK(entry.stable);
    CHECK(entry.written == 1.0);
    CHECK(entry.stiffness < entry.loop_stiffness);
    CHECK(entry.loop_stiffness <= entry.unlimited_stiffness);
    CHECK(entry.unlimited_stiffness > entry.held_stiffness);  // dry friction helps
    CHECK(entry.hard_stiffness == 0.5 * entry.unlimited_stiffness);
    CHECK(entry.hard_penetration < entry.penetration);
    RendererOptions renderer = RendererOptions::for_device(device_profile(options.device));
    renderer.servo_rate = entry.rate;
    CHECK(entry.force_step <=
          HapticRenderer(lay_out(characters("北")).front().characters, {}, device_profile(options.device), renderer)
              .max_force_step());
    CHECK(entry.path_error > 0.0);
    if (i == 0) continue;
    CHECK(entry.hard_penetration < tradeoff[i - 1].hard_penetration);
    CHECK(entry.force_step < tradeoff[i - 1].force_step);
    CHECK(entry.unlimited_stiffness > tradeoff[i - 1].unlimited_stiffness);
    CHECK(entry.held_stiffness / tradeoff[i - 1].held_stiffness ==
          Approx(entry.rate / tradeoff[i - 1].rate).epsilon(0.02));
    CHECK(entry.free_stiffness / tradeoff[i - 1].free_stiffness ==
          Approx(entry.rate / tradeoff[i - 1].rate).epsilon(0.02));
  }
}

TEST_CASE("paper too stiff for the loop is detected as unstable", "[tradeoff]") {
  // 600 N/m at 30 Hz is far above the critical stiffness of the linear loop in a hand, about 2 b / T = 186 N/m without
  // the damper of the paper, whose filter is too late to help here.
  ServoRateTradeoffOptions options;
  options.rates = {30.0};
  options.seeds = 1;
  const ServoRateTradeoff entry = servo_rate_tradeoff(characters("一"), options).front();
  CHECK(entry.held_stiffness < 600.0);
  CHECK(entry.loop_stiffness < 600.0);
  CHECK_FALSE(entry.stable);
}

// ---- coordinate width

TEST_CASE("a stored control point is off by at most half a step along each axis", "[tradeoff]") {
  const int bits = GENERATE(1, 4, 8, 12, 16, 32);
  const double step = 1.0 / (std::exp2(bits) - 1.0);
  for (const Character& character : built_in_characters().characters) {
    const Character stored = with_coordinate_width(character, bits);
    CHECK(stored.sequence.stroke_ids == character.sequence.stroke_ids);
    for (std::size_t i = 0; i < stored.structure.control_points.size(); ++i) {
      const Point& is = stored.structure.control_points[i];
      const Point off = is - character.structure.control_points[i];
      REQUIRE(off.cwiseAbs().maxCoeff() <= 0.5 * step * (1.0 + 1e-6));
      REQUIRE(off.norm() <= 0.5 * step * std::sqrt(2.0) * (1.0 + 1e-6));
      const Point places = is / step;
      REQUIRE((places - Point(places.array().round())).norm() < 1e-5);
    }
  }
}

TEST_CASE("points outside the em square are clamped to its edge", "[tradeoff]") {
  const StrokeInput line{1, {{-0.2, 0.5}, {1.3, 1.1}}};
  const Character stored = with_coordinate_width(make_character(U'\u4E00', std::span(&line, 1)), 8);
  CHECK(stored.structure.control_points[0].x() == 0.0);
  CHECK(stored.structure.control_points[1] == Point(1.0, 1.0));
}

TEST_CASE("no stroke moves further than its control points, and each bit halves that bound", "[tradeoff]") {
  const std::vector<CoordinateWidthTradeoff> tradeoff = coordinate_width_tradeoff(characters("永北乙"));
  REQUIRE(tradeoff.size() == 13);
  for (std::size_t i = 0; i < tradeoff.size(); ++i) {
    const CoordinateWidthTradeoff& entry = tradeoff[i];
    CAPTURE(entry.bits);
    CHECK(entry.bits == 4 + static_cast<int>(i));
    CHECK(entry.step == Approx(1.0 / (std::exp2(entry.bits) - 1.0)));
    CHECK(entry.rms_error > 0.0);
    CHECK(entry.rms_error < entry.max_error);
    // A point of a Bezier curve is a weighted mean of the control points.
    CHECK(entry.max_error <= 0.5 * entry.step * std::sqrt(2.0) * (1.0 + 1e-9));
    CHECK(entry.max_error > 0.1 * entry.step);
    if (i > 0) CHECK(entry.bytes > tradeoff[i - 1].bytes);
  }
}

TEST_CASE("the error of a stroke stored shorter or longer is the difference in length", "[tradeoff]") {
  // The grid of 4 bits has positions at 6/15 = 0.4 and 7/15.
  const auto [end, off] = GENERATE(std::pair(0.42, 0.02), std::pair(0.434, 7.0 / 15.0 - 0.434));
  const StrokeInput line{1, {{0.4, 0.4}, {end, 0.4}}};
  const Character character = make_character(U'\u4E00', std::span(&line, 1));
  CHECK(coordinate_width_tradeoff(std::span(&character, 1)).front().max_error == Approx(off));
}

TEST_CASE("coordinates are counted packed, and the ID of each stroke as one byte", "[tradeoff]") {
  const auto bytes = [](std::string_view text, int bits) {
    return coordinate_width_tradeoff(characters(text))[static_cast<std::size_t>(bits - 4)].bytes;
  };
  CHECK(bytes("一", 8) == 1 + 4);    // two points
  CHECK(bytes("一", 9) == 1 + 5);    // 36 bits
  CHECK(bytes("十", 16) == 2 + 16);  // four points
  CHECK(bytes("一十", 8) == (5 + 10) / 2.0);
}

// ---- plots

TEST_CASE("the plot of each trade-off is valid XML", "[tradeoff]") {
  CHECK_THROWS_AS(nearest_point_tradeoff_plot({}), ValueError);
  CHECK_THROWS_AS(servo_rate_tradeoff_plot({}), ValueError);
  CHECK_THROWS_AS(coordinate_width_tradeoff_plot({}), ValueError);
  if (!gnuplot_available()) {
    if (std::getenv("CALLIGRAPHY_REQUIRE_DATA") != nullptr) FAIL("gnuplot cannot be started");
    WARN("skipped: gnuplot cannot be started");
    return;
  }
  ServoRateTradeoffOptions options;
  options.rates = {500.0, 1000.0};
  options.seeds = 1;
  const auto text_of = [](const std::string& picture) {
    pugi::xml_document document;
    REQUIRE(document.load_string(picture.c_str()));
    std::string text = document.child("svg").child("title").text().get();
    for (const auto& node : document.select_nodes("//text")) {
      for (const auto& part : node.node().select_nodes(".//text()")) text += " " + std::string(part.node().value());
    }
    return text;
  };
  const std::string nearest = text_of(nearest_point_tradeoff_plot(nearest_point_of_all()));
  for (const char* word : {"exact", "tracked", "sampled", "wang2006", "16 x 0", "1e-12", "[ns]"}) {
    CAPTURE(word);
    CHECK(nearest.find(word) != std::string::npos);
  }
  CHECK(text_of(servo_rate_tradeoff_plot(servo_rate_tradeoff(characters("一"), options))).find("[Hz]") !=
        std::string::npos);
  CHECK(text_of(coordinate_width_tradeoff_plot(coordinate_width_tradeoff(characters("一")))).find("[% of the em]") !=
        std::string::npos);
}
