#include <calligraphy/render/renderer_options.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/passivity_controller.hpp>

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

/// On a page of motion scale K_S, what the hand feels as it does these options at scale 1.
RendererOptions felt_alike(RendererOptions options, double scale) {
  for (double* impedance :
       {&options.paper_stiffness, &options.paper_damping, &options.guidance_stiffness, &options.guidance_damping,
        &options.wrong_way_stiffness, &options.friction.stiffness, &options.friction.damping}) {
    *impedance /= scale * scale;
  }
  for (double* force : {&options.guidance_limit, &options.wrong_way_limit}) *force /= scale;
  return options;
}

}  // namespace

RendererOptions RendererOptions::wang2006() {
  RendererOptions options;
  options.stroke.nearest = {NearestPointMethod::wang2006, 1e-6};
  options.stroke.space.rule = ConstraintSpaceRule::wang2006;
  options.stroke.plane = FeaturePlaneRule::wang2006;
  options.stroke.attraction = AttractionRule::wang2006;
  options.stroke.window = 0.0;
  options.box_margin = 0.0;
  options.tolerances.direction = std::numbers::pi;
  options.tolerances.first_stretch = 0.0;
  options.tolerances.distinction = std::numeric_limits<double>::infinity();
  options.tolerances.coverage = 0.0;
  options.lift_height = 0.0;
  options.box_hysteresis = 0.0;
  options.lift_between_strokes = false;
  options.limit_force_rate = false;
  options.guidance_fade_in = options.guidance_fade_out = 0.0;
  options.pen_tip = PenTipRule::wang2006;
  options.motion = MotionMappingRule::wang2006;
  options.lift_time = 0.0;
  options.paper_onset = 0.0;
  options.paper_damping = options.guidance_damping = options.friction.damping = 0.0;
  options.stiffness_check = StiffnessCheck::off;
  return options;
}

RendererOptions RendererOptions::for_device(const Capabilities& capabilities, double scale) {
  require_above_zero("scale", scale, "");
  RendererOptions options = felt_alike(RendererOptions(), scale);
  options.servo_rate = capabilities.update_rate;
  options.stiffness_check = StiffnessCheck::clip;
  clip_stiffness(options, capabilities, scale);
  return options;
}

RendererOptions RendererOptions::everything(const Capabilities& capabilities, double scale) {
  RendererOptions options = for_device(capabilities, scale);
  options.guidance = GuidanceLaw::saturating;
  options.guidance_limit = std::min(max_saturated_guidance, guidance_peak_share * capabilities.peak_force) / scale;
  options.guide_to_start = true;
  options.box_margin = 0.5;
  const double own_friction = capabilities.coulomb_friction / usual_pressure;
  if (own_friction < paper_friction_coefficient)
    options.friction.coefficient = paper_friction_coefficient - own_friction;
  clip_stiffness(options, capabilities, scale);
  const bool is_modelled =
      capabilities.apparent_mass > 0.0 && capabilities.sample_delay <= PassivityController::max_delay;
  if (is_modelled) options.energy_budget = 0.1;
  const bool warms = capabilities.continuous_force > 0.0 && capabilities.continuous_force < capabilities.peak_force;
  options.thermal_time_constant = warms ? 10.0 : 0.0;
  return options;
}

void validate(const RendererOptions& options, const Capabilities& capabilities, double scale) {
  require_above_zero("servo_rate", options.servo_rate, "Hz", 1e6);
  if (options.stiffness_check == StiffnessCheck::off && !capabilities.simulated) {
    throw ValueError("stiffness_check = off, must be reject or clip on the device " + device_label(capabilities) +
                     ": only simulated devices may be unstable");
  }
  RendererOptions stable = options;
  const std::vector<std::string> too_stiff = clip_stiffness(stable, capabilities, scale);
  if (!too_stiff.empty()) throw ValueError(too_stiff.front());
  require_not_negative("paper_onset", options.paper_onset, "m");
  require_not_negative("guidance_fade_in", options.guidance_fade_in, "s");
  require_not_negative("guidance_fade_out", options.guidance_fade_out, "s");
  require_not_negative("wrong_way_limit", options.wrong_way_limit, "N");
  require_not_negative("wrong_way_slack", options.wrong_way_slack, "em");
  require_above_zero("guidance_limit", options.guidance_limit, "N");
  require_within("assist.retention", options.assist.retention, "", 0.0, 1.0);
  require_above_zero("assist.full_assistance_error", options.assist.full_assistance_error, "em");
  require_within("assist.min_assistance", options.assist.min_assistance, "", 0.0, 1.0);
  require_within("friction.damping", options.friction.damping, "N s/m", 0.0, max_damping);
  require_within("friction.coefficient", options.friction.coefficient, "", 0.0, 10.0);
  require_above_zero("friction.stiffness", options.friction.stiffness, "N/m", max_stiffness);
  try {
    validate(options.stroke.nearest);
  } catch (const ValueError& error) {
    throw ValueError(std::string("stroke.nearest.") + error.what());
  }
  require_above_zero("stroke.space.radius", options.stroke.space.radius, "em");
  require_above_zero("stroke.space.fade_width", options.stroke.space.fade_width, "em", options.stroke.space.radius);
  require_not_negative("stroke.plane_tolerance", options.stroke.plane_tolerance, "em");
  require_not_negative("stroke.window", options.stroke.window, "em");
  validate(options.tolerances);
  require_not_negative("box_margin", options.box_margin, "em");
  require_not_negative("lift_height", options.lift_height, "m");
  require_not_negative("lift_time", options.lift_time, "s");
  require_not_negative("lift_clearance", options.lift_clearance, "m");
  require_not_negative("box_hysteresis", options.box_hysteresis, "em");
  require_above_zero("in_plane_force_rate", options.in_plane_force_rate, "N/s", max_force_rate);
  require_above_zero("normal_force_rate", options.normal_force_rate, "N/s", max_force_rate);
  if (!(options.energy_budget == std::numeric_limits<double>::infinity())) {
    require_not_negative("energy_budget", options.energy_budget, "J");
    require_above_zero("apparent_mass of the device, for energy_budget", capabilities.apparent_mass, "kg");
  }
  require_not_negative("max_gap", options.max_gap, "s");
  require_not_negative("thermal_time_constant", options.thermal_time_constant, "s");
  if (options.thermal_time_constant > 0.0) {
    require_above_zero("continuous_force of the device, for thermal_time_constant", capabilities.continuous_force, "N");
  }
  if (options.passivity_control) {
    require_above_zero("apparent_mass of the device, for passivity_control", capabilities.apparent_mass, "kg");
  }
  require_above_zero("grip_stiffness", options.grip_stiffness, "N/m");
  require_above_zero("max_speed", options.max_speed, "m/s");
}

}  // namespace calligraphy
