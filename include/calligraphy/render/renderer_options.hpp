// Everything that a user of the renderer may choose.
#pragma once

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/render/force_terms.hpp>
#include <calligraphy/render/motion_mapping.hpp>

namespace calligraphy {

/// Where the virtual pen tip is while the device is below the paper.
enum class PenTipRule {
  projected,  ///< on the paper, above or below the device: Table 2
  wang2006    ///< at the device, eq. (5)
};

struct RendererOptions {
  double servo_rate = 1000.0;         ///< [Hz]
  double paper_stiffness = 600.0;     ///< K_en of eq. (9) [N/m]
  double guidance_stiffness = 600.0;  ///< K_et of eq. (8) where the attraction factor is 1 [N/m]
  double guidance_fade_in = 0.15;     ///< after a stroke's start and each feature point guidance comes in over this [s]
  double wrong_way_stiffness = 200.0;  ///< resistance against writing backwards; 0: none [N/m]
  double wrong_way_limit = 1.0;        ///< its largest force [N]
  double wrong_way_slack = 0.002;      ///< a pen may go back this far unhindered [m]

  StrokeRules stroke;  ///< nearest point, constraint space, feature planes, attraction factors

  double start_radius = 0.008;    ///< neighbourhood of a stroke's start that begins the stroke [m]
  double box_margin = 0.008;      ///< added to the bounding box of the active character on every side [m]
  double lift_height = 0.0005;    ///< the pen has left the paper once it is this far above it; hysteresis [m]
  double box_hysteresis = 0.002;  ///< the box is left this far outside its edge; three times as far while writing [m]
  bool lift_between_strokes = true;  ///< the next stroke begins with a new contact, not by sliding into its start
  bool solid_paper = false;          ///< normal force in the adjusting state too; Table 2 has none there

  double in_plane_force_rate = 100.0;  ///< largest change of the force within the paper [N/s]
  double normal_force_rate = 400.0;    ///< largest change of the force along its normal [N/s]
  bool limit_force_rate = true;        ///< false: `wang2006`, forces step at every transition

  double largest_speed = 5.0;  ///< a sample that implies a faster pen is a fault, not a motion [m/s, page]

  ForceSign force_sign = ForceSign::attracting;
  PenTipRule pen_tip = PenTipRule::projected;
  MotionMappingRule motion = MotionMappingRule::affine;

  /// Every rule as printed, but for the signs of eq. (8) and (9), which the text at hand may have lost: with them as
  /// they stand nothing can be written (set force_sign to see it). Widths and stiffnesses as above.
  static RendererOptions wang2006();

  /// The defaults with stiffnesses no larger than the device's usable stiffness, at its update rate.
  static RendererOptions for_device(const Capabilities& capabilities);
};

/// @throws ValueError naming the option and its value: not finite, out of its domain, or a stiffness (times the largest
/// attraction factor on the page) above the device's usable stiffness
void validate(const RendererOptions& options, const Capabilities& capabilities, double largest_attraction = 1.0);

}  // namespace calligraphy
