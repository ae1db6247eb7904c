// Options of the haptic renderer.
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

/// Where the virtual pen tip is while the device is below the paper surface.
enum class PenTipRule {
  projected,  ///< the device point projected onto the paper: Table 2
  wang2006    ///< at the device, eq. (5)
};

/// How guidance depends on the distance from the stroke.
enum class GuidanceLaw {
  linear,     ///< eq. (8) within the constraint space, zero outside
  saturating  ///< eq. (8) near the stroke, at most `guidance_limit`, anywhere in the character's box
};

/// What to do with a stiffness above what is usable or stable on the device.
enum class StiffnessCheck {
  reject,  ///< the constructor throws a ValueError
  clip,    ///< use the maximum permitted value; HapticRenderer::clipped() gives the reasons
  off      ///< accept it, up to 1e6 N/m: for experiments that look for the limit itself
};

struct RendererOptions {
  double servo_rate = 1000.0;          ///< [Hz]
  double paper_stiffness = 600.0;      ///< K_en of eq. (9) [N/m]
  double guidance_stiffness = 600.0;   ///< K_et of eq. (8) where the attraction factor is 1 [N/m]
  double guidance_fade_in = 0.15;      ///< fade-in time of guidance after a stroke's start and each feature point [s]
  double wrong_way_stiffness = 200.0;  ///< resistance to writing backwards; 0: none [N/m]
  double wrong_way_limit = 1.0;        ///< maximum force of that resistance [N]
  double wrong_way_slack = 0.002;      ///< dead band: a pen may move back this far without resistance [m]

  StiffnessCheck stiffness_check = StiffnessCheck::reject;
  /// Softest grip in which the loop must be stable, where the device states its mass (critical_stiffness()).
  GripImpedance softest_grip = {0.05, 1.0, 100.0};

  GuidanceLaw guidance = GuidanceLaw::linear;
  double guidance_limit = 2.0;  ///< saturating: maximum guidance force [N]
  bool guide_to_start = false;  ///< before a stroke, guidance pulls a pen on the paper to the stroke's start
  AssistPolicy assist;          ///< off by default: full assistance
  FrictionOptions friction;     ///< off by default

  StrokeRules stroke;  ///< nearest point, constraint space, feature planes, attraction factors

  double start_radius = 0.008;       ///< a stroke begins within this distance of its start [m]
  double box_margin = 0.008;         ///< added to the bounding box of the active character on every side [m]
  double lift_height = 0.0005;       ///< hysteresis: the pen counts as lifted once it is this far above the paper [m]
  double box_hysteresis = 0.002;     ///< the box is left this far outside its edge, 3 times as far while writing [m]
  bool lift_between_strokes = true;  ///< the next stroke begins with a new contact, not by sliding into its start
  bool solid_paper = false;          ///< normal force also in the adjusting state; Table 2 has none there

  double in_plane_force_rate = 100.0;  ///< maximum rate of change of the force in the paper plane [N/s]
  double normal_force_rate = 400.0;    ///< maximum rate of change of the force along its normal [N/s]
  bool limit_force_rate = true;        ///< false: `wang2006`, force steps at every transition

  /// Maximum jerk of the force; infinite: no limit [N/s^2].
  double force_jerk = std::numeric_limits<double>::infinity();

  bool passivity_control = false;  ///< dissipates the energy that sampling, delay and limits generate
  /// Maximum net energy delivered to the hand since the start; infinite: no limit [J].
  double energy_budget = std::numeric_limits<double>::infinity();
  /// Thermal time constant of the motors: as they warm, the permitted force falls from the device's peak to its
  /// continuous force; 0: no limit [s].
  double thermal_time_constant = 0.0;

  double max_speed = 5.0;  ///< a sample that implies a faster pen is a fault, not a motion [m/s, page]

  ForceSign force_sign = ForceSign::attracting;
  PenTipRule pen_tip = PenTipRule::projected;
  MotionMappingRule motion = MotionMappingRule::affine;

  /// Every rule as printed, except the signs of eq. (8) and (9), which the available text may have lost: with the signs
  /// as printed nothing can be written (set force_sign to see it). Widths and stiffnesses are the defaults.
  static RendererOptions wang2006();

  /// The defaults at the device's update rate, with stiffnesses clipped to what is usable and stable on it.
  static RendererOptions for_device(const Capabilities& capabilities);

  /// for_device() with all optional stages enabled: friction, guidance for large deviations, assistance as needed, jerk
  /// limit; passivity control and an energy budget where the device states its mass and a delay of at most 15 ticks; a
  /// thermal budget where it states a continuous force below its peak.
  static RendererOptions everything(const Capabilities& capabilities);
};

/// Clips the stiffnesses to nine tenths of what is stable in the softest grip, at the options' rate and the device's
/// sample delay, where the device states its mass; and to its usable stiffness, where it states one. Guidance counts
/// with the maximum attraction factor on the page, and the friction spring is added to it; paper_stiffness is also
/// clipped to what normal_force_rate and force_jerk can follow at 0.2 m/s. With a motion scale K_S (MotionMapping) each
/// counts K_S^2 times, which is what the device renders.
/// @return what was clipped, each with its reason
/// @throws ValueError naming the option when a stiffness is negative or not finite, or the rate is not above 0
std::vector<std::string> clip_stiffness(RendererOptions& options, const Capabilities& capabilities,
                                        double max_attraction = 1.0, double scale = 1.0);

/// @throws ValueError naming the option and its value: not finite, out of range, or a stiffness that clip_stiffness()
/// would clip
void validate(const RendererOptions& options, const Capabilities& capabilities, double max_attraction = 1.0,
              double scale = 1.0);

}  // namespace calligraphy
