// Set-up validates every option and names what is wrong.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "../hard_cases.hpp"
#include "../scripted_pen.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::placed;
using calligraphy_test::test_device;

namespace {

/// Every spring of the options.
constexpr double& (*springs[])(RendererOptions&) = {
    [](RendererOptions& options) -> double& { return options.paper.stiffness; },
    [](RendererOptions& options) -> double& { return options.guidance.stiffness; },
    [](RendererOptions& options) -> double& { return options.guidance.wrong_way_stiffness; }};

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

std::string complaint(const RendererOptions& options, const Capabilities& device = test_device(), double scale = 1.0) {
  return complaint([&] { validate(options, device, scale); });
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

struct Domain {
  const char* name;
  std::function<double&(RendererOptions&)> option;
  bool zero_allowed;
  bool infinity_allowed = false;
};

const Domain domains[] = {
    {"servo_rate", [](RendererOptions& o) -> double& { return o.servo_rate; }, true},
    {"paper.stiffness", [](RendererOptions& o) -> double& { return o.paper.stiffness; }, true},
    {"paper.onset", [](RendererOptions& o) -> double& { return o.paper.onset; }, true},
    {"paper.damping", [](RendererOptions& o) -> double& { return o.paper.damping; }, true},
    {"guidance.stiffness", [](RendererOptions& o) -> double& { return o.guidance.stiffness; }, true},
    {"guidance.damping", [](RendererOptions& o) -> double& { return o.guidance.damping; }, true},
    {"velocity_cutoff", [](RendererOptions& o) -> double& { return o.velocity_cutoff; }, false},
    {"guidance.fade_in", [](RendererOptions& o) -> double& { return o.guidance.fade_in; }, true},
    {"guidance.fade_out", [](RendererOptions& o) -> double& { return o.guidance.fade_out; }, true},
    {"guidance.wrong_way_stiffness", [](RendererOptions& o) -> double& { return o.guidance.wrong_way_stiffness; },
     true},
    {"guidance.wrong_way_limit", [](RendererOptions& o) -> double& { return o.guidance.wrong_way_limit; }, true},
    {"guidance.wrong_way_slack", [](RendererOptions& o) -> double& { return o.guidance.wrong_way_slack; }, true},
    {"nearest.tolerance", [](RendererOptions& o) -> double& { return o.nearest.tolerance; }, false},
    {"guidance.space.radius", [](RendererOptions& o) -> double& { return o.guidance.space.radius; }, false},
    {"guidance.space.fade_width", [](RendererOptions& o) -> double& { return o.guidance.space.fade_width; }, false},
    {"tolerances.start_distance", [](RendererOptions& o) -> double& { return o.tolerances.start_distance; }, false},
    {"tolerances.direction", [](RendererOptions& o) -> double& { return o.tolerances.direction; }, false},
    {"tolerances.first_stretch", [](RendererOptions& o) -> double& { return o.tolerances.first_stretch; }, true},
    {"tolerances.distinction", [](RendererOptions& o) -> double& { return o.tolerances.distinction; }, false, true},
    {"tolerances.corridor", [](RendererOptions& o) -> double& { return o.tolerances.corridor; }, false},
    {"tolerances.coverage", [](RendererOptions& o) -> double& { return o.tolerances.coverage; }, true},
    {"tolerances.slack", [](RendererOptions& o) -> double& { return o.tolerances.slack; }, true},
    {"contact.box_margin", [](RendererOptions& o) -> double& { return o.contact.box_margin; }, true},
    {"contact.lift_time", [](RendererOptions& o) -> double& { return o.contact.lift_time; }, true},
    {"contact.lift_clearance", [](RendererOptions& o) -> double& { return o.contact.lift_clearance; }, true},
    {"limits.in_plane_rate", [](RendererOptions& o) -> double& { return o.limits.in_plane_rate; }, false, true},
    {"limits.normal_rate", [](RendererOptions& o) -> double& { return o.limits.normal_rate; }, false, true},
    {"grip_stiffness", [](RendererOptions& o) -> double& { return o.grip_stiffness; }, false},
    {"limits.max_speed", [](RendererOptions& o) -> double& { return o.limits.max_speed; }, false},
    {"limits.max_acceleration", [](RendererOptions& o) -> double& { return o.limits.max_acceleration; }, false, true},
    {"limits.max_standstill", [](RendererOptions& o) -> double& { return o.limits.max_standstill; }, false, true},
    {"guidance.limit", [](RendererOptions& o) -> double& { return o.guidance.limit; }, false},
    {"guidance.assist.retention", [](RendererOptions& o) -> double& { return o.guidance.assist.retention; }, true},
    {"guidance.assist.full_assistance_error",
     [](RendererOptions& o) -> double& { return o.guidance.assist.full_assistance_error; }, false},
    {"guidance.assist.min_assistance", [](RendererOptions& o) -> double& { return o.guidance.assist.min_assistance; },
     true},
    {"paper.friction.coefficient", [](RendererOptions& o) -> double& { return o.paper.friction.coefficient; }, true},
    {"paper.friction.stiffness", [](RendererOptions& o) -> double& { return o.paper.friction.stiffness; }, false},
    {"energy.budget", [](RendererOptions& o) -> double& { return o.energy.budget; }, true, true},
    {"energy.max_gap", [](RendererOptions& o) -> double& { return o.energy.max_gap; }, true},
    {"limits.thermal_time_constant", [](RendererOptions& o) -> double& { return o.limits.thermal_time_constant; },
     true},
};

}  // namespace

TEST_CASE("each option out of range is named with its value", "[render]") {
  CHECK(complaint(RendererOptions{}).empty());
  for (const Domain& domain : domains) {
    Capabilities device = test_device();
    device.apparent_mass = 0.045;  // for energy_budget
    for (const auto& [value, text] :
         {std::pair{-0.25, "-0.25"}, {0.0, "0"}, {infinity, "inf"}, {-infinity, "-inf"}, {not_a_number, "nan"}}) {
      RendererOptions options;
      options.stiffness_check = StiffnessCheck::off;  // an undamped spring is in range, though not stable
      domain.option(options) = value;
      const std::string found = complaint(options, device);
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

TEST_CASE("no option takes a number with which nothing could be written, and each says why", "[render]") {
  for (const Domain& domain : domains) {
    RendererOptions options;
    options.stiffness_check = StiffnessCheck::off;
    domain.option(options) = 1e9;
    const std::string name = domain.name;
    CAPTURE(name);
    if (!domain.infinity_allowed) CHECK(contains(complaint(options), name + " = 1e+09"));
    domain.option(options) = 1e-9;
    const bool means_something = (domain.zero_allowed && name != "servo_rate") || name == "nearest.tolerance";
    CHECK(contains(complaint(options), name + " = 1e-09") != means_something);
  }
  const auto refused = [](const char* text, const std::function<void(RendererOptions&)>& change) {
    RendererOptions options;
    change(options);
    CAPTURE(text);
    CHECK(contains(complaint(options), text));
  };
  refused("tolerances.corridor = 0.005 em, must be from 0.01 to 0.5: the pen is looked at each 0.01 em",
          [](RendererOptions& o) { o.tolerances.corridor = 0.005; });
  refused("energy.max_gap = 16 s", [](RendererOptions& o) { o.energy.max_gap = 16.0; });  // meant in milliseconds
  refused("contact.lift_time = 50 s", [](RendererOptions& o) { o.contact.lift_time = 50.0; });
  refused("servo_rate = 5 Hz", [](RendererOptions& o) { o.servo_rate = 5.0; });
  for (const double rate : {1.0, 5.0}) {
    Capabilities slow = test_device();
    slow.update_rate = rate;
    CHECK(contains(complaint([&] { RendererOptions::for_device(slow); }), "update_rate of the device = "));
  }
}

TEST_CASE("a stroke that the tolerances would not take though it is drawn exactly is named at set-up", "[render]") {
  const std::vector<StrokeInput> inputs = {{1, {{0.2, 0.2}, {0.8, 0.2}}}, {16, {{0.2, 0.8}, {0.3, 0.8}, {0.3, 0.3}}}};
  const auto character = [&](std::size_t count) { return make_character(U'\u4E00', std::span(inputs).first(count)); };
  const std::vector<PlacedCharacter> page = {{character(1), {{0.02, 0.02}, 0.04}}, {character(2), {{0.08, 0.02}, 0.04}}};
  const auto found = [&](const std::function<void(StrokeTolerances&)>& change) {
    RendererOptions options;
    change(options.tolerances);
    return complaint([&] { HapticRenderer(page, {}, test_device(), options); });
  };
  CHECK(found([](StrokeTolerances&) {}).empty());
  CHECK(found([](StrokeTolerances& t) { t.corridor = 0.01; }).empty());
  CHECK(found([](StrokeTolerances& t) { t.coverage = 1.0, t.slack = 0.0; }).empty());
  // Of a first stretch only the ends are known, and the corner is within it.
  CHECK(contains(found([](StrokeTolerances& t) { t.first_stretch = 1.0, t.corridor = 0.01; }),
                 "character 2 of the page: stroke 2: drawn exactly, it would not be finished with "
                 "tolerances.first_stretch = 1 em, tolerances.corridor = 0.01 em"));
  CHECK(found([](StrokeTolerances& t) { t.coverage = 0.0; }).empty());  // the feature planes finish it
}

TEST_CASE("the damping of friction out of range is named, where there is friction", "[render]") {
  for (const double bad : {-0.25, infinity, not_a_number}) {
    RendererOptions options;
    options.paper.friction.coefficient = 0.2;
    options.paper.friction.damping = bad;
    CHECK(contains(complaint(options), "paper.friction.damping = "));
  }
}

TEST_CASE("a scale out of range is named and clips no stiffness", "[render]") {
  for (const double bad : {0.0, -infinity, infinity, not_a_number}) {
    RendererOptions options;
    options.guidance.stiffness = 1e9;
    CHECK(contains(complaint([&] { clip_stiffness(options, test_device(), bad); }), "scale"));
    CHECK(options.guidance.stiffness == 1e9);
    CHECK(contains(complaint(RendererOptions{}, test_device(), bad), "scale"));
  }
}

TEST_CASE("options above their upper bounds are named too", "[render]") {
  RendererOptions options;
  options.servo_rate = 2e6;
  CHECK(contains(complaint(options), "servo_rate"));
  options = {};
  options.guidance.space.fade_width = 2.0 * options.guidance.space.radius;
  CHECK(contains(complaint(options), "guidance.space.fade_width"));
  options = {};
  for (const int samples : {1, 65, -3}) {
    RendererOptions coarse = options;
    coarse.nearest.samples = samples;
    CHECK(contains(complaint(coarse), "nearest.samples = " + std::to_string(samples)));
  }
  for (const int refinements : {-1, 9}) {
    RendererOptions coarse = options;
    coarse.nearest.refinements = refinements;
    CHECK(contains(complaint(coarse), "nearest.refinements = " + std::to_string(refinements)));
  }
  options.nearest.tolerance = 1.5;
  CHECK(contains(complaint(options), "nearest.tolerance"));
}

TEST_CASE("fractions and ratios of the stages have upper and lower bounds", "[render]") {
  const auto refused = [](const char* name, double value) {
    RendererOptions options;
    for (const Domain& domain : domains) {
      if (std::string(name) == domain.name) domain.option(options) = value;
    }
    return contains(complaint(options), name);
  };
  for (const char* name : {"guidance.assist.retention", "guidance.assist.min_assistance"}) {
    CHECK_FALSE(refused(name, 1.0));
    CHECK(refused(name, 1.0 + 1e-9));
  }
  CHECK_FALSE(refused("tolerances.coverage", 1.0));
  CHECK(refused("tolerances.coverage", 1.0 + 1e-9));
  CHECK_FALSE(refused("tolerances.direction", 3.14159265));
  CHECK(refused("tolerances.direction", 3.1416));
  CHECK_FALSE(refused("tolerances.distinction", 1.0));
  CHECK(refused("tolerances.distinction", 1.0 - 1e-9));
  CHECK_FALSE(refused("paper.friction.coefficient", 10.0));
  CHECK(refused("paper.friction.coefficient", 10.5));
  CHECK(refused("paper.friction.stiffness", 2e6));
}

TEST_CASE("a stage that needs a property of the device names it when it is missing", "[render]") {
  RendererOptions options;
  for (const double mass : {0.0, -0.1, not_a_number}) {
    Capabilities device = test_device();
    device.apparent_mass = mass;
    options.energy.budget = 0.1;
    CHECK(contains(complaint(options, device), "apparent_mass of the device, for energy.budget"));
    options.energy.budget = infinity;
  }
  Capabilities heavy = test_device();
  heavy.apparent_mass = infinity;
  CHECK(contains(complaint(options, heavy), "mass = inf"));
  options = {};
  options.limits.thermal_time_constant = 10.0;
  for (const double force : {0.0, -1.0, infinity, not_a_number}) {
    Capabilities device = test_device();
    device.continuous_force = force;
    CHECK(contains(complaint(options, device), "continuous_force of the device, for limits.thermal_time_constant"));
  }
  Capabilities late = test_device();
  late.sample_delay = 16;
  late.apparent_mass = 0.045;
  options = {};
  options.stiffness_check = StiffnessCheck::clip;
  options.energy.budget = 0.1;
  CHECK(contains(complaint([&] { HapticRenderer({placed(U'永')}, {}, late, options); }), "delay = 16"));
}

TEST_CASE("with the check off any stiffness from 0 to 1e6 N/m is accepted, on a simulated device only", "[render]") {
  Capabilities device = test_device();
  device.usable_stiffness = 100.0;
  device.apparent_mass = 0.045;
  RendererOptions options;
  options.paper.stiffness = 5000.0;
  CHECK(contains(complaint(options, device), "paper.stiffness = 5000"));
  options.stiffness_check = StiffnessCheck::off;
  CHECK(complaint(options, device).empty());
  CHECK(HapticRenderer({placed(U'永')}, {}, device, options).options().paper.stiffness == 5000.0);
  device.simulated = false;
  CHECK(contains(complaint(options, device), "stiffness_check = off"));
  CHECK(contains(complaint([&] { HapticRenderer({placed(U'永')}, {}, device, options); }), "test device"));
  CHECK(contains(complaint([&] { HapticRenderer({placed(U'永')}, {}, device, RendererOptions::wang2006()); }),
                 "stiffness_check = off"));
  device.simulated = true;
  options.paper.stiffness = 2e6;
  CHECK(contains(complaint(options, device), "paper.stiffness = 2e+06"));
  options.paper.stiffness = -1.0;
  CHECK(contains(complaint(options, device), "paper.stiffness = -1"));
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

TEST_CASE("everything() is valid for the shipped devices, and enables every stage but assistance as needed",
          "[render]") {
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
      CHECK(options.guidance.force.is(saturating_guidance));
      CHECK(options.guidance.to_start);
      CHECK_FALSE(options.guidance.assist.enabled);  // it withdraws guidance by intent
      CHECK(options.paper.friction.coefficient == 0.15);
      CHECK(std::isfinite(options.energy.budget));
      const bool warms = shipped.continuous > 0.0 && shipped.continuous < shipped.peak;
      CHECK((options.limits.thermal_time_constant > 0.0) == warms);
      CHECK(options.guidance.limit <= 0.75 * shipped.peak);
      CHECK(std::isinf(options.limits.max_standstill) == device.simulated);  // the pens of scripts stand still
    }
  }
}

TEST_CASE("everything() adds to the dry friction of the device what paper has more, at the pressure of a pen",
          "[render]") {
  for (const double own : {0.0, 0.05, 0.15, 0.26}) {  // [N], at 1 N
    Capabilities device = test_device();
    device.coulomb_friction = own;
    CHECK(RendererOptions::everything(device).paper.friction.coefficient == Approx(std::max(0.0, 0.15 - own)));
  }
}

TEST_CASE("tolerances are sensible in every preset, stricter ones in every respect, and normal ones the default",
          "[render]") {
  const StrokeTolerances lenient = StrokeTolerances::lenient(), normal = StrokeTolerances::normal(),
                         strict = StrokeTolerances::strict();
  for (const StrokeTolerances& preset : {lenient, normal, strict}) {
    RendererOptions options;
    options.tolerances = preset;
    CHECK(complaint(options).empty());
  }
  for (const auto& [looser, tighter] : {std::pair{lenient, normal}, {normal, strict}}) {
    CHECK(looser.start_distance > tighter.start_distance);
    CHECK(looser.direction > tighter.direction);
    CHECK(looser.distinction > tighter.distinction);
    CHECK(looser.corridor > tighter.corridor);
    CHECK(looser.coverage < tighter.coverage);
    CHECK(looser.slack > tighter.slack);
  }
  const StrokeTolerances standard = RendererOptions{}.tolerances;
  CHECK(standard.coverage == 0.9);
  CHECK(standard.start_distance == normal.start_distance);
  CHECK(standard.corridor == normal.corridor);
}

TEST_CASE("a stiffness above the device's usable one is rejected", "[render]") {
  for (const char* name : {"paper.stiffness", "guidance.stiffness", "guidance.wrong_way_stiffness"}) {
    RendererOptions options;
    for (const Domain& domain : domains) {
      if (std::string(name) == domain.name) domain.option(options) = 1001.0;
    }
    const std::string found = complaint(options);
    CHECK(contains(found, std::string(name) + " = 1001 N/m"));
    CHECK(contains(found, "test device is usable up to 1000 N/m"));
  }
}

namespace {

Capabilities light_device(double mass, int delay = 0, double rate = 1000.0) {
  Capabilities device = test_device();
  device.usable_stiffness = 0.0;  // unknown
  device.apparent_mass = mass;
  device.viscous_friction = 0.1;
  device.sample_delay = delay;
  device.update_rate = rate;
  return device;
}

double bound(const Capabilities& device, double damping) {
  SampledLoop loop{device, device.update_rate};
  loop.wall_damping = damping;
  return stiffness_for_any_hand(loop, RendererOptions{}.velocity_cutoff, 1e6);
}

}  // namespace

TEST_CASE("every spring is held to what is stable in any hand, rejected above with the reason", "[render]") {
  const Capabilities device = light_device(0.045, 1);
  RendererOptions options;
  options.servo_rate = device.update_rate;
  const double most = bound(device, 4.0);
  for (const auto spring : springs) {
    RendererOptions stiff = options;
    spring(stiff) = 0.999 * most;
    CHECK(complaint(stiff, device).empty());
    spring(stiff) = 1.001 * most;
    const std::string found = complaint(stiff, device);
    CHECK(contains(found, "stiffness_for_any_hand"));
    CHECK(contains(found, "a delay of 1 ticks"));
    CHECK(contains(found, "1000 Hz"));
    CHECK(clip_stiffness(stiff, device).size() == 1);
    CHECK(spring(stiff) == Approx(most).epsilon(1e-6));
    CHECK(complaint(stiff, device).empty());
  }
  CHECK(max_guidance_stiffness(options, device) == Approx(most).epsilon(1e-6));
  // The filter of the velocity is part of the loop.
  options.velocity_cutoff = 20.0;
  CHECK(max_guidance_stiffness(options, device) < 0.9 * most);
}

TEST_CASE("on a page with a motion scale stiffness and damping count as the device renders them", "[render]") {
  const Capabilities device = light_device(0.045, 1);
  RendererOptions options;
  options.guidance.damping = 1.0;
  CHECK(max_guidance_stiffness(options, device, 2.0) == Approx(bound(device, 4.0) / 4.0).epsilon(1e-6));
}

TEST_CASE("a device of unknown mass is taken to weigh 20 g", "[render]") {
  for (const int delay : {1, 2}) {
    const double unknown = max_guidance_stiffness({}, light_device(0.0, delay));
    CHECK(unknown == max_guidance_stiffness({}, light_device(0.02, delay)));
    CHECK(unknown != max_guidance_stiffness({}, light_device(0.03, delay)));
  }
}

TEST_CASE("a damping too strong for the loop's lag is lowered when clipping, and rejected otherwise", "[render]") {
  const Capabilities slow = light_device(0.045, 5);
  RendererOptions options;
  options.paper.damping = options.guidance.damping = 20.0;
  CHECK(bound(slow, 20.0) == 0.0);
  CHECK(contains(complaint(options, slow), "paper.damping = 20 N s/m"));
  const std::vector<std::string> clipped = clip_stiffness(options, slow);
  CHECK(std::count_if(clipped.begin(), clipped.end(),
                      [](const std::string& line) { return contains(line, ".damping = 20 N s/m"); }) == 2);
  for (const double damping : {options.paper.damping, options.guidance.damping}) {
    CHECK(damping < 10.0);
    CHECK(bound(slow, damping) > 100.0);
  }
  // Where the stiffness is stable with the damping wanted, that stays.
  options = {};
  CHECK(clip_stiffness(options, light_device(0.045)).empty());
  CHECK(options.paper.damping == RendererOptions{}.paper.damping);
}

TEST_CASE("guidance and friction together are held to what is stable with both dampers", "[render]") {
  for (const int delay : {0, 1, 3}) {
    const Capabilities device = light_device(0.045, delay);
    RendererOptions options;
    options.paper.friction.coefficient = 0.2;
    options.guidance.stiffness = options.paper.friction.stiffness = 5000.0;
    clip_stiffness(options, device);
    const double both = bound(device, options.guidance.damping + options.paper.friction.damping);
    CAPTURE(delay, both, options.guidance.stiffness, options.paper.friction.stiffness);
    CHECK(options.guidance.stiffness + options.paper.friction.stiffness <= both * (1.0 + 1e-6));
    CHECK(options.guidance.stiffness > 0.1 * both);
    // A share of 35 %, unless so little damping is left to friction that its spring would be unstable alone.
    CHECK(options.paper.friction.stiffness >=
          std::min(0.35 * both, bound(device, options.paper.friction.damping)) * (1.0 - 1e-6));
    CHECK(complaint(options, device).empty());
    CHECK(max_guidance_stiffness(options, device) + options.paper.friction.stiffness <= both * (1.0 + 1e-6));
    options.guidance.stiffness = options.paper.friction.stiffness = 0.51 * both;
    CHECK_FALSE(complaint(options, device).empty());
  }
}

TEST_CASE("friction that would be softer than 1 N/m is left out, with a line that says so", "[render]") {
  for (const auto& [delay, rate] : {std::pair{15, 100.0}, {5, 100.0}, {15, 500.0}}) {
    const Capabilities device = light_device(0.045, delay, rate);
    RendererOptions options;
    options.servo_rate = rate;
    options.paper.friction.coefficient = 0.2;
    CAPTURE(delay, rate);
    CHECK_FALSE(complaint(options, device).empty());
    const std::vector<std::string> clipped = clip_stiffness(options, device);
    CHECK(options.paper.friction.coefficient == 0.0);
    CHECK(std::count_if(clipped.begin(), clipped.end(), [](const std::string& line) {
            return contains(line, "paper.friction.coefficient = 0.2") && contains(line, "too soft for friction");
          }) == 1);
    CHECK(complaint(options, device) == "");
    CHECK(clip_stiffness(options, device).empty());
    const RendererOptions all = RendererOptions::everything(device);
    CHECK(all.paper.friction.coefficient == 0.0);
    CHECK(complaint(all, device) == "");
  }
  // Without a damper friction alone would be that soft, whatever guidance has.
  Capabilities undamped = light_device(0.045);
  undamped.viscous_friction = 0.0;
  RendererOptions bare;
  bare.paper.friction.coefficient = 0.2;
  bare.paper.friction.damping = 0.0;
  CHECK(clip_stiffness(bare, undamped).size() >= 1);
  CHECK(bare.paper.friction.coefficient == 0.0);
  CHECK(complaint(bare, undamped) == "");
  // Where 1 N/m or more remains, friction remains.
  for (const int delay : {0, 1, 2, 3, 5}) {
    RendererOptions options;
    options.paper.friction.coefficient = 0.2;
    clip_stiffness(options, light_device(0.045, delay));
    CAPTURE(delay);
    CHECK(options.paper.friction.coefficient == 0.2);
    CHECK(options.paper.friction.stiffness >= 1.0);
  }
}

TEST_CASE("clipping never throws and always leaves what validate() accepts, whatever the device", "[render]") {
  for (const double mass : {0.0, 0.02, 0.045, 0.3}) {
    for (const int delay : {0, 1, 5, 15}) {
      for (const double rate : {100.0, 1000.0, 10'000.0}) {
        const Capabilities device = light_device(mass, delay, rate);
        const RendererOptions options = RendererOptions::for_device(device);
        CAPTURE(mass, delay, rate, complaint(options, device));
        CHECK(options.stiffness_check == StiffnessCheck::clip);
        CHECK(complaint(options, device).empty());
        for (const double scale : {0.3, 4.0}) {
          RendererOptions scaled = options;
          clip_stiffness(scaled, device, scale);
          CHECK(complaint(scaled, device, scale).empty());
          CHECK(clip_stiffness(scaled, device, scale).empty());
        }
        if (rate >= 1000.0 && delay <= 1) CHECK(complaint(RendererOptions::everything(device), device).empty());
      }
    }
  }
}

TEST_CASE("attraction factors beyond what the device permits throw, or are limited stroke by stroke when clipping",
          "[render]") {
  const Capabilities device = test_device();
  const PlacedCharacter strong{calligraphy_test::typical_character(1, {1.0, 2.0}), {{0.02, 0.02}, 0.04}};
  RendererOptions options;
  CHECK(contains(complaint([&] { HapticRenderer({strong}, {}, device, options); }), "maximum attraction factor 2"));
  options.stiffness_check = StiffnessCheck::clip;
  HapticRenderer renderer({strong}, {}, device, options);
  REQUIRE(renderer.clipped().size() == 1);
  CHECK(contains(renderer.clipped()[0], "maximum attraction factor 2"));
  CHECK(renderer.options().guidance.stiffness == 600.0);  // where the factor is 1 nothing changes
  const double most = max_guidance_stiffness(renderer.options(), device);
  REQUIRE(most < 1200.0);
  calligraphy_test::ScriptedPen pen(renderer);
  const Stroke stroke = strokes(renderer.page()[0].character)[0];
  const Point start = renderer.page()[0].placement.to_page(stroke.control_points.front());
  const Point end = renderer.page()[0].placement.to_page(stroke.control_points.back());
  const Point left = Point(start.y() - end.y(), end.x() - start.x()).normalized();
  double strongest = 0.0;
  pen.on_tick = [&](const HapticTick& tick) {
    if (tick.state != InteractionState::writing || tick.contact.closest.distance < 1e-3) return;
    strongest = std::max(strongest, tick.attraction.norm() / tick.contact.closest.distance);
  };
  pen.go(calligraphy_test::at(start, 0.005));
  pen.go(calligraphy_test::at(start, -0.001));
  pen.go(calligraphy_test::at(start + 0.9 * (end - start) + 0.002 * left, -0.001));
  CHECK(strongest == Approx(most));
}

TEST_CASE("every accepted stiffness gives finite forces on a device that states no limit", "[render]") {
  Capabilities device = test_device();
  device.usable_stiffness = 0.0;
  for (const double stiffness : {1e-300, 1e-12, 1e6, 1e12, 1e306, 1.7e308}) {
    RendererOptions options;
    options.stiffness_check = StiffnessCheck::off;
    options.paper.stiffness = options.guidance.stiffness = options.guidance.wrong_way_stiffness = stiffness;
    if (stiffness > 1e6) CHECK(contains(complaint(options, device), "paper.stiffness"));
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
  PlacedCharacter strong = placed(U'永');
  strong.character.physics.attraction_factors[0] = infinity;
  CHECK(contains(refusal({strong}), "character 1 of the page: stroke 1"));

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

TEST_CASE("the renderer runs at the device's rate unless asked for another, and stays within its stiffness",
          "[render]") {
  Capabilities device = test_device();
  device.usable_stiffness = 150.0;
  device.update_rate = 500.0;
  const RendererOptions options = RendererOptions::for_device(device);
  CHECK(HapticRenderer({placed(U'永')}, {}, device, options).options().servo_rate == 500.0);
  RendererOptions asked = options;
  asked.servo_rate = 2000.0;
  CHECK(HapticRenderer({placed(U'永')}, {}, device, asked).options().servo_rate == 2000.0);
  Capabilities silent = device;
  silent.update_rate = 0.0;
  CHECK(contains(complaint(options, silent), "update_rate of the device = 0 Hz"));
  CHECK(options.paper.stiffness == 150.0);
  CHECK(options.guidance.stiffness == 150.0);
  CHECK(options.guidance.wrong_way_stiffness == 150.0);
  CHECK(complaint(options, device).empty());
  CHECK(RendererOptions::for_device(test_device()).paper.stiffness == RendererOptions{}.paper.stiffness);
}

TEST_CASE("the hand feels the same stiffness, damping and force at every motion scale", "[render]") {
  for (const Capabilities& device : device_profiles()) {
    const auto felt = [&](RendererOptions options, double scale) {
      CHECK(complaint([&] { validate(options, device, scale); }).empty());
      const double square = scale * scale;
      return std::vector<double>{options.paper.stiffness * square,
                                 options.paper.damping * square,
                                 options.guidance.stiffness * square,
                                 options.guidance.damping * square,
                                 options.guidance.wrong_way_stiffness * square,
                                 options.paper.friction.stiffness * square,
                                 options.paper.friction.damping * square,
                                 options.guidance.limit * scale,
                                 options.guidance.wrong_way_limit * scale,
                                 options.paper.friction.coefficient,
                                 options.limits.in_plane_rate,
                                 options.limits.normal_rate,
                                 options.energy.budget};
    };
    for (const double scale : {0.5, 2.0}) {  // powers of two: nothing is rounded
      CAPTURE(device.name, scale);
      CHECK(felt(RendererOptions::for_device(device, scale), scale) == felt(RendererOptions::for_device(device), 1.0));
      CHECK(felt(RendererOptions::everything(device, scale), scale) == felt(RendererOptions::everything(device), 1.0));
    }
  }
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(contains(complaint([&] { RendererOptions::for_device(test_device(), scale); }), "scale = "));
  }
}

TEST_CASE("a damper that drives the pen by itself is refused beside no spring too", "[render]") {
  Capabilities device = test_device();
  device.apparent_mass = 0.045;
  device.sample_delay = 2;
  RendererOptions options;
  options.guidance.stiffness = options.guidance.wrong_way_stiffness = 0.0;
  options.guidance.damping = 300.0;
  CHECK(contains(complaint(options, device), "guidance.damping = 300"));
  clip_stiffness(options, device);
  CHECK(options.guidance.damping < 30.0);
  CHECK(options.guidance.damping > 4.0);
  CHECK(complaint(options, device).empty());
  // As is one that turns the steps of a coarse encoder into clicks.
  device.sample_delay = 0;
  device.encoder_step = 1e-4;
  options.guidance.damping = 8.0;
  options.paper.damping = 3.0;
  CHECK(contains(complaint(options, device), "guidance.damping = 8"));
  device.coulomb_friction = 0.26;  // holds them
  CHECK(complaint(options, device).empty());
}

TEST_CASE("what has been clipped is not clipped again, with any scale", "[render]") {
  calligraphy_test::Sequence random(77);
  for (int i = 0; i < 300; ++i) {
    Capabilities device = test_device();
    device.apparent_mass = random.between(0.02, 0.3);
    device.viscous_friction = random.between(0.0, 0.5);
    device.usable_stiffness = 0.0;
    device.sample_delay = static_cast<int>(random.between(0.0, 5.99));
    RendererOptions options;
    options.servo_rate = random.between(300.0, 5000.0);
    options.paper.friction.coefficient = 0.2;
    const double scale = random.between(0.3, 3.0);
    clip_stiffness(options, device, scale);
    CHECK(clip_stiffness(options, device, scale).empty());
  }
}

TEST_CASE("a pen that is fast on an enlarged page, not in the hand, is no fault", "[render]") {
  MotionMapping mapping;
  mapping.scale = 3.0;
  RendererOptions options;
  options.stiffness_check = StiffnessCheck::clip;
  HapticRenderer renderer({placed(U'永')}, mapping, test_device(), options);
  DeviceState state;
  for (int i = 0; i < 45; ++i) {
    state.time = 0.001 * i;
    state.position.x() = 0.5 * 90.0 * state.time * state.time;  // up to 4 m/s
    CHECK(renderer.update(state).status == TickStatus::ok);
  }
}

TEST_CASE("the maximum force step is that of the fastest pen that is followed, in newtons at the device", "[render]") {
  for (const double scale : {0.5, 1.0, 4.0}) {
    MotionMapping mapping;
    mapping.scale = scale;
    RendererOptions options;
    options.servo_rate = 500.0;
    options.stiffness_check = StiffnessCheck::off;
    const HapticRenderer renderer({placed(U'永')}, mapping, test_device(), options);
    // 100 and 400 N/s at 500 Hz; 1 m/s against springs of 600 + 200 and 600 N/m, and kicks of 0.3 m/s against dampers
    // of 4 N s/m.
    const double square = scale * scale;
    const double in_plane = 0.2 + square * (800.0 * 1.0 * 0.002 + 4.0 * 0.3);
    const double normal = 0.8 + square * (600.0 * 1.0 * 0.002 + 4.0 * 0.3);
    CHECK(renderer.max_force_step() == Approx(std::hypot(in_plane, normal)));
  }
}

TEST_CASE("however a pen at rest came there, its force changes by at most 0.41 N per tick at 1 kHz, with any scale",
          "[render]") {
  for (const double scale : {0.5, 1.0, 2.0}) {
    MotionMapping mapping;
    mapping.scale = scale;
    RendererOptions options;
    options.stiffness_check = StiffnessCheck::clip;
    HapticRenderer renderer({placed(U'永')}, mapping, test_device(), options);
    const Stroke first = strokes(renderer.page()[0].character)[0];
    const Point start = renderer.page()[0].placement.to_page(first.control_points[0]);
    calligraphy_test::ScriptedPen pen(renderer);
    double most = 0.0, longest = 0.0;
    for (const double depth : {0.002, 0.01}) {
      for (const double speed : {0.05, 0.5, 2.0}) {
        pen.speed = speed * scale;
        pen.go(calligraphy_test::at(start, 0.01));
        pen.go(calligraphy_test::at(start, -depth));
        pen.go(calligraphy_test::at(start + Point(0.003, 0.004), -depth));
        // At rest from here on; after 60 ticks the velocity filter has forgotten that it moved.
        for (int i = 0; i < 60; ++i) pen.at(calligraphy_test::at(start + Point(0.003, 0.004), -depth));
        pen.max_step = 0.0;
        DeviceState faulty;
        faulty.status = DeviceStatus::fault;
        for (int i = 0; i < 50; ++i) pen.sample(faulty);  // the force is released, and returns
        for (int i = 0; i < 200; ++i) pen.at(calligraphy_test::at(start + Point(0.003, 0.004), -depth));
        most = std::max(most, pen.max_step);
        longest = std::max(longest, renderer.last().force.norm());
      }
    }
    CHECK(longest > 0.5);
    CHECK(most <= std::hypot(0.1, 0.4) + 1e-6);
    CHECK(most > 0.4);
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
  CHECK(HapticRenderer({placed(U'永')}, mapping, test_device(), options).options().paper.stiffness == Approx(250.0));
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
