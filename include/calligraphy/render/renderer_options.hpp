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
#include <calligraphy/render/guidance_law.hpp>
#include <calligraphy/render/paper_friction.hpp>
#include <calligraphy/render/stroke_tolerances.hpp>

namespace calligraphy {

/// What to do with a stiffness above what is usable or stable on the device.
enum class StiffnessCheck {
  reject,  ///< the constructor throws a ValueError
  clip,    ///< use the maximum permitted value; HapticRenderer::clipped() gives the reasons
  off      ///< accept it, up to 1e6 N/m: for experiments on simulated devices that look for the limit itself
};

/// How the paper feels: the force along its normal, and friction along it. It presses back only at the character being
/// written: Table 2 has no normal force beside it, in the adjusting state.
struct PaperOptions {
  double stiffness = 600.0;  ///< stiffness of its surface, K_en of eq. (9): force per depth of the pen below it [N/m]
  double damping = 4.0;      ///< damping of motion along the normal while the pen is below the surface [N s/m]
  double onset = 0.0005;     ///< depth over which stiffness and damping rise from zero, so that contact is gradual [m]
  FrictionOptions friction;  ///< between pen and paper, along the surface; off by default
};

/// How the pen is led along the stroke that is due: the force in the paper plane.
struct GuidanceOptions {
  /// Stiffness of the spring to the stroke's nearest point, K_et of eq. (8), where the attraction factor is 1 [N/m].
  double stiffness = 600.0;
  /// Damping of motion across the stroke, where that spring acts; elsewhere on the paper 15 % of it damps motion in any
  /// direction [N s/m].
  double damping = 4.0;
  GuidanceFactory force;  ///< how the force depends on where the pen is: linear_guidance, or a law of your own
  double limit = 2.0;     ///< maximum force of the spring of saturating_guidance, which levels off towards it [N]
  /// Before a stroke is begun, pull the pen to within half of StrokeTolerances::start_distance of its start, if the pen
  /// was put down nearer to it than to the start of any later stroke, and not on the stroke. False: guide only near the
  /// start, and only across the stroke.
  bool to_start = false;
  ConstraintSpace space;  ///< how far from the stroke guidance acts, with a law that lets go
  double fade_in = 0.15;  ///< time over which it rises from zero: at contact, as a stroke begins, at feature points [s]
  double fade_out = 0.3;  ///< time over which it is withdrawn when it lets go, so that a pulling hand is not thrown [s]
  double wrong_way_stiffness = 200.0;  ///< of a spring that resists writing backwards (Fig. 4); 0: none [N/m]
  double wrong_way_limit = 1.0;        ///< maximum force of that spring [N]
  double wrong_way_slack = 0.05;       ///< length by which the pen may be behind its furthest point before it acts [em]
  AssistPolicy assist;                 ///< lets guidance fade as the writer improves; off by default
};

/// When the pen counts as on the paper, and as at a character.
struct ContactOptions {
  double lift_time = 0.05;           ///< a pen above the paper counts as lifted after this time: it may be bouncing [s]
  double lift_clearance = 0.003;     ///< a pen this far above the paper counts as lifted at once [m]
  bool lift_between_strokes = true;  ///< a stroke begins only with a new contact, not by sliding on from the last one
  double box_margin = 0.2;  ///< margin around the character of the box in which it can be written [em]
};

/// Bounds on the force on its way to the device, and on the motion that is believed.
struct ForceLimits {
  /// Maximum rate of change of the force in the paper plane, wherever it would jump: as guidance sets in or lets go, at
  /// faults. Changes of its springs and dampers due to the pen's motion follow without lag. Infinite: no limit [N/s].
  double in_plane_rate = 100.0;
  double normal_rate = 400.0;  ///< likewise, for the force along the normal [N/s]
  /// Time constant of the motors: as they warm, the permitted force falls from twice the device's continuous force to
  /// that force. 0: always the peak force [s].
  double thermal_time_constant = 0.0;
  double max_speed = 5.0;  ///< a sample that implies a faster pen is a fault of the device, not a motion [m/s, device]
  /// Likewise, a sample farther off the course of the last ones than this acceleration and five encoder steps (at least
  /// 0.15 mm) allow. Samples that agree with one another are believed again. Infinite: no limit [m/s^2, device].
  double max_acceleration = 100.0;
  /// A sensor is dead if its position stays the same to the last bit for longer than this, after the force has changed
  /// by more than any hand and the friction of the device can withstand. Optional, since a clamped pen is just as
  /// still. Infinite: permitted for ever [s].
  double max_standstill = std::numeric_limits<double>::infinity();
};

/// How much energy the force may give the hand.
struct EnergyOptions {
  /// Maximum net energy given since the start; near it the force is reduced. Infinite: no limit [J].
  double budget = std::numeric_limits<double>::infinity();
  /// With a budget: longest time without a fresh sample for which it must hold, at most 0.1; the default is that of
  /// Servo [s].
  double max_gap = 0.016;

  /// Whether there is a budget, and so whether energy is accounted for.
  bool limited() const noexcept { return std::isfinite(budget); }
};

/// How the renderer works, in groups: how the paper feels, how the pen is led, what counts as contact and as writing
/// the stroke, and what bounds the force. The defaults suit any hand; for_device() fits them to a device.
struct RendererOptions {
  /// Ticks per second, at least 10; 0: the device's own rate (Capabilities::update_rate) [Hz].
  double servo_rate = 0.0;
  Rules rules = Rules::revised;  ///< the rules of the paper, revised or as printed
  StiffnessCheck stiffness_check = StiffnessCheck::reject;  ///< what to do with a spring too stiff for the device
  /// How the nearest point of the stroke is found, and how exactly: time against accuracy (docs/nearest-point.md).
  NearestPointOptions nearest = {.method = NearestPointMethod::tracked};
  /// Cut-off frequency of the low-pass on the pen's velocity, which all dampers act on (VelocityEstimator), at least 5
  /// [Hz].
  double velocity_cutoff = 50.0;
  /// Stiffness of a usual grip: how far a hand yields to the force, and so where it would be without it [N/m, device].
  double grip_stiffness = 300.0;
  PaperOptions paper;           ///< how the paper feels
  GuidanceOptions guidance;     ///< how the pen is led along the stroke
  ContactOptions contact;       ///< when the pen counts as on the paper, and at a character
  StrokeTolerances tolerances;  ///< which pen-down begins the stroke that is due, and when it is finished
  ForceLimits limits;           ///< limits on the rate of the force, the motors' heat and the pen's motion
  EnergyOptions energy;         ///< how much energy the force may give the hand

  /// Every rule as printed, with printed_guidance, except the signs of eq. (8) and (9), which the available text may
  /// have lost: with the signs as printed nothing can be written (docs/wang2006.md). Widths and stiffnesses are the
  /// defaults. Without damping no stiffness is stable in every hand, so stiffness_check is off.
  static RendererOptions wang2006();

  /// The defaults, with stiffnesses clipped to what is usable and stable on the device, for any page: stiffness_check
  /// is clip. With a motion scale K_S (MotionMapping) they feel the same to the hand: stiffnesses and dampings on the
  /// page are divided by K_S^2, the limits in `guidance` by K_S. Force rates and energies are those of the device at
  /// every scale.
  /// @throws ValueError unless the scale is above 0, or when it is so small that no page could be that stiff
  static RendererOptions for_device(const Capabilities& capabilities, double scale = 1.0);

  /// for_device() with the optional stages that serve every writer: guidance for large deviations and to the start; the
  /// friction of paper, less the device's own; an energy budget where the device states its mass and a delay of at most
  /// 15 ticks; a thermal budget where it states a continuous force below its peak; a max_standstill of 0.5 s on a real
  /// device. Assistance as needed stays off, since it withdraws guidance on purpose.
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

/// @throws ValueError naming the option, its value and, where it is not obvious, the reason: not finite, out of range,
/// or a stiffness that clip_stiffness() would clip
void validate(const RendererOptions& options, const Capabilities& capabilities, double scale = 1.0);

}  // namespace calligraphy
