#include <calligraphy/render/renderer_options.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/detail/energy_observer.hpp>

#include "base/require.hpp"
#include "stiffness_limits.hpp"

namespace calligraphy {
namespace {

/// Keeps every force step finite [N/s].
constexpr double max_force_rate = 1e12;

/// Limits of guidance for large deviations: hardly softer than the linear law where that is at its strongest.
constexpr double max_saturated_guidance = 3.0;  ///< [N]
constexpr double guidance_peak_share = 0.75;    ///< of the peak force

/// Friction between pen and paper, of which everything() renders what the device does not have itself.
constexpr double paper_friction_coefficient = 0.15;

void require_force_rate(const char* name, double rate) {
  if (rate != std::numeric_limits<double>::infinity()) require_above_zero(name, rate, "N/s", max_force_rate);
}

/// On a page of motion scale K_S, what the hand feels as it does these options at scale 1.
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
  options.guidance.law = GuidanceLaw::saturating;
  options.guidance.limit = std::min(max_saturated_guidance, guidance_peak_share * capabilities.peak_force) / scale;
  options.guidance.to_start = true;
  options.contact.box_margin = 0.5;
  const double own_friction = capabilities.coulomb_friction / usual_pressure;
  if (own_friction < paper_friction_coefficient)
    options.paper.friction.coefficient = paper_friction_coefficient - own_friction;
  clip_stiffness(options, capabilities, scale);
  const bool is_modelled = capabilities.apparent_mass > 0.0 && capabilities.sample_delay <= EnergyObserver::max_delay;
  if (is_modelled) options.energy.budget = 0.1;
  const bool warms = capabilities.continuous_force > 0.0 && capabilities.continuous_force < capabilities.peak_force;
  options.limits.thermal_time_constant = warms ? 10.0 : 0.0;
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
  require_not_negative("paper.onset", options.paper.onset, "m");
  require_not_negative("guidance.fade_in", options.guidance.fade_in, "s");
  require_not_negative("guidance.fade_out", options.guidance.fade_out, "s");
  require_not_negative("guidance.wrong_way_limit", options.guidance.wrong_way_limit, "N");
  require_not_negative("guidance.wrong_way_slack", options.guidance.wrong_way_slack, "em");
  require_above_zero("guidance.limit", options.guidance.limit, "N");
  require_within("guidance.assist.retention", options.guidance.assist.retention, "", 0.0, 1.0);
  require_above_zero("guidance.assist.full_assistance_error", options.guidance.assist.full_assistance_error, "em");
  require_within("guidance.assist.min_assistance", options.guidance.assist.min_assistance, "", 0.0, 1.0);
  require_within("paper.friction.damping", options.paper.friction.damping, "N s/m", 0.0, max_damping);
  require_within("paper.friction.coefficient", options.paper.friction.coefficient, "", 0.0, 10.0);
  require_above_zero("paper.friction.stiffness", options.paper.friction.stiffness, "N/m", max_stiffness);
  try {
    validate(options.nearest);
  } catch (const ValueError& error) {
    throw ValueError(std::string("nearest.") + error.what());
  }
  require_above_zero("guidance.space.radius", options.guidance.space.radius, "em");
  require_above_zero("guidance.space.fade_width", options.guidance.space.fade_width, "em",
                     options.guidance.space.radius);
  validate(options.tolerances);
  require_not_negative("contact.box_margin", options.contact.box_margin, "em");
  require_not_negative("contact.lift_time", options.contact.lift_time, "s");
  require_not_negative("contact.lift_clearance", options.contact.lift_clearance, "m");
  require_force_rate("limits.in_plane_rate", options.limits.in_plane_rate);
  require_force_rate("limits.normal_rate", options.limits.normal_rate);
  if (!(options.energy.budget == std::numeric_limits<double>::infinity())) {
    require_not_negative("energy.budget", options.energy.budget, "J");
    require_above_zero("apparent_mass of the device, for energy.budget", capabilities.apparent_mass, "kg");
  }
  require_not_negative("energy.max_gap", options.energy.max_gap, "s");
  require_not_negative("limits.thermal_time_constant", options.limits.thermal_time_constant, "s");
  if (options.limits.thermal_time_constant > 0.0) {
    require_above_zero("continuous_force of the device, for limits.thermal_time_constant",
                       capabilities.continuous_force, "N");
  }
  require_above_zero("grip_stiffness", options.grip_stiffness, "N/m");
  require_above_zero("limits.max_speed", options.limits.max_speed, "m/s");
}

}  // namespace calligraphy
