#include <calligraphy/render/renderer_options.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/passivity_controller.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// For a device that states no limit; keeps every force finite [N/m].
constexpr double stiffest = 1e6;

/// Keeps every force step finite [N/s].
constexpr double fastest_force = 1e12;

/// Fraction of the critical stiffness, a margin for what a rigid mass does not model.
constexpr double stable_share = 0.9;

struct StiffnessLimit {
  double value;  ///< [N/m]
  std::string reason;
};

StiffnessLimit usable_stiffness(const Capabilities& capabilities) {
  if (!(capabilities.usable_stiffness > 0.0 && capabilities.usable_stiffness < stiffest)) {
    return {stiffest, "at most 1e6 N/m are accepted"};
  }
  std::ostringstream reason;
  reason << "the device " << capabilities.model << " is usable up to " << capabilities.usable_stiffness << " N/m";
  return {capabilities.usable_stiffness, reason.str()};
}

/// Rounded to single precision: the last bits, which differ between implementations of libm, reach no force.
double without_last_bits(double stiffness) { return static_cast<float>(stiffness); }

/// A pen that hits the paper requires the force to change at K times its speed v. A limiter that is slower, or reaches
/// this rate too slowly for the oscillation of mass and spring, lags behind and throws the pen back, again and again.
/// An empirical result of simulation (docs/stability.md): this does not happen where K v <= rate and where K v / jerk,
/// the time to reach that rate, is at most two fifths of sqrt(m / K).
StiffnessLimit followed_stiffness(const RendererOptions& options, const Capabilities& capabilities) {
  constexpr double meeting_speed = 0.2;  // [m/s]
  if (!options.limit_force_rate || !(capabilities.apparent_mass > 0.0)) {
    return {std::numeric_limits<double>::infinity(), ""};
  }
  const double mass = capabilities.apparent_mass + options.softest_grip.mass;
  const double by_rate = options.normal_force_rate / meeting_speed;
  const double by_jerk = std::pow(0.4 * options.force_jerk * std::sqrt(mass) / meeting_speed, 2.0 / 3.0);
  const double followed = without_last_bits(std::min(by_rate, by_jerk));
  std::ostringstream reason;
  reason << ": with normal_force_rate = " << options.normal_force_rate << " N/s and force_jerk = " << options.force_jerk
         << " N/s^2 the force can follow a pen at " << meeting_speed << " m/s up to " << followed << " N/m";
  return {followed, reason.str()};
}

StiffnessLimit stable_stiffness(const RendererOptions& options, const Capabilities& capabilities) {
  if (!(capabilities.apparent_mass > 0.0)) return {std::numeric_limits<double>::infinity(), ""};
  const double critical =
      without_last_bits(critical_stiffness({capabilities, options.servo_rate, options.softest_grip}));
  std::ostringstream reason;
  reason << "in the softest grip at " << options.servo_rate << " Hz the device " << capabilities.model
         << " is stable below " << critical << " N/m (critical_stiffness); the limit is nine tenths of that, "
         << stable_share * critical << " N/m";
  return {stable_share * critical, reason.str()};
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
  options.lift_height = 0.0;
  options.box_hysteresis = 0.0;
  options.lift_between_strokes = false;
  options.limit_force_rate = false;
  options.guidance_fade_in = 0.0;
  options.pen_tip = PenTipRule::wang2006;
  options.motion = MotionMappingRule::wang2006;
  return options;
}

RendererOptions RendererOptions::for_device(const Capabilities& capabilities) {
  RendererOptions options;
  options.servo_rate = capabilities.update_rate;
  clip_stiffness(options, capabilities);
  return options;
}

RendererOptions RendererOptions::everything(const Capabilities& capabilities) {
  RendererOptions options = for_device(capabilities);
  options.guidance = GuidanceLaw::saturating;
  options.guidance_limit = std::min(options.guidance_limit, 0.5 * capabilities.peak_force);
  options.guide_to_start = true;
  options.box_margin = 0.02;
  options.assist.enabled = true;
  options.friction.coefficient = 0.15;
  clip_stiffness(options, capabilities);
  options.force_jerk = 1e5;
  const bool is_modelled =
      capabilities.apparent_mass > 0.0 && capabilities.sample_delay <= PassivityController::max_delay;
  options.passivity_control = is_modelled;
  if (is_modelled) options.energy_budget = 0.1;
  const bool warms = capabilities.continuous_force > 0.0 && capabilities.continuous_force < capabilities.peak_force;
  options.thermal_time_constant = warms ? 10.0 : 0.0;
  return options;
}

std::vector<std::string> clip_stiffness(RendererOptions& options, const Capabilities& capabilities,
                                        double max_attraction, double scale) {
  require_above_zero("servo_rate", options.servo_rate, "Hz", 1e6);
  require_not_negative("max_attraction", max_attraction, "");
  require_above_zero("scale", scale, "");
  const Capabilities unknown;  // states no limit
  const Capabilities& known = options.stiffness_check == StiffnessCheck::off ? unknown : capabilities;
  StiffnessLimit usable = usable_stiffness(known), stable = stable_stiffness(options, known);
  if (scale != 1.0) {
    // Motion is enlarged on the page, and so is force: the device renders K K_S^2.
    std::ostringstream enlarged;
    enlarged << " times the square of the motion scale " << scale << ": ";
    for (StiffnessLimit* limit : {&usable, &stable})
      *limit = {limit->value / (scale * scale), enlarged.str() + limit->reason};
  } else {
    for (StiffnessLimit* limit : {&usable, &stable}) limit->reason = ": " + limit->reason;
  }
  std::vector<std::string> clipped;
  const auto clip = [&](const char* name, double& stiffness, double most, const std::string& reason) {
    require_not_negative(name, stiffness, "N/m");
    if (stiffness <= most) return;
    std::ostringstream message;
    message << name << " = " << stiffness << " N/m" << reason;
    clipped.push_back(message.str());
    stiffness = most;
  };
  const StiffnessLimit& limit = usable.value < stable.value ? usable : stable;
  std::ostringstream attraction;
  if (max_attraction != 1.0) attraction << " times the maximum attraction factor " << max_attraction;
  clip("paper_stiffness", options.paper_stiffness, limit.value, limit.reason);
  const StiffnessLimit followed = followed_stiffness(options, known);
  clip("paper_stiffness", options.paper_stiffness, followed.value / (scale * scale), followed.reason);
  clip("guidance_stiffness", options.guidance_stiffness, limit.value / max_attraction, attraction.str() + limit.reason);
  clip("wrong_way_stiffness", options.wrong_way_stiffness, limit.value, limit.reason);
  if (options.friction.coefficient > 0.0) {
    // `usable_stiffness` applies to each of the two springs, one along the stroke and one across; stability requires
    // counting both.
    clip("friction.stiffness", options.friction.stiffness, limit.value, limit.reason);
    const double guidance = options.guidance_stiffness * max_attraction;
    std::ostringstream beside;
    beside << " in addition to " << guidance << " N/m of guidance";
    clip("friction.stiffness", options.friction.stiffness, std::max(0.1 * stable.value, stable.value - guidance),
         beside.str() + stable.reason);
  }
  return clipped;
}

void validate(const RendererOptions& options, const Capabilities& capabilities, double max_attraction, double scale) {
  require_above_zero("servo_rate", options.servo_rate, "Hz", 1e6);
  RendererOptions stable = options;
  const std::vector<std::string> too_stiff = clip_stiffness(stable, capabilities, max_attraction, scale);
  if (!too_stiff.empty()) throw ValueError(too_stiff.front());
  require_not_negative("guidance_fade_in", options.guidance_fade_in, "s");
  require_not_negative("wrong_way_limit", options.wrong_way_limit, "N");
  require_not_negative("wrong_way_slack", options.wrong_way_slack, "m");
  require_above_zero("guidance_limit", options.guidance_limit, "N");
  require_within("assist.retention", options.assist.retention, "", 0.0, 1.0);
  require_above_zero("assist.full_assistance_error", options.assist.full_assistance_error, "m");
  require_within("min_assistance", options.assist.min_assistance, "", 0.0, 1.0);
  require_within("friction.coefficient", options.friction.coefficient, "", 0.0, 10.0);
  require_above_zero("friction.stiffness", options.friction.stiffness, "N/m", stiffest);
  require_within("friction.static_ratio", options.friction.static_ratio, "", 1.0, 10.0);
  require_not_negative("friction.stick_speed", options.friction.stick_speed, "m/s");
  try {
    validate(options.stroke.nearest);
  } catch (const ValueError& error) {
    throw ValueError(std::string("stroke.nearest.") + error.what());
  }
  require_above_zero("stroke.space.radius", options.stroke.space.radius, "m");
  require_above_zero("stroke.space.fade_width", options.stroke.space.fade_width, "m", options.stroke.space.radius);
  require_not_negative("stroke.plane_tolerance", options.stroke.plane_tolerance, "m");
  require_not_negative("stroke.window", options.stroke.window, "m");
  require_above_zero("start_radius", options.start_radius, "m");
  require_not_negative("box_margin", options.box_margin, "m");
  require_not_negative("lift_height", options.lift_height, "m");
  require_not_negative("box_hysteresis", options.box_hysteresis, "m");
  require_above_zero("in_plane_force_rate", options.in_plane_force_rate, "N/s", fastest_force);
  require_above_zero("normal_force_rate", options.normal_force_rate, "N/s", fastest_force);
  if (!(options.force_jerk == std::numeric_limits<double>::infinity())) {
    require_above_zero("force_jerk", options.force_jerk, "N/s^2", 1e3 * fastest_force);
  }
  if (!(options.energy_budget == std::numeric_limits<double>::infinity())) {
    require_not_negative("energy_budget", options.energy_budget, "J");
  }
  require_not_negative("thermal_time_constant", options.thermal_time_constant, "s");
  if (options.thermal_time_constant > 0.0) {
    require_above_zero("continuous_force of the device, for thermal_time_constant", capabilities.continuous_force, "N");
  }
  if (options.passivity_control) {
    require_above_zero("apparent_mass of the device, for passivity_control", capabilities.apparent_mass, "kg");
  }
  require_above_zero("max_speed", options.max_speed, "m/s");
}

}  // namespace calligraphy
