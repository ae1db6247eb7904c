#include <calligraphy/render/detail/effective_options.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/detail/prepared_page.hpp>

#include "base/require.hpp"
#include "exact_pen.hpp"

namespace calligraphy {

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
  require_exact_pen_taken(page, effective.options, capabilities, mapping);

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
