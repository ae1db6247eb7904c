// Extremes of a device, a loop and a page, with the default options and with every stage enabled. For impossible
// samples, faults and long runs see tests/render and tests/soak.
#include "../catch.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/calligraphy.hpp>
#include <calligraphy/devices/detail/flush_denormals.hpp>

#include "../special_values.hpp"
#include "hard_cases.hpp"
#include "pen_path.hpp"

using namespace calligraphy;
using calligraphy_test::path_of;
using Eigen::Vector3d;

namespace {

/// Every spring of the options.
constexpr double& (*springs[])(RendererOptions&) = {
    [](RendererOptions& options) -> double& { return options.paper.stiffness; },
    [](RendererOptions& options) -> double& { return options.guidance.stiffness; },
    [](RendererOptions& options) -> double& { return options.guidance.wrong_way_stiffness; }};

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;
constexpr GripImpedance normal_grip = {0.1, 3.0, 300.0};

struct Composition {
  const char* name;
  RendererOptions (*options)(const Capabilities&);
};
const std::vector<Composition> compositions = {
    {"default", [](const Capabilities& device) { return RendererOptions::for_device(device); }},
    {"everything", [](const Capabilities& device) { return RendererOptions::everything(device); }}};

PlacedCharacter one_stroke() { return {calligraphy_test::typical_character(1), {{0.02, 0.02}, 0.04}}; }

/// A hand that writes a heng beside its template, in closed loop at any servo rate.
struct Writing {
  std::vector<Vector3d> forces, places;  ///< every 10 ms, page
  double max_force = 0.0, max_step = 0.0, step_limit = 0.0;
  bool finite = true, finished = false;
  double late_swing = 0.0;  ///< peak-to-peak motion along z in the last 0.3 s of a rest on the paper [m]
  RendererOptions options;
};

Writing write_beside(const Capabilities& profile, RendererOptions options, double offset) {
  options.stiffness_check = StiffnessCheck::clip;
  const MotionMapping mapping = upright_page(0.08, 0.08);
  HapticRenderer renderer({one_stroke()}, mapping, profile, options);
  const auto path = path_of(strokes(renderer.page()[0].character)[0], renderer.page()[0].placement, 0.0001);
  const Point begin = path.front() + Point(0.0, offset), end = path.back() + Point(0.0, offset);
  // Down in 0.2 s, along the stroke in 1 s, with a rest of 0.8 s at its middle.
  const auto meant = [&](double t) -> Vector3d {
    const auto smooth = [](double s) {
      s = std::clamp(s, 0.0, 1.0);
      return s * s * s * (10.0 + s * (6.0 * s - 15.0));
    };
    const double along = 0.5 * smooth((t - 0.2) / 0.5) + 0.5 * smooth((t - 1.5) / 0.5);
    const Point tip = begin + along * (end - begin);
    return {tip.x(), tip.y(), 0.003 - 0.005 * smooth(t / 0.2)};
  };
  SimulatedDevice device(profile, normal_grip, mapping.to_device(meant(0.0)));
  Writing writing;
  writing.step_limit = renderer.max_force_step();
  writing.options = renderer.options();
  const double period = 1.0 / renderer.options().servo_rate;
  const int ticks = static_cast<int>(2.1 / period);
  const int between = std::max(1, static_cast<int>(0.01 / period));
  Vector3d last = Vector3d::Zero();
  double low = infinity, high = -infinity;
  for (int i = 0; i < ticks; ++i) {
    const HapticTick& tick = renderer.update(device.read());
    writing.finite = writing.finite && tick.force.allFinite();
    writing.max_force = std::max(writing.max_force, tick.force.norm());
    writing.max_step = std::max(writing.max_step, (tick.force - last).norm());
    last = tick.force;
    writing.finished = writing.finished || has_event(tick.events, TickEvent::stroke_finished);
    const double t = i * period;
    if (i % between == 0) {
      writing.forces.push_back(tick.page_force);
      writing.places.push_back(mapping.to_page(device.true_position()));
    }
    if (t > 1.2 && t < 1.5) {
      low = std::min(low, mapping.to_page(device.true_position()).z());
      high = std::max(high, mapping.to_page(device.true_position()).z());
    }
    device.write(tick.force);
    const Vector3d now = meant(t);
    device.set_intention(
        {mapping.to_device(now), mapping.rotation.transpose() * (meant(t + period) - now) / (period * mapping.scale)});
    device.advance(period);
  }
  writing.late_swing = high - low;
  return writing;
}

/// RMS of the difference of two histories, and of one.
double rms_difference(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double sum = 0.0;
  const std::size_t count = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < count; ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(count));
}
double rms(const std::vector<Vector3d>& a) {
  return rms_difference(a, std::vector<Vector3d>(a.size(), Vector3d(0.0, 0.0, 0.0)));
}

void check_kept(const Writing& writing, const Capabilities& profile) {
  CHECK(writing.finite);
  CHECK(writing.finished);
  CHECK(writing.max_force <= profile.peak_force * (1.0 + 1e-12));
  CHECK(writing.max_step <= writing.step_limit * (1.0 + 1e-9));
}

}  // namespace

TEST_CASE("at every rate a hand is guided the same, to within what a person can tell", "[practice][extremes]") {
  // The stiffness is stable at every rate, so that only the rate differs.
  const Capabilities& profile = device_profile("desktop");
  for (const Composition& composition : compositions) {
    RendererOptions options = composition.options(profile);
    options.servo_rate = 100.0;
    options.stiffness_check = StiffnessCheck::clip;
    options = HapticRenderer({one_stroke()}, {}, profile, options).options();
    options.servo_rate = 20'000.0;
    const Writing reference = write_beside(profile, options, 0.003);
    for (const double rate : {100.0, 500.0, 1000.0, 4000.0, 10'000.0}) {
      options.servo_rate = rate;
      const Writing writing = write_beside(profile, options, 0.003);
      CAPTURE(composition.name, rate, writing.late_swing);
      check_kept(writing, profile);
      // At 100 Hz a held force is 5 ms old on average; force JNDs are 6 to 10 %.
      const double just_noticeable = rate < 500.0 ? 0.1 : 0.05;
      CHECK(rms_difference(writing.forces, reference.forces) <= just_noticeable * rms(reference.forces));
      CHECK(rms_difference(writing.places, reference.places) <= 0.05 * 0.003);
    }
  }
}

TEST_CASE("with delays of 0 to 5 samples the stiffness is clipped and a pen pressed on the paper comes to rest",
          "[practice][extremes]") {
  for (const std::string name : {"omni", "desktop"}) {
    for (const Composition& composition : compositions) {
      for (const int delay : {0, 1, 2, 3, 5}) {
        Capabilities profile = device_profile(name);
        profile.sample_delay = delay;
        const Writing writing = write_beside(profile, composition.options(profile), 0.002);
        CAPTURE(name, composition.name, delay, writing.options.paper.stiffness);
        check_kept(writing, profile);
        CHECK(writing.late_swing < 2e-5);
      }
    }
  }
}

TEST_CASE("at the accepted stiffness no encoder step sustains an oscillation", "[practice][extremes]") {
  for (const Composition& composition : compositions) {
    for (const double step : {1e-6, 23e-6, 55e-6, 200e-6}) {
      Capabilities profile = device_profile("omni");
      profile.encoder_step = step;
      const Writing writing = write_beside(profile, composition.options(profile), 0.002);
      CAPTURE(composition.name, step);
      check_kept(writing, profile);
      CHECK(writing.late_swing < std::max(5e-6, 0.1 * step));
    }
  }
}

TEST_CASE("every stiffness has a defined outcome: accepted, clipped with a reason, or rejected by name",
          "[practice][extremes]") {
  const Capabilities& capabilities = device_profile("omni");
  for (const Composition& composition : compositions) {
    const RendererOptions base = composition.options(capabilities);
    for (const auto stiffness : springs) {
      for (const double value : {not_a_number, -1e-300, -600.0, infinity}) {
        RendererOptions options = base;
        stiffness(options) = value;
        for (const StiffnessCheck check : {StiffnessCheck::reject, StiffnessCheck::clip}) {
          options.stiffness_check = check;
          CHECK_THROWS_WITH(HapticRenderer({one_stroke()}, {}, capabilities, options),
                            Catch::Matchers::Contains("stiffness = "));
        }
      }
      for (const double value : {0.0, 1e-12, 1e-310}) {
        RendererOptions options = base;
        stiffness(options) = value;
        HapticRenderer renderer({one_stroke()}, {}, capabilities, options);
        RendererOptions effective = renderer.options();
        CHECK(stiffness(effective) == value);
        CHECK(renderer.clipped().empty());
      }
      RendererOptions options = base;
      options.stiffness_check = StiffnessCheck::reject;
      stiffness(options) = 1e6;
      CHECK_THROWS_WITH(HapticRenderer({one_stroke()}, {}, capabilities, options),
                        Catch::Matchers::Contains("Phantom Omni") && Catch::Matchers::Contains("1e+06 N/m"));
      options.stiffness_check = StiffnessCheck::clip;
      HapticRenderer renderer({one_stroke()}, {}, capabilities, options);
      RendererOptions effective = renderer.options();
      CHECK(stiffness(effective) == Approx(capabilities.usable_stiffness));
      REQUIRE(!renderer.clipped().empty());
      CHECK_THAT(renderer.clipped().front(), Catch::Matchers::Contains("usable up to 700"));
    }
  }
}

TEST_CASE("at a rate too low for it, the stiffness is clipped to what is stable in any hand, with that reason",
          "[practice][extremes]") {
  const Capabilities& capabilities = device_profile("omni");
  RendererOptions options;
  options.servo_rate = 200.0;
  CHECK_THROWS_WITH(HapticRenderer({one_stroke()}, {}, capabilities, options), Catch::Matchers::Contains("200 Hz"));
  options.stiffness_check = StiffnessCheck::clip;
  HapticRenderer renderer({one_stroke()}, {}, capabilities, options);
  SampledLoop loop{capabilities, 200.0};
  loop.wall_damping = renderer.options().paper.damping;
  const double stable = stiffness_for_any_hand(loop, options.velocity_cutoff, 1e6);
  CHECK(stable < 600.0);
  CHECK(renderer.options().paper.stiffness == Approx(stable));
  const std::vector<std::string>& clipped = renderer.clipped();
  CHECK(std::any_of(clipped.begin(), clipped.end(), [](const std::string& line) {
    return line.find("paper.stiffness = 600") == 0 && line.find("stiffness_for_any_hand") != std::string::npos;
  }));
}

namespace {

/// Peak-to-peak motion along z of a pen tapped onto the paper beside the stroke and held pressed [m].
double swing_after_a_tap(const Capabilities& profile, const RendererOptions& options, const GripImpedance& grip,
                         double speed) {
  HapticRenderer renderer({one_stroke()}, {}, profile, options);
  const Eigen::AlignedBox2d box = bounding_box(renderer.page()[0]);
  const Vector3d above(box.center().x(), box.max().y() + 0.003, 0.01);
  SimulatedDevice device(profile, grip, above);
  const double period = 1.0 / renderer.options().servo_rate;
  double low = infinity, high = -infinity;
  while (device.time() < 2.5) {
    device.write(renderer.update(device.read()).force);
    const double z = std::max(above.z() - speed * device.time(), -0.003);
    device.set_intention({{above.x(), above.y(), z}, {0.0, 0.0, z > -0.003 ? -speed : 0.0}});
    device.advance(period);
    if (device.time() < 2.1) continue;
    low = std::min(low, device.true_position().z());
    high = std::max(high, device.true_position().z());
  }
  return high - low;
}

}  // namespace

TEST_CASE("paper as stiff as is accepted: the oscillation of a tap decays in any hand, at any force rate",
          "[practice][extremes]") {
  Capabilities profile = device_profile("desktop");
  profile.usable_stiffness = 0.0;
  for (const double rate : {1000.0, 10'000.0}) {
    for (const double force_rate : {100.0, 400.0, 2000.0}) {
      RendererOptions options;
      options.servo_rate = rate;
      options.limits.normal_rate = force_rate;
      options.stiffness_check = StiffnessCheck::clip;
      options.paper.stiffness = 1e6;
      HapticRenderer renderer({one_stroke()}, {}, profile, options);
      CHECK(renderer.options().paper.stiffness > 1000.0);
      for (const GripImpedance& grip : {GripImpedance{0.02, 0.3, 30.0}, GripImpedance{0.05, 1.0, 100.0}, normal_grip,
                                        GripImpedance{0.15, 5.0, 500.0}}) {
        for (const double speed : {0.1, 0.2, 0.4}) {
          CAPTURE(rate, force_rate, grip.mass, speed, renderer.options().paper.stiffness);
          CHECK(swing_after_a_tap(profile, renderer.options(), grip, speed) < 5e-5);
        }
      }
    }
  }
}

TEST_CASE("adversarial curves as strokes are rejected by name or written with finite forces", "[practice][extremes]") {
  const Capabilities& profile = device_profile("desktop");
  int written = 0;
  for (const Composition& composition : compositions) {
    for (const calligraphy_test::HardCurve& hard : calligraphy_test::hard_curves()) {
      if (hard.control_points.size() != 4) continue;
      // As a pie, one cubic, mapped into the unit square.
      Point low = hard.control_points[0], high = low;
      for (const Point& point : hard.control_points) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
      }
      const double size = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
      StrokeInput input{4, {}, {}};
      for (const Point& point : hard.control_points) input.control_points.push_back((point - low) / size);
      CAPTURE(composition.name, hard.name);
      try {
        HapticRenderer renderer({{make_character(U'丿', std::span(&input, 1)), {{0.02, 0.02}, 0.04}}}, {}, profile,
                                composition.options(profile));
        Eigen::Vector3d last = Vector3d::Zero();
        bool finite = true, stepped = false;
        calligraphy_test::Sequence random(5);
        for (int i = 0; i < 4000; ++i) {
          // Along the curve from its start, then scattered around it.
          const double t = 0.001 * (i % 1000);
          Point tip = renderer.page()[0].placement.to_page(Bezier<3>{
              {input.control_points[0], input.control_points[1], input.control_points[2],
               input.control_points[3]}}.point(t));
          if (i >= 2000) tip += random.point(-0.002, 0.002);
          DeviceState state;
          state.time = 0.001 * i;
          state.position = {tip.x(), tip.y(), i % 1000 < 5 ? 0.002 : -0.001};
          const HapticTick& tick = renderer.update(state);
          finite = finite && tick.force.allFinite();
          stepped = stepped || (tick.force - last).norm() > renderer.max_force_step() * (1.0 + 1e-9);
          last = tick.force;
        }
        CHECK(finite);
        CHECK_FALSE(stepped);
        ++written;
      } catch (const Error& error) {
        UNSCOPED_INFO(error.what());
        CHECK_THAT(error.what(), Catch::Matchers::Contains("stroke"));
      }
    }
  }
  CHECK(written > 0);
}

TEST_CASE("denormal positions, depths and stiffnesses give finite forces, with and without flushing",
          "[practice][extremes]") {
  const Capabilities& capabilities = device_profile("desktop");
  for (const Composition& composition : compositions) {
    for (const bool flush : {false, true}) {
      std::unique_ptr<detail::FlushDenormals> as_a_servo_thread;
      if (flush) as_a_servo_thread = std::make_unique<detail::FlushDenormals>();
      RendererOptions options = composition.options(capabilities);
      options.paper.stiffness = 1e-310;
      HapticRenderer renderer({{one_stroke().character, {{0.0, 0.0}, 0.04}}}, {}, capabilities, options);
      for (int i = 0; i < 2000; ++i) {
        DeviceState state;
        state.time = 0.001 * i;
        state.position = {i % 2 ? 5e-324 : 1e-310, i % 3 ? -1e-310 : 5e-324, -5e-324 * (i % 5)};
        REQUIRE(renderer.update(state).force.allFinite());
      }
    }
  }
}

TEST_CASE("FlushDenormals treats denormal inputs and results as zero, only during its lifetime",
          "[practice][extremes]") {
  if (!detail::FlushDenormals::available()) {
    WARN("skipped: this processor cannot flush denormals");
    return;
  }
  volatile double small = 1e-310, half = 0.5, least = 2.3e-308;
  CHECK(small * half != 0.0);
  {
    const detail::FlushDenormals as_a_servo_thread;
    CHECK(small * half == 0.0);  // input
    CHECK(least * half == 0.0);  // result
  }
  CHECK(small * half != 0.0);
  CHECK(least * half != 0.0);
}
