#include <calligraphy/render/renderer_options.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "energy_budget.hpp"
#include "stiffness_limits.hpp"

namespace calligraphy {
namespace {

/// At a lower rate, a force released by a fault would stay for longer than the hand takes to notice; the upper bound
/// keeps every force step finite [N/s].
constexpr double min_force_rate = 10.0, max_force_rate = 1e12;

/// More than any device has [N].
constexpr double max_force = 1e6;

/// Limits of guidance for large deviations: hardly softer than the linear law where that is at its strongest.
constexpr double max_saturated_guidance = 3.0;  ///< [N]
constexpr double guidance_peak_share = 0.75;    ///< of the peak force

/// Friction between pen and paper; everything() renders the part that the device does not have itself.
constexpr double paper_friction_coefficient = 0.15;

void require_force_rate(const char* name, double rate) {
  if (rate == std::numeric_limits<double>::infinity()) return;
  require_within(name, rate, "N/s", min_force_rate, max_force_rate,
                 "by a slower one a force neither sets in with a stroke nor is gone soon after a fault");
}

/// Options that feel the same on a page of motion scale K_S as these do at scale 1.
RendererOptions felt_alike(RendererOptions options, double scale) {
  for (double* impedance :
       {&options.paper.stiffness, &options.paper.damping, &options.guidance.stiffness, &options.guidance.damping,
        &options.guidance.wrong_way_stiffness, &options.paper.friction.stiffness, &options.paper.friction.damping}) {
    *impedance /= scale * scale;
  }
  for (double* force : {&options.guidance.limit, &options.guidance.wrong_way_limit}) *force /= scale;
  return options;
}

}  // namespace

RendererOptions RendererOptions::wang2006() {
  RendererOptions options;
  options.rules = Rules::wang2006;
  options.nearest = {NearestPointMethod::wang2006, 1e-6};
  options.contact.box_margin = 0.0;
  options.tolerances.direction = std::numbers::pi;
  options.tolerances.first_stretch = 0.0;
  options.tolerances.distinction = std::numeric_limits<double>::infinity();
  options.tolerances.coverage = 0.0;
  options.contact.lift_between_strokes = false;
  options.limits.in_plane_rate = options.limits.normal_rate = std::numeric_limits<double>::infinity();
  options.guidance.fade_in = options.guidance.fade_out = 0.0;
  options.contact.lift_time = 0.0;
  options.guidance.force = printed_guidance;
  options.paper.onset = 0.0;
  options.paper.damping = options.guidance.damping = options.paper.friction.damping = 0.0;
  options.stiffness_check = StiffnessCheck::off;
  return options;
}

RendererOptions RendererOptions::for_device(const Capabilities& capabilities, double scale) {
  require_above_zero("scale", scale, "");
  RendererOptions options = felt_alike(RendererOptions(), scale);
  options.stiffness_check = StiffnessCheck::clip;
  clip_stiffness(options, capabilities, scale);
  return options;
}

RendererOptions RendererOptions::everything(const Capabilities& capabilities, double scale) {
  RendererOptions options = for_device(capabilities, scale);
  options.guidance.force = saturating_guidance;
  options.guidance.limit = std::min(max_saturated_guidance, guidance_peak_share * capabilities.peak_force) / scale;
  options.guidance.to_start = true;
  options.contact.box_margin = 0.5;
  const double own_friction = capabilities.coulomb_friction / usual_pressure;
  if (own_friction < paper_friction_coefficient)
    options.paper.friction.coefficient = paper_friction_coefficient - own_friction;
  clip_stiffness(options, capabilities, scale);
  if (permits_account(capabilities)) options.energy.budget = usual_energy_budget;
  const bool warms = capabilities.continuous_force > 0.0 && capabilities.continuous_force < capabilities.peak_force;
  options.limits.thermal_time_constant = warms ? 10.0 : 0.0;
  if (!capabilities.simulated) options.limits.max_standstill = 0.5;
  return options;
}

void validate(const RendererOptions& options, const Capabilities& capabilities, double scale) {
  if (options.stiffness_check == StiffnessCheck::off && !capabilities.simulated) {
    throw ValueError("stiffness_check = off, must be reject or clip on the device " + device_label(capabilities) +
                     ": only simulated devices may be unstable");
  }
  RendererOptions stable = options;
  const std::vector<std::string> too_stiff = clip_stiffness(stable, capabilities, scale);
  if (!too_stiff.empty()) throw ValueError(too_stiff.front());
  require_within("paper.onset", options.paper.onset, "m", 0.0, 0.01, "a hand presses no deeper");
  for (const auto& [name, time] : {std::pair{"guidance.fade_in", options.guidance.fade_in},
                                   std::pair{"guidance.fade_out", options.guidance.fade_out}}) {
    require_within(name, time, "s", 0.0, 5.0, "strokes are shorter");
  }
  require_within("guidance.wrong_way_limit", options.guidance.wrong_way_limit, "N", 0.0, max_force);
  require_within("guidance.wrong_way_slack", options.guidance.wrong_way_slack, "em", 0.0, 1.0,
                 "nobody goes back farther");
  require_within("guidance.limit", options.guidance.limit, "N", 1e-3, max_force, "nobody feels less");
  require_within("guidance.assist.retention", options.guidance.assist.retention, "", 0.0, 1.0);
  require_within("guidance.assist.full_assistance_error", options.guidance.assist.full_assistance_error, "em", 1e-5, 1.0,
                 "nobody writes so exactly, or is so far off");
  require_within("guidance.assist.min_assistance", options.guidance.assist.min_assistance, "", 0.0, 1.0);
  require_within("paper.friction.damping", options.paper.friction.damping, "N s/m", 0.0, max_damping);
  require_within("paper.friction.coefficient", options.paper.friction.coefficient, "", 0.0, 10.0);
  require_within("paper.friction.stiffness", options.paper.friction.stiffness, "N/m", 1e-3, max_stiffness,
                 "a softer spring slides by as much as a stroke before it rubs");
  try {
    validate(options.nearest);
  } catch (const ValueError& error) {
    throw ValueError(std::string("nearest.") + error.what());
  }
  require_within("guidance.space.radius", options.guidance.space.radius, "em", 0.01, 10.0,
                 "beside a narrower tube every pen is lost");
  require_within("guidance.space.fade_width", options.guidance.space.fade_width, "em", 0.001, options.guidance.space.radius,
                 "a tube with a sharper edge throws the pen, and a wider edge has no middle");
  validate(options.tolerances);
  require_within("contact.box_margin", options.contact.box_margin, "em", 0.0, 10.0, "a page has room for no more");
  require_within("contact.lift_time", options.contact.lift_time, "s", 0.0, 1.0, "a pen that bounces is back sooner");
  require_within("contact.lift_clearance", options.contact.lift_clearance, "m", 0.0, 0.05,
                 "between strokes a pen is lifted no farther");
  require_force_rate("limits.in_plane_rate", options.limits.in_plane_rate);
  require_force_rate("limits.normal_rate", options.limits.normal_rate);
  if (!(options.energy.budget == std::numeric_limits<double>::infinity())) {
    require_not_negative("energy.budget", options.energy.budget, "J");
    require_above_zero("apparent_mass of the device, for energy.budget", capabilities.apparent_mass, "kg");
  }
  // A hand of 2 m/s gains 0.2 J from 1 N in 0.1 s.
  require_within("energy.max_gap", options.energy.max_gap, "s", 0.0, 0.1,
                 "over a longer one a budget permits hardly any force");
  require_within("limits.thermal_time_constant", options.limits.thermal_time_constant, "s", 0.0, 3600.0,
                 "motors are warm sooner");
  if (options.limits.thermal_time_constant > 0.0) {
    require_above_zero("continuous_force of the device, for limits.thermal_time_constant",
                       capabilities.continuous_force, "N");
  }
  require_within("grip_stiffness", options.grip_stiffness, "N/m", 10.0, 1e5, "no hand is softer, or firmer");
  require_within("limits.max_speed", options.limits.max_speed, "m/s", 0.5, 100.0,
                 "a hand is as fast, and no device is faster");
  if (options.limits.max_acceleration != std::numeric_limits<double>::infinity()) {
    require_within("limits.max_acceleration", options.limits.max_acceleration, "m/s^2", 20.0, 1e6,
                   "a hand that writes accelerates as much, and no pen more");
  }
  if (options.limits.max_standstill != std::numeric_limits<double>::infinity()) {
    require_within("limits.max_standstill", options.limits.max_standstill, "s", 0.1, 3600.0,
                   "a hand takes as long to yield, and nobody waits longer");
  }
}

}  // namespace calligraphy
