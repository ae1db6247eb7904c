// The options of a renderer as they take effect on a device and a page.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

struct EffectiveOptions {
  double guidance_limit = 0.0;       ///< maximum stiffness of guidance, attraction factor included [N/m, page]
  double law_share = 1.0;            ///< share of its spring that the device permits [1]
  GuidanceTraits traits;             ///< of the guidance law
  RendererOptions options;
  double max_attraction = 1.0;       ///< largest attraction factor on the page [1]
  bool has_own_law = false;          ///< the law is not a built-in one
  double law_stiffness = 0.0;        ///< at which the force may follow the pen because of the law [N/m, page]
  std::vector<std::string> clipped;  ///< one line per value, with the reason

  /// Stiffness of guidance where the attraction factor is this one [N/m, page].
  double guidance_stiffness(double attraction) const noexcept {
    return std::min(options.guidance.stiffness * attraction, guidance_limit);
  }
};

/// The servo rate of the options, or the device's own if they leave it at 0 [Hz]. @throws ValueError naming the one
/// that is out of range
double servo_rate(const RendererOptions& options, const Capabilities& capabilities);

/// Makes the guidance law, and adapts the options to its traits.
/// @throws ValueError when a trait is invalid or too stiff, or needs an energy account that the device does not permit
std::unique_ptr<GuidanceLaw> guidance_law(EffectiveOptions& effective, const Capabilities& capabilities);

/// Checks everything that is requested, and clips it if that is requested too.
/// @throws ValueError naming the character of the page, the mapping, the option or the device property that is invalid
EffectiveOptions effective_options(const RendererOptions& options, const std::vector<PlacedCharacter>& page,
                                   const MotionMapping& mapping, const Capabilities& capabilities);

}  // namespace calligraphy
