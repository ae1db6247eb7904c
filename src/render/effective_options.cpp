#include "effective_options.hpp"

#include <cmath>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "energy_budget.hpp"
#include "exact_pen.hpp"
#include "prepared_page.hpp"

namespace calligraphy {
namespace {

constexpr double max_stated_stiffness = 1e8;  ///< as good as no limit [N/m]
constexpr double max_stated_power = 10.0;     ///< [W]

/// Sets an energy budget, where one can be kept, for a law of unknown stiffness or one that leads the pen on.
void require_energy_budget(EffectiveOptions& effective, const Capabilities& capabilities) {
  EnergyOptions& energy = effective.options.energy;
  const GuidanceTraits& traits = effective.traits;
  if (energy.limited() || !(std::isnan(traits.stiffness) || traits.power > 0.0)) return;
  const std::string law = "the guidance law \"" + traits.name + "\" states " +
                          (traits.power > 0.0 ? "a power" : "no stiffness");
  if (permits_account(capabilities)) {
    energy.budget = usual_energy_budget;
    effective.clipped.push_back("energy.budget = " + number_text(energy.budget) + " J: " + law);
    effective.traits.name += ", within " + number_text(energy.budget) + " J";
    return;
  }
  const std::string refusal = law + ", so it needs a budget of energy, which the device " + device_label(capabilities) +
                              " does not permit: its apparent mass is " + number_text(capabilities.apparent_mass) +
                              " kg, its delay " + number_text(capabilities.sample_delay) + " ticks";
  if (!capabilities.simulated) throw ValueError(refusal);
  effective.clipped.push_back(refusal);
}

}  // namespace

std::unique_ptr<GuidanceLaw> guidance_law(EffectiveOptions& effective, const Capabilities& capabilities) {
  const double limit = std::min(effective.guidance_limit, max_stated_stiffness);
  const GuidanceOptions& options = effective.options.guidance;
  std::unique_ptr<GuidanceLaw> law = options.force({options, effective.guidance_stiffness(effective.max_attraction),
                                                    limit, 1.0 / effective.options.servo_rate});
  if (!law) throw ValueError("guidance.force: made no law");
  effective.has_own_law = !options.force.is(linear_guidance) && !options.force.is(saturating_guidance) &&
                          !options.force.is(printed_guidance);
  GuidanceTraits& traits = effective.traits = law->traits();
  const std::string name = "guidance law \"" + traits.name + "\": ";
  require_within(name + "power", traits.power, "W", 0.0, max_stated_power);
  if (std::isnan(traits.stiffness)) {
    effective.law_stiffness = limit;
  } else {
    require_within(name + "stiffness", traits.stiffness, "N/m", 0.0, max_stated_stiffness);
    effective.law_stiffness = std::min(traits.stiffness, limit);
  }
  if (traits.stiffness > limit) {
    Message message;
    message << name << "stiffness = " << traits.stiffness << " N/m is above " << limit
            << " N/m, the maximum on the device " << device_label(capabilities) << " with this damping";
    if (effective.options.stiffness_check != StiffnessCheck::clip) throw ValueError(message.str());
    effective.law_share = limit / traits.stiffness;
    message << ": the spring is scaled by " << effective.law_share;
    effective.clipped.push_back(message.str());
    traits.name += ", scaled by " + number_text(std::round(1e4 * effective.law_share) / 1e4);
  }
  require_energy_budget(effective, capabilities);
  return law;
}

double servo_rate(const RendererOptions& options, const Capabilities& capabilities) {
  const bool is_asked_for = options.servo_rate != 0.0;
  const double rate = is_asked_for ? options.servo_rate : capabilities.update_rate;
  require_within(is_asked_for ? "servo_rate" : "update_rate of the device", rate, "Hz", 10.0, 1e6,
                 "a slower loop guides nobody");
  return rate;
}

EffectiveOptions effective_options(const RendererOptions& options, const std::vector<PlacedCharacter>& page,
                                   const MotionMapping& mapping, const Capabilities& capabilities) {
  validate(page);
  validate(mapping);
  EffectiveOptions effective;
  effective.options = options;
  effective.options.servo_rate = servo_rate(options, capabilities);
  const bool clips = options.stiffness_check == StiffnessCheck::clip;
  if (clips) effective.clipped = clip_stiffness(effective.options, capabilities, mapping.scale);
  validate(effective.options, capabilities, mapping.scale);
  require_translations(capabilities, "the renderer");
  require_exact_pen_accepted(page, effective.options, capabilities, mapping);

  // Where strokes attract more than others, guidance is limited there, not on the whole page.
  effective.guidance_limit = max_guidance_stiffness(effective.options, capabilities, mapping.scale);
  for (const PlacedCharacter& placed : page) {
    for (const double factor : placed.character.physics.attraction_factors) {
      effective.max_attraction = std::max(effective.max_attraction, factor);
    }
  }
  const double stiffness = effective.options.guidance.stiffness;
  if (stiffness * effective.max_attraction <= effective.guidance_limit) return effective;
  Message message;
  message << "guidance.stiffness = " << stiffness << " N/m times the maximum attraction factor "
          << effective.max_attraction << " is above " << effective.guidance_limit << " N/m, the maximum on the device "
          << device_label(capabilities);
  if (!clips) throw ValueError(message.str());
  effective.clipped.push_back(message.str());
  return effective;
}

}  // namespace calligraphy
