// Set-up validates every option and names what is wrong.
#include "../catch.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <calligraphy/base/error.hpp>

#include "../scripted_pen.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::placed;
using calligraphy_test::test_device;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;

/// The message of the ValueError thrown, or "".
std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const ValueError& error) {
    return error.what();
  }
  return "";
}

std::string complaint(const RendererOptions& options, const Capabilities& device = test_device(),
                      double attraction = 1.0) {
  return complaint([&] { validate(options, device, attraction); });
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

struct Domain {
  const char* name;
  std::function<double&(RendererOptions&)> option;
  bool zero_allowed;
  bool infinity_allowed = false;
};

const Domain domains[] = {
    {"servo_rate", [](RendererOptions& o) -> double& { return o.servo_rate; }, false},
    {"paper_stiffness", [](RendererOptions& o) -> double& { return o.paper_stiffness; }, true},
    {"guidance_stiffness", [](RendererOptions& o) -> double& { return o.guidance_stiffness; }, true},
    {"guidance_fade_in", [](RendererOptions& o) -> double& { return o.guidance_fade_in; }, true},
    {"wrong_way_stiffness", [](RendererOptions& o) -> double& { return o.wrong_way_stiffness; }, true},
    {"wrong_way_limit", [](RendererOptions& o) -> double& { return o.wrong_way_limit; }, true},
    {"wrong_way_slack", [](RendererOptions& o) -> double& { return o.wrong_way_slack; }, true},
    {"stroke.nearest.tolerance", [](RendererOptions& o) -> double& { return o.stroke.nearest.tolerance; }, false},
    {"stroke.space.radius", [](RendererOptions& o) -> double& { return o.stroke.space.radius; }, false},
    {"stroke.space.fade_width", [](RendererOptions& o) -> double& { return o.stroke.space.fade_width; }, false},
    {"stroke.plane_tolerance", [](RendererOptions& o) -> double& { return o.stroke.plane_tolerance; }, true},
    {"stroke.window", [](RendererOptions& o) -> double& { return o.stroke.window; }, true},
    {"start_radius", [](RendererOptions& o) -> double& { return o.start_radius; }, false},
    {"box_margin", [](RendererOptions& o) -> double& { return o.box_margin; }, true},
    {"lift_height", [](RendererOptions& o) -> double& { return o.lift_height; }, true},
    {"box_hysteresis", [](RendererOptions& o) -> double& { return o.box_hysteresis; }, true},
    {"in_plane_force_rate", [](RendererOptions& o) -> double& { return o.in_plane_force_rate; }, false},
    {"normal_force_rate", [](RendererOptions& o) -> double& { return o.normal_force_rate; }, false},
    {"max_speed", [](RendererOptions& o) -> double& { return o.max_speed; }, false},
    {"guidance_limit", [](RendererOptions& o) -> double& { return o.guidance_limit; }, false},
    {"assist.retention", [](RendererOptions& o) -> double& { return o.assist.retention; }, true},
    {"assist.full_assistance_error", [](RendererOptions& o) -> double& { return o.assist.full_assistance_error; },
     false},
    {"min_assistance", [](RendererOptions& o) -> double& { return o.assist.min_assistance; }, true},
    {"friction.coefficient", [](RendererOptions& o) -> double& { return o.friction.coefficient; }, true},
    {"friction.stiffness", [](RendererOptions& o) -> double& { return o.friction.stiffness; }, false},
    {"friction.static_ratio", [](RendererOptions& o) -> double& { return o.friction.static_ratio; }, false},
    {"friction.stick_speed", [](RendererOptions& o) -> double& { return o.friction.stick_speed; }, true},
    {"force_jerk", [](RendererOptions& o) -> double& { return o.force_jerk; }, false, true},
    {"energy_budget", [](RendererOptions& o) -> double& { return o.energy_budget; }, true, true},
    {"thermal_time_constant", [](RendererOptions& o) -> double& { return o.thermal_time_constant; }, true},
};

}  // namespace

TEST_CASE("each option out of range is named with its value", "[render]") {
  CHECK(complaint(RendererOptions{}).empty());
  for (const Domain& domain : domains) {
    for (const auto& [value, text] :
         {std::pair{-0.25, "-0.25"}, {0.0, "0"}, {infinity, "inf"}, {-infinity, "-inf"}, {not_a_number, "nan"}}) {
      RendererOptions options;
      domain.option(options) = value;
      const std::string found = complaint(options);
      INFO(domain.name << " = " << value << ": " << found);
      if ((value == 0.0 && domain.zero_allowed) || (value == infinity && domain.infinity_allowed)) {
        CHECK(found.empty());
      } else {
        CHECK(contains(found, domain.name));
        CHECK(contains(found, text));
      }
    }
  }
}

TEST_CASE("an attraction factor or a scale out of range is named and clips no stiffness", "[render]") {
  const Capabilities device = test_device();
  const auto complaint_of = [&](double max_attraction, double scale) -> std::string {
    RendererOptions options;
    options.guidance_stiffness = 1e9;
    try {
      clip_stiffness(options, device, max_attraction, scale);
    } catch (const ValueError& error) {
      CHECK(options.guidance_stiffness == 1e9);
      return error.what();
    }
    CHECK(options.guidance_stiffness >= 0.0);
    return {};
  };
  for (const double bad : {-1.0, -infinity, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(contains(complaint_of(bad, 1.0), "max_attraction"));
    CHECK(contains(complaint_of(1.0, bad), "scale"));
  }
  CHECK(contains(complaint_of(1.0, 0.0), "scale"));
  CHECK(complaint_of(0.0, 1.0).empty());  // no stroke attracts
}

TEST_CASE("options above their upper bounds are named too", "[render]") {
  RendererOptions options;
  options.servo_rate = 2e6;
  CHECK(contains(complaint(options), "servo_rate"));
  options = {};
  options.stroke.space.fade_width = 2.0 * options.stroke.space.radius;
  CHECK(contains(complaint(options), "stroke.space.fade_width"));
  options = {};
  for (const int samples : {1, 65, -3}) {
    RendererOptions coarse = options;
    coarse.stroke.nearest.samples = samples;
    CHECK(contains(complaint(coarse), "stroke.nearest.samples = " + std::to_string(samples)));
  }
  for (const int refinements : {-1, 9}) {
    RendererOptions coarse = options;
    coarse.stroke.nearest.refinements = refinements;
    CHECK(contains(complaint(coarse), "stroke.nearest.refinements = " + std::to_string(refinements)));
  }
  options.stroke.nearest.tolerance = 1.5;
  CHECK(contains(complaint(options), "stroke.nearest.tolerance"));
}

TEST_CASE("fractions and ratios of the stages have upper and lower bounds", "[render]") {
  const auto refused = [](const char* name, double value) {
    RendererOptions options;
    for (const Domain& domain : domains) {
      if (std::string(name) == domain.name) domain.option(options) = value;
    }
    return contains(complaint(options), name);
  };
  for (const char* name : {"assist.retention", "min_assistance"}) {
    CHECK_FALSE(refused(name, 1.0));
    CHECK(refused(name, 1.0 + 1e-9));
  }
  CHECK_FALSE(refused("friction.coefficient", 10.0));
  CHECK(refused("friction.coefficient", 10.5));
  CHECK(refused("friction.stiffness", 2e6));
  CHECK_FALSE(refused("friction.static_ratio", 1.0));
  CHECK(refused("friction.static_ratio", 0.999));  // below 1 every slip would generate energy
  CHECK(refused("friction.static_ratio", 11.0));
}

TEST_CASE("a stage that needs a property of the device names it when it is missing", "[render]") {
  RendererOptions options;
  options.passivity_control = true;
  for (const double mass : {0.0, -0.1, not_a_number}) {
    Capabilities device = test_device();
    device.apparent_mass = mass;
    CHECK(contains(complaint(options, device), "apparent_mass of the device, for passivity_control"));
  }
  Capabilities heavy = test_device();
  heavy.apparent_mass = infinity;
  CHECK(contains(complaint(options, heavy), "mass = inf"));
  options = {};
  options.thermal_time_constant = 10.0;
  for (const double force : {0.0, -1.0, infinity, not_a_number}) {
    Capabilities device = test_device();
    device.continuous_force = force;
    CHECK(contains(complaint(options, device), "continuous_force of the device, for thermal_time_constant"));
  }
  Capabilities late = test_device();
  late.sample_delay = 16;
  options = {};
  options.energy_budget = 0.1;
  CHECK(contains(complaint([&] { HapticRenderer({placed(U'永')}, {}, late, options); }), "delay = 16"));
}

TEST_CASE("with the check off any stiffness from 0 to 1e6 N/m is accepted", "[render]") {
  Capabilities device = test_device();
  device.usable_stiffness = 100.0;
  device.apparent_mass = 0.045;
  RendererOptions options;
  options.paper_stiffness = 5000.0;
  CHECK(contains(complaint(options, device), "paper_stiffness = 5000"));
  options.stiffness_check = StiffnessCheck::off;
  CHECK(complaint(options, device).empty());
  CHECK(HapticRenderer({placed(U'永')}, {}, device, options).options().paper_stiffness == 5000.0);
  options.paper_stiffness = 2e6;
  CHECK(contains(complaint(options, device), "paper_stiffness = 2e+06"));
  options.paper_stiffness = -1.0;
  CHECK(contains(complaint(options, device), "paper_stiffness = -1"));
}

TEST_CASE("a renderer needs a device that senses and drives three translations", "[render]") {
  const auto complaint_of = [](const DeviceAxes& sensed, const DeviceAxes& driven) {
    Capabilities device = test_device();
    device.sensed = sensed;
    device.driven = driven;
    return complaint([&] { HapticRenderer({placed(U'永')}, {}, device); });
  };
  const DeviceAxes translations, plane{true, true, false, false}, all{true, true, true, true};
  CHECK(complaint_of(translations, translations).empty());
  CHECK(complaint_of(all, translations).empty());
  CHECK(complaint_of(all, all).empty());
  CHECK(contains(complaint_of(translations, plane), "driven axes are x, y; the renderer needs x, y and z"));
  CHECK(contains(complaint_of(plane, plane), "sensed axes are x, y, driven axes are x, y; the renderer"));
}

TEST_CASE("everything() is valid for the shipped devices, and every stage is enabled", "[render]") {
  struct Shipped {
    double peak, continuous, stiffness, mass;
    int delay;
  };
  for (const Shipped& shipped : {Shipped{3.3, 0.88, 700.0, 0.045, 0}, Shipped{3.3, 0.88, 400.0, 0.045, 1},
                                 Shipped{7.9, 1.75, 1000.0, 0.045, 0}, Shipped{8.5, 1.4, 800.0, 0.075, 2},
                                 Shipped{infinity, infinity, infinity, 0.045, 0}, Shipped{3.3, 0.0, 0.0, 0.045, 0}}) {
    Capabilities device = test_device();
    device.peak_force = shipped.peak;
    device.continuous_force = shipped.continuous;
    device.usable_stiffness = shipped.stiffness;
    device.apparent_mass = shipped.mass;
    device.sample_delay = shipped.delay;
    for (const double rate : {500.0, 1000.0, 4000.0}) {
      device.update_rate = rate;
      const RendererOptions options = RendererOptions::everything(device);
      INFO("peak " << shipped.peak << " N, " << rate << " Hz: " << complaint(options, device));
      CHECK(complaint(options, device).empty());
      CHECK(complaint([&] { HapticRenderer({placed(U'永')}, {}, device, options); }).empty());
      CHECK(options.servo_rate == rate);
      CHECK(options.guidance == GuidanceLaw::saturating);
      CHECK(options.guide_to_start);
      CHECK(options.assist.enabled);
      CHECK(options.friction.coefficient > 0.0);
      CHECK(options.passivity_control);
      CHECK(std::isfinite(options.force_jerk));
      CHECK(std::isfinite(options.energy_budget));
      const bool warms = shipped.continuous > 0.0 && shipped.continuous < shipped.peak;
      CHECK((options.thermal_time_constant > 0.0) == warms);
      CHECK(options.guidance_limit <= 0.5 * shipped.peak);
    }
  }
}

TEST_CASE("a stiffness above the device's usable one is rejected, counting the attraction factor", "[render]") {
  for (const char* name : {"paper_stiffness", "guidance_stiffness", "wrong_way_stiffness"}) {
    RendererOptions options;
    for (const Domain& domain : domains) {
      if (std::string(name) == domain.name) domain.option(options) = 1001.0;
    }
    const std::string found = complaint(options);
    CHECK(contains(found, std::string(name) + " = 1001 N/m"));
    CHECK(contains(found, "test device is usable up to 1000 N/m"));
  }
  RendererOptions options;
  options.guidance_stiffness = 600.0;
  CHECK(complaint(options, test_device(), 1.6).empty());
  CHECK(contains(complaint(options, test_device(), 1.7), "maximum attraction factor 1.7"));
  CHECK(
      contains(complaint([&] {
                 HapticRenderer({{calligraphy_test::typical_character(1, {1.0, 2.0}), {}}}, {}, test_device(), options);
               }),
               "maximum attraction factor 2"));
}

TEST_CASE("every accepted stiffness gives finite forces on a device that states no limit", "[render]") {
  Capabilities device = test_device();
  device.usable_stiffness = 0.0;
  for (const double stiffness : {1e-300, 1e-12, 1e6, 1e12, 1e306, 1.7e308}) {
    RendererOptions options;
    options.paper_stiffness = options.guidance_stiffness = options.wrong_way_stiffness = stiffness;
    if (stiffness > 1e6) CHECK(contains(complaint(options, device), "paper_stiffness"));
    if (stiffness > 1e6) continue;
    HapticRenderer renderer({placed(U'永')}, {}, device, options);
    calligraphy_test::ScriptedPen pen(renderer);
    pen.write(renderer.page()[0], 0.002);
    pen.speed = 4.0;
    pen.go({0.03, 0.05, -5.0});
    INFO(stiffness);
    CHECK(pen.finite);
    CHECK(pen.max_force <= 3.3 * (1.0 + 1e-12));
    CHECK(pen.max_step <= renderer.max_force_step() * (1.0 + 1e-12));
  }
  CHECK(contains(complaint([&] {
                   HapticRenderer({{calligraphy_test::typical_character(1, {1.0, 1e300}), {}}}, {}, device);
                 }),
                 "maximum attraction factor"));
}

TEST_CASE("an invalid page, placement or mapping is rejected by name", "[render]") {
  const auto refusal = [](std::vector<PlacedCharacter> page, const MotionMapping& mapping = {}) {
    return complaint([&] { HapticRenderer(std::move(page), mapping, test_device()); });
  };
  CHECK(contains(refusal({}), "no character"));
  for (const double em : {0.0, -1.0, infinity, not_a_number, 1e300}) {
    const std::string found = refusal({placed(U'永'), placed(U'永', {0, 0}, em)});
    INFO(em << ": " << found);
    CHECK(contains(found, "character 2 of the page"));
  }
  for (const Point& origin : {Point(not_a_number, 0.0), Point(0.0, -infinity), Point(1e300, 0.0)}) {
    CHECK(contains(refusal({placed(U'永', origin)}), "character 1 of the page"));
  }
  PlacedCharacter broken = placed(U'永');
  broken.character.structure.control_points[2].x() = not_a_number;
  CHECK(contains(refusal({broken}), "character 1 of the page: stroke 2"));

  MotionMapping mapping;
  mapping.scale = -2.0;
  CHECK(contains(refusal({placed(U'永')}, mapping), "scale = -2"));
  mapping = {};
  mapping.offset.y() = not_a_number;
  CHECK(contains(refusal({placed(U'永')}, mapping), "offset"));
  mapping = {};
  mapping.rotation(0, 0) = 1.1;
  CHECK(contains(refusal({placed(U'永')}, mapping), "rotation"));
  mapping = {};
  mapping.rotation(0, 0) = -1.0;  // a reflection: writing would be mirrored
  CHECK(contains(refusal({placed(U'永')}, mapping), "rotation"));
}

TEST_CASE("a device without a peak force is rejected", "[render]") {
  for (const double peak : {0.0, -1.0, not_a_number}) {
    Capabilities device = test_device();
    device.peak_force = peak;
    CHECK(contains(complaint([&] { HapticRenderer({placed(U'永')}, {}, device); }), "peak force"));
  }
}

TEST_CASE("for_device takes the device's rate and stays within its stiffness", "[render]") {
  Capabilities device = test_device();
  device.usable_stiffness = 150.0;
  device.update_rate = 500.0;
  const RendererOptions options = RendererOptions::for_device(device);
  CHECK(options.servo_rate == 500.0);
  CHECK(options.paper_stiffness == 150.0);
  CHECK(options.guidance_stiffness == 150.0);
  CHECK(options.wrong_way_stiffness == 150.0);
  CHECK(complaint(options, device).empty());
  CHECK(RendererOptions::for_device(test_device()).paper_stiffness == RendererOptions{}.paper_stiffness);
}

TEST_CASE("the maximum force step is per tick, in newtons at the device", "[render]") {
  for (const double scale : {0.5, 1.0, 4.0}) {
    MotionMapping mapping;
    mapping.scale = scale;
    RendererOptions options;
    options.servo_rate = 500.0;
    options.stiffness_check = StiffnessCheck::clip;
    const HapticRenderer renderer({placed(U'永')}, mapping, test_device(), options);
    CHECK(renderer.max_force_step() == Approx(std::hypot(0.2, 0.8)));  // 100 and 400 N/s at 500 Hz
  }
}

TEST_CASE("a stiffness counts with the square of the motion scale, as the device renders it", "[render]") {
  MotionMapping mapping;
  mapping.scale = 2.0;  // 600 N/m on the page are 2400 at the device, which is usable up to 1000
  CHECK(complaint([&] {
          HapticRenderer({placed(U'永')}, mapping, test_device());
        }).find("times the square of the motion scale 2") != std::string::npos);
  RendererOptions options;
  options.stiffness_check = StiffnessCheck::clip;
  CHECK(HapticRenderer({placed(U'永')}, mapping, test_device(), options).options().paper_stiffness == Approx(250.0));
  for (const double scale : {1e300, 1e-300, 1e7, 0.0}) {
    mapping.scale = scale;
    CHECK(complaint([&] { HapticRenderer({placed(U'永')}, mapping, test_device(), options); }).find("scale = ") !=
          std::string::npos);
  }
}

TEST_CASE("with any scale the peak and the rate limit hold at the device", "[render]") {
  for (const double scale : {0.2, 1.0, 5.0}) {
    MotionMapping mapping;
    mapping.scale = scale;
    RendererOptions options;
    options.stiffness_check = StiffnessCheck::clip;
    HapticRenderer renderer({placed(U'永')}, mapping, test_device(), options);
    calligraphy_test::ScriptedPen pen(renderer);
    pen.speed = 0.1;
    pen.write(renderer.page()[0], 0.002);
    pen.go({0.04, 0.06, 0.005});
    pen.go({0.04, 0.06, -0.1});
    CHECK(pen.max_force <= 3.3 * (1.0 + 1e-12));
    CHECK(pen.max_step <= renderer.max_force_step() * (1.0 + 1e-12));
    CHECK(renderer.last().character == 1);
  }
}
