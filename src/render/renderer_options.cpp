#include <calligraphy/render/renderer_options.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/passivity_controller.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

namespace calligraphy {
namespace {

/// For a device that states no limit; keeps every force a number [N/m].
constexpr double stiffest = 1e6;

enum class Bound { above_zero, from_zero, from_one };

void require(const char* name, double value, Bound bound, double most = std::numeric_limits<double>::max()) {
  const bool in_domain = bound == Bound::above_zero ? value > 0.0 : value >= (bound == Bound::from_one ? 1.0 : 0.0);
  if (std::isfinite(value) && in_domain && value <= most) return;
  const char* domain = bound == Bound::above_zero ? "above 0" : bound == Bound::from_zero ? "from 0 up" : "from 1 up";
  std::ostringstream message;
  message << name << " = " << value << ": expected a finite number " << domain;
  if (most < std::numeric_limits<double>::max()) message << ", at most " << most;
  throw ValueError(message.str());
}

/// Keeps every step of a force a number [N/s].
constexpr double fastest_force = 1e12;

/// Of the critical stiffness, what is left for what a rigid mass does not show.
constexpr double stable_share = 0.9;

struct StiffnessLimit {
  double value;  ///< [N/m]
  std::string reason;
};

StiffnessLimit usable_stiffness(const Capabilities& capabilities) {
  if (!(capabilities.usable_stiffness > 0.0 && capabilities.usable_stiffness < stiffest)) {
    return {stiffest, "no stiffness above it is taken"};
  }
  std::ostringstream reason;
  reason << "the device " << capabilities.model << " is usable up to " << capabilities.usable_stiffness << " N/m";
  return {capabilities.usable_stiffness, reason.str()};
}

/// In single precision: the last bits, in which one libm differs from another, reach no force.
double without_last_bits(double stiffness) { return static_cast<float>(stiffness); }

/// A pen that meets the paper calls for a change of force of K times its speed v; a limiter that gives less, or comes
/// up to it too slowly for the swing of mass and spring, lags behind and throws the pen back, ever on. Found by
/// simulation (docs/stability.md): no such swing where K v <= rate, and where K v / jerk, the time to come up to it, is
/// at most two fifths of sqrt(m / K).
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
         << " N/s^2 the force follows a pen of " << meeting_speed << " m/s up to " << followed << " N/m";
  return {followed, reason.str()};
}

StiffnessLimit stable_stiffness(const RendererOptions& options, const Capabilities& capabilities) {
  if (!(capabilities.apparent_mass > 0.0)) return {std::numeric_limits<double>::infinity(), ""};
  const double critical =
      without_last_bits(critical_stiffness({capabilities, options.servo_rate, options.softest_grip}));
  std::ostringstream reason;
  reason << "held in the softest grip at " << options.servo_rate << " Hz the device " << capabilities.model
         << " is stable below " << critical << " N/m (critical_stiffness), nine tenths of which is "
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
      capabilities.apparent_mass > 0.0 && capabilities.sample_delay <= PassivityController::longest_delay;
  options.passivity_control = is_modelled;
  if (is_modelled) options.energy_budget = 0.1;
  const bool warms = capabilities.continuous_force > 0.0 && capabilities.continuous_force < capabilities.peak_force;
  options.thermal_time_constant = warms ? 10.0 : 0.0;
  return options;
}

std::vector<std::string> clip_stiffness(RendererOptions& options, const Capabilities& capabilities,
                                        double largest_attraction, double scale) {
  require("servo_rate", options.servo_rate, Bound::above_zero, 1e6);
  require("largest_attraction", largest_attraction, Bound::from_zero);
  require("scale", scale, Bound::above_zero);
  const Capabilities unknown;  // states no limit
  const Capabilities& known = options.stiffness_check == StiffnessCheck::none ? unknown : capabilities;
  StiffnessLimit usable = usable_stiffness(known), stable = stable_stiffness(options, known);
  if (scale != 1.0) {
    // Motion appears enlarged and so does force: the device feels K K_S^2.
    std::ostringstream enlarged;
    enlarged << " times the square of the motion scale " << scale << ": ";
    for (StiffnessLimit* limit : {&usable, &stable})
      *limit = {limit->value / (scale * scale), enlarged.str() + limit->reason};
  } else {
    for (StiffnessLimit* limit : {&usable, &stable}) limit->reason = ": " + limit->reason;
  }
  std::vector<std::string> clipped;
  const auto clip = [&](const char* name, double& stiffness, double most, const std::string& reason) {
    require(name, stiffness, Bound::from_zero);
    if (stiffness <= most) return;
    std::ostringstream message;
    message << name << " = " << stiffness << " N/m" << reason;
    clipped.push_back(message.str());
    stiffness = most;
  };
  const StiffnessLimit& limit = usable.value < stable.value ? usable : stable;
  std::ostringstream attraction;
  if (largest_attraction != 1.0) attraction << " times the largest attraction factor " << largest_attraction;
  clip("paper_stiffness", options.paper_stiffness, limit.value, limit.reason);
  const StiffnessLimit followed = followed_stiffness(options, known);
  clip("paper_stiffness", options.paper_stiffness, followed.value / (scale * scale), followed.reason);
  clip("guidance_stiffness", options.guidance_stiffness, limit.value / largest_attraction,
       attraction.str() + limit.reason);
  clip("wrong_way_stiffness", options.wrong_way_stiffness, limit.value, limit.reason);
  if (options.friction.coefficient > 0.0) {
    // A device may be usable with both springs at once, one along the stroke and one across; stable it must be with
    // both.
    clip("friction.stiffness", options.friction.stiffness, limit.value, limit.reason);
    const double guidance = options.guidance_stiffness * largest_attraction;
    std::ostringstream beside;
    beside << " beside " << guidance << " N/m of guidance";
    clip("friction.stiffness", options.friction.stiffness, std::max(0.1 * stable.value, stable.value - guidance),
         beside.str() + stable.reason);
  }
  return clipped;
}

void validate(const RendererOptions& options, const Capabilities& capabilities, double largest_attraction,
              double scale) {
  require("servo_rate", options.servo_rate, Bound::above_zero, 1e6);
  RendererOptions stable = options;
  const std::vector<std::string> too_stiff = clip_stiffness(stable, capabilities, largest_attraction, scale);
  if (!too_stiff.empty()) throw ValueError(too_stiff.front());
  require("guidance_fade_in", options.guidance_fade_in, Bound::from_zero);
  require("wrong_way_limit", options.wrong_way_limit, Bound::from_zero);
  require("wrong_way_slack", options.wrong_way_slack, Bound::from_zero);
  require("guidance_limit", options.guidance_limit, Bound::above_zero);
  require("assist.retention", options.assist.retention, Bound::from_zero, 1.0);
  require("assist.full_help_error", options.assist.full_help_error, Bound::above_zero);
  require("assist.least", options.assist.least, Bound::from_zero, 1.0);
  require("friction.coefficient", options.friction.coefficient, Bound::from_zero, 10.0);
  require("friction.stiffness", options.friction.stiffness, Bound::above_zero, stiffest);
  require("friction.static_ratio", options.friction.static_ratio, Bound::from_one, 10.0);
  require("friction.stick_speed", options.friction.stick_speed, Bound::from_zero);
  try {
    validate(options.stroke.nearest);
  } catch (const ValueError& error) {
    throw ValueError(std::string("stroke.nearest.") + error.what());
  }
  require("stroke.space.radius", options.stroke.space.radius, Bound::above_zero);
  require("stroke.space.edge", options.stroke.space.edge, Bound::above_zero, options.stroke.space.radius);
  require("stroke.plane_tolerance", options.stroke.plane_tolerance, Bound::from_zero);
  require("stroke.window", options.stroke.window, Bound::from_zero);
  require("start_radius", options.start_radius, Bound::above_zero);
  require("box_margin", options.box_margin, Bound::from_zero);
  require("lift_height", options.lift_height, Bound::from_zero);
  require("box_hysteresis", options.box_hysteresis, Bound::from_zero);
  require("in_plane_force_rate", options.in_plane_force_rate, Bound::above_zero, fastest_force);
  require("normal_force_rate", options.normal_force_rate, Bound::above_zero, fastest_force);
  if (!(options.force_jerk == std::numeric_limits<double>::infinity())) {
    require("force_jerk", options.force_jerk, Bound::above_zero, 1e3 * fastest_force);
  }
  if (!(options.energy_budget == std::numeric_limits<double>::infinity())) {
    require("energy_budget", options.energy_budget, Bound::from_zero);
  }
  require("thermal_time_constant", options.thermal_time_constant, Bound::from_zero);
  if (options.thermal_time_constant > 0.0) {
    require("continuous_force of the device, for thermal_time_constant", capabilities.continuous_force,
            Bound::above_zero);
  }
  if (options.passivity_control) {
    require("apparent_mass of the device, for passivity_control", capabilities.apparent_mass, Bound::above_zero);
  }
  require("largest_speed", options.largest_speed, Bound::above_zero);
}

}  // namespace calligraphy
