// Options of the haptic renderer.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/collision/constraint_space.hpp>
#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/collision/rules.hpp>
#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/render/assist_policy.hpp>
#include <calligraphy/render/paper_friction.hpp>
#include <calligraphy/render/stroke_tolerances.hpp>

namespace calligraphy {

/// How guidance depends on the distance from the stroke.
enum class GuidanceLaw {
  linear,     ///< eq. (8) within the constraint space, zero outside
  saturating  ///< eq. (8) near the stroke, at most `guidance_limit`, anywhere in the character's box
};

/// What to do with a stiffness above what is usable or stable on the device.
enum class StiffnessCheck {
  reject,  ///< the constructor throws a ValueError
  clip,    ///< use the maximum permitted value; HapticRenderer::clipped() gives the reasons
  off      ///< accept it, up to 1e6 N/m: for experiments on simulated devices that look for the limit itself
};

/// The paper under the pen.
struct PaperOptions {
  double stiffness = 600.0;  ///< K_en of eq. (9) [N/m]
  double damping = 4.0;      ///< against motion in the paper, along its normal [N s/m]
  double onset = 0.0005;     ///< depth over which the paper becomes as stiff and as damped as that [m]
  bool solid = false;        ///< normal force also in the adjusting state; Table 2 has none there
  FrictionOptions friction;  ///< between pen and paper; off by default
};

/// The lateral force: along which stroke, how strongly, and how it comes and goes.
struct GuidanceOptions {
  double stiffness = 600.0;  ///< K_et of eq. (8) where the attraction factor is 1 [N/m]
  /// Where guidance acts, against motion across the stroke; elsewhere on the paper 15 % of it, against any [N s/m].
  double damping = 4.0;
  GuidanceLaw law = GuidanceLaw::linear;  ///< how the force depends on the distance from the stroke
  double limit = 2.0;                     ///< saturating: maximum guidance force [N]
  /// Before a stroke, guidance pulls a pen to the stroke's start that was put down nearer to it than to any to come,
  /// though not on the stroke.
  bool to_start = false;
  ConstraintSpace space;               ///< how far from the stroke it acts
  double fade_in = 0.15;               ///< fade-in time after a stroke's start and each feature point [s]
  double fade_out = 0.3;               ///< fade-out time when it lets go: a pulled hand must not be thrown [s]
  double wrong_way_stiffness = 200.0;  ///< resistance to writing backwards; 0: none [N/m]
  double wrong_way_limit = 1.0;        ///< maximum force of that resistance [N]
  double wrong_way_slack = 0.05;       ///< dead band: a pen may move back this far without resistance [em]
  AssistPolicy assist;                 ///< off by default: full assistance
};

/// When the pen touches the paper, and when it is at a character.
struct ContactOptions {
  double lift_time = 0.05;           ///< it counts as lifted once it has been above the paper for this time [s],
  double lift_clearance = 0.003;     ///< or at once this far above the paper; until then it may bounce [m]
  bool lift_between_strokes = true;  ///< the next stroke begins with a new contact, not by sliding into its start
  double box_margin = 0.2;           ///< added to the bounding box of the active character on every side [em]
};

/// What bounds the force on its way to the device, and the motion that is believed.
struct ForceLimits {
  /// Maximum rate of change of the force in the paper plane, beyond what the springs and dampers change because the pen
  /// moves: that follows the pen without lag. Infinite: no limit [N/s].
  double in_plane_rate = 100.0;
  double normal_rate = 400.0;  ///< likewise along its normal [N/s]
  /// Thermal time constant of the motors: as they warm, the permitted force falls from the device's peak to its
  /// continuous force; 0: no limit [s].
  double thermal_time_constant = 0.0;
  double max_speed = 5.0;  ///< a sample that implies a faster pen is a fault, not a motion [m/s, device]
};

/// What energy the force may deliver to the hand.
struct EnergyOptions {
  bool passivity_control = false;  ///< dissipates the energy that sampling, delay and limits generate
  /// Maximum net energy delivered to the hand since the start; infinite: no limit [J].
  double budget = std::numeric_limits<double>::infinity();
  double max_gap = 0.016;  ///< with a budget: longest time without a fresh sample, by default that of Servo [s]

  /// Passivity control and a budget need an account of the energy that the force delivers.
  bool observed() const noexcept { return passivity_control || std::isfinite(budget); }
};

/// What the renderer does, room by room; everything has a default that suits any device and hand.
struct RendererOptions {
  double servo_rate = 1000.0;                               ///< samples and forces per second [Hz]
  Rules rules = Rules::revised;                             ///< wang2006: as printed
  StiffnessCheck stiffness_check = StiffnessCheck::reject;  ///< what to do with one that the device cannot render
  NearestPointOptions nearest = {.method = NearestPointMethod::tracked};  ///< method and accuracy, against time
  double velocity_cutoff = 50.0;  ///< of the low-pass on the velocity that the dampers act on (VelocityEstimator) [Hz]
  /// Stiffness of a usual grip, about which people's vary: from it and the force at work follows where the hand means
  /// to be [N/m, device].
  double grip_stiffness = 300.0;
  PaperOptions paper;           ///< how the paper feels
  GuidanceOptions guidance;     ///< how the pen is led along the stroke
  ContactOptions contact;       ///< when the pen counts as on the paper, and at a character
  StrokeTolerances tolerances;  ///< which pen-down begins the stroke that is due, and when it is finished
  ForceLimits limits;           ///< of the force, its rate and the motors' heat
  EnergyOptions energy;         ///< passivity and the energy budget

  /// Every rule as printed, except the signs of eq. (8) and (9), which the available text may have lost: with the signs
  /// as printed nothing can be written (Rules::wang2006_signs). Widths and stiffnesses are the defaults. Without
  /// damping no stiffness is stable in every hand, so stiffness_check is off.
  static RendererOptions wang2006();

  /// The defaults at the device's update rate, with stiffnesses clipped to what is usable and stable on it, for any
  /// page: stiffness_check is clip. With a motion scale K_S (MotionMapping) they are the same as felt by the hand:
  /// stiffnesses and dampings on the page are divided by K_S^2, `guidance_limit` and `wrong_way_limit` by K_S. Force
  /// rates and energies are the device's at every scale.
  /// @throws ValueError unless the scale is above 0, or when it is so small that no page could be that stiff
  static RendererOptions for_device(const Capabilities& capabilities, double scale = 1.0);

  /// for_device() with the optional stages that serve every writer: guidance for large deviations and to the start; the
  /// friction of paper, less the device's own; an energy budget where the device states its mass and a delay of at most
  /// 15 ticks; a thermal budget where it states a continuous force below its peak. Not passivity control: the springs
  /// are damped already, and what it adds is drag. Not assistance as needed, which withdraws guidance by intent.
  static RendererOptions everything(const Capabilities& capabilities, double scale = 1.0);
};

/// Clips the stiffnesses to the device's usable stiffness, where it states one, and to what is stable in any hand on it
/// at the options' rate, damping and filter and the device's sample delay (stiffness_for_any_hand()); a damping that is
/// too strong for that lag is lowered too. A device of unknown mass is taken to weigh 20 g. The friction spring counts
/// in addition to guidance. With a motion scale K_S (MotionMapping) a stiffness counts K_S^2 times, which is what the
/// device renders, and so does a damping.
/// @return what was clipped, each with its reason
/// @throws ValueError naming the option when a stiffness or a damping is negative or not finite, or the rate or the
/// cut-off frequency is not above 0
std::vector<std::string> clip_stiffness(RendererOptions& options, const Capabilities& capabilities, double scale = 1.0);

/// Maximum stiffness of guidance that clip_stiffness() permits, attraction factor included [N/m].
double max_guidance_stiffness(const RendererOptions& options, const Capabilities& capabilities, double scale = 1.0);

/// @throws ValueError naming the option and its value: not finite, out of range, or a stiffness that clip_stiffness()
/// would clip
void validate(const RendererOptions& options, const Capabilities& capabilities, double scale = 1.0);

}  // namespace calligraphy
