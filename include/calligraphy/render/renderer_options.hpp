// Everything that a user of the renderer may choose.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/render/assist_policy.hpp>
#include <calligraphy/render/force_terms.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/paper_friction.hpp>

namespace calligraphy {

/// Where the virtual pen tip is while the device is below the paper.
enum class PenTipRule {
  projected,  ///< on the paper, above or below the device: Table 2
  wang2006    ///< at the device, eq. (5)
};

/// How the guidance grows with the distance from the stroke.
enum class GuidanceLaw {
  linear,     ///< eq. (8) within the constraint space, none outside
  saturating  ///< eq. (8) near the stroke, never above `guidance_limit`, anywhere in the character's box
};

/// What happens to a stiffness that the device is not usable or not stable with.
enum class StiffnessCheck {
  refuse,  ///< the renderer is not made: ValueError
  clip,    ///< the largest that is; HapticRenderer::clipped() has the reasons
  none     ///< it is taken, up to 1e6 N/m: for an experiment that looks for the limit itself
};

struct RendererOptions {
  double servo_rate = 1000.0;         ///< [Hz]
  double paper_stiffness = 600.0;     ///< K_en of eq. (9) [N/m]
  double guidance_stiffness = 600.0;  ///< K_et of eq. (8) where the attraction factor is 1 [N/m]
  double guidance_fade_in = 0.15;     ///< after a stroke's start and each feature point guidance comes in over this [s]
  double wrong_way_stiffness = 200.0;  ///< resistance against writing backwards; 0: none [N/m]
  double wrong_way_limit = 1.0;        ///< its largest force [N]
  double wrong_way_slack = 0.002;      ///< a pen may go back this far unhindered [m]

  StiffnessCheck stiffness_check = StiffnessCheck::refuse;
  /// The softest grip that the loop is to be stable in, where the device states its mass (critical_stiffness()).
  Hand softest_grip = {0.05, 1.0, 100.0};

  GuidanceLaw guidance = GuidanceLaw::linear;
  double guidance_limit = 2.0;  ///< saturating: the largest guidance force [N]
  bool guide_to_start = false;  ///< on the paper before a stroke, guidance pulls to the stroke's start
  AssistPolicy assist;          ///< off by default: full help
  FrictionOptions friction;     ///< off by default

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

  /// Largest change of the rate of the force; infinite: any [N/s^2].
  double force_jerk = std::numeric_limits<double>::infinity();

  bool passivity_control = false;  ///< damps out what sampling, delay and limits add to the force field's energy
  /// Net energy that may be given to the hand from the start on; infinite: any [J].
  double energy_budget = std::numeric_limits<double>::infinity();
  /// Of the motors' heat: the force falls from the device's peak to its continuous force as they warm; 0: no limit [s].
  double thermal_time_constant = 0.0;

  double largest_speed = 5.0;  ///< a sample that implies a faster pen is a fault, not a motion [m/s, page]

  ForceSign force_sign = ForceSign::attracting;
  PenTipRule pen_tip = PenTipRule::projected;
  MotionMappingRule motion = MotionMappingRule::affine;

  /// Every rule as printed, but for the signs of eq. (8) and (9), which the text at hand may have lost: with them as
  /// they stand nothing can be written (set force_sign to see it). Widths and stiffnesses as above.
  static RendererOptions wang2006();

  /// The defaults at the device's update rate, their stiffnesses clipped to what it is usable and stable with.
  static RendererOptions for_device(const Capabilities& capabilities);

  /// for_device() with every stage switched on: friction, guidance for large deviations, help as needed, limited jerk,
  /// passivity control and an energy budget where the device states its mass and a delay of at most 15 ticks, a thermal
  /// budget where it states a continuous force below its peak.
  static RendererOptions everything(const Capabilities& capabilities);
};

/// Clips the stiffnesses to nine tenths of what is stable in the softest grip, at the options' rate and the device's
/// sample delay, where the device states its mass; and to its usable stiffness, where it states one. The guidance
/// counts with the largest attraction factor on the page, the pen's hold on the paper (friction) on top of it;
/// paper_stiffness is also clipped to what normal_force_rate and force_jerk can follow at 0.2 m/s. With a motion scale
/// K_S (MotionMapping) all count K_S^2 times: that is what the device feels of them.
/// @return what was clipped, each with its reason
/// @throws ValueError naming the option when a stiffness is negative or not finite, or the rate is none
std::vector<std::string> clip_stiffness(RendererOptions& options, const Capabilities& capabilities,
                                        double largest_attraction = 1.0, double scale = 1.0);

/// @throws ValueError naming the option and its value: not finite, out of its domain, or a stiffness that
/// clip_stiffness() would clip
void validate(const RendererOptions& options, const Capabilities& capabilities, double largest_attraction = 1.0,
              double scale = 1.0);

}  // namespace calligraphy
