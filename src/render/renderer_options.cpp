#include <calligraphy/render/renderer_options.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include <calligraphy/error.hpp>

namespace calligraphy {
namespace {

/// For a device that states no limit; keeps every force a number [N/m].
constexpr double stiffest = 1e6;

enum class Bound { above_zero, from_zero };

void require(const char* name, double value, Bound bound, double most = std::numeric_limits<double>::max()) {
  const bool in_domain = bound == Bound::above_zero ? value > 0.0 : value >= 0.0;
  if (std::isfinite(value) && in_domain && value <= most) return;
  std::ostringstream message;
  message << name << " = " << value << ": expected a finite number "
          << (bound == Bound::above_zero ? "above 0" : "from 0 up");
  if (most < std::numeric_limits<double>::max()) message << ", at most " << most;
  throw ValueError(message.str());
}

void require_count(const char* name, int value, int least, int most) {
  if (value >= least && value <= most) return;
  std::ostringstream message;
  message << name << " = " << value << ": expected a whole number from " << least << " to " << most;
  throw ValueError(message.str());
}

void require_stiffness(const char* name, double value, double factor, const Capabilities& capabilities) {
  require(name, value, Bound::from_zero);
  const double stated = capabilities.usable_stiffness;
  const double usable = stated > 0.0 ? std::min(stated, stiffest) : stiffest;
  if (value * factor <= usable) return;
  std::ostringstream message;
  message << name << " = " << value << " N/m";
  if (factor != 1.0) message << " times the largest attraction factor " << factor;
  message << ": the device " << capabilities.model << " is usable up to " << usable << " N/m";
  throw ValueError(message.str());
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
  if (capabilities.usable_stiffness > 0.0) {
    for (double* stiffness : {&options.paper_stiffness, &options.guidance_stiffness, &options.wrong_way_stiffness}) {
      *stiffness = std::min(*stiffness, capabilities.usable_stiffness);
    }
  }
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
  options.force_jerk = 1e5;
  options.passivity_control = true;
  options.energy_budget = 0.1;
  const bool warms = capabilities.continuous_force > 0.0 && capabilities.continuous_force < capabilities.peak_force;
  options.thermal_time_constant = warms ? 10.0 : 0.0;
  return options;
}

void validate(const RendererOptions& options, const Capabilities& capabilities, double largest_attraction) {
  require("servo_rate", options.servo_rate, Bound::above_zero, 1e6);
  require_stiffness("paper_stiffness", options.paper_stiffness, 1.0, capabilities);
  require_stiffness("guidance_stiffness", options.guidance_stiffness, largest_attraction, capabilities);
  require_stiffness("wrong_way_stiffness", options.wrong_way_stiffness, 1.0, capabilities);
  require("guidance_fade_in", options.guidance_fade_in, Bound::from_zero);
  require("wrong_way_limit", options.wrong_way_limit, Bound::from_zero);
  require("wrong_way_slack", options.wrong_way_slack, Bound::from_zero);
  require("guidance_limit", options.guidance_limit, Bound::above_zero);
  require("assist.retention", options.assist.retention, Bound::from_zero, 1.0);
  require("assist.full_help_error", options.assist.full_help_error, Bound::above_zero);
  require("assist.least", options.assist.least, Bound::from_zero, 1.0);
  require("friction.coefficient", options.friction.coefficient, Bound::from_zero, 10.0);
  require("friction.stiffness", options.friction.stiffness, Bound::above_zero, stiffest);
  require("friction.static_ratio", options.friction.static_ratio, Bound::above_zero, 10.0);
  require("friction.stick_speed", options.friction.stick_speed, Bound::from_zero);
  require("stroke.nearest.tolerance", options.stroke.nearest.tolerance, Bound::above_zero, 1.0);
  require_count("stroke.nearest.samples", options.stroke.nearest.samples, 2, 64);
  require_count("stroke.nearest.refinements", options.stroke.nearest.refinements, 0, 8);
  require("stroke.space.radius", options.stroke.space.radius, Bound::above_zero);
  require("stroke.space.edge", options.stroke.space.edge, Bound::above_zero, options.stroke.space.radius);
  require("stroke.plane_tolerance", options.stroke.plane_tolerance, Bound::from_zero);
  require("stroke.window", options.stroke.window, Bound::from_zero);
  require("start_radius", options.start_radius, Bound::above_zero);
  require("box_margin", options.box_margin, Bound::from_zero);
  require("lift_height", options.lift_height, Bound::from_zero);
  require("box_hysteresis", options.box_hysteresis, Bound::from_zero);
  require("in_plane_force_rate", options.in_plane_force_rate, Bound::above_zero);
  require("normal_force_rate", options.normal_force_rate, Bound::above_zero);
  if (!(options.force_jerk == std::numeric_limits<double>::infinity())) {
    require("force_jerk", options.force_jerk, Bound::above_zero);
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
