// Random cases of guided hands that are disturbed, each beside its twin that feels no force.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <calligraphy/render/haptic_renderer.hpp>

#include "independent_hand.hpp"
#include "scene.hpp"

namespace calligraphy_test {

enum class Composition { for_device, everything, force_rates, stiffness, friction };
inline constexpr std::array composition_names = {"for_device", "everything", "force rates", "stiffness", "friction"};

enum class Disturbance {
  jog,       ///< the arm is elsewhere for 20 to 60 ms
  comeback,  ///< the arm moves away, waits, and comes back in 50 ms
  tap,       ///< the pen is lifted and hits the paper
  pull,      ///< a force of 0.1 to 0.5 s
  release,   ///< the hand opens
  push       ///< a short knock
};
inline constexpr std::array disturbance_names = {"jog", "comeback", "tap", "pull", "release", "push"};

/// All draws of one case. Lengths, directions and forces of the hand are those of the page.
struct SweepCase {
  std::uint64_t seed = 0;
  int index = 0;
  calligraphy::Capabilities device;      ///< with the rate, the delay and the friction drawn
  calligraphy::RendererOptions options;  ///< as requested
  std::string refusal;                   ///< what for_device() or everything() threw
  Composition composition = Composition::for_device;
  bool flat = false;  ///< a page on the desk, not upright
  VelocityGiven velocity = VelocityGiven::truth;
  int character = 0;        ///< of the built-in ones
  double attraction = 1.0;  ///< multiplies the attraction factors

  bool bare = false;     ///< no hand at all, but for the force that presses
  bool carried = false;  ///< a bare pen that a normal grip takes to its place, or else begins just above the paper
  GripImpedance grip;
  Point beside = Point::Zero();  ///< from the stroke's start to where the pen touches down [m]
  bool keeps_beside = false;     ///< follows the stroke at that distance, or else on the stroke
  double share = 0.0;            ///< of the stroke that is written; 0: stays at the start
  double writing_speed = 0.1;    ///< [m/s]
  double press = 0.0;            ///< [N], or 0: the hand intends to be in the paper by `depth`
  double depth = 0.0;            ///< [m]

  Disturbance disturbance = Disturbance::jog;
  Vector3d direction = Vector3d::Zero();
  double distance = 0.0;     ///< jog, comeback [m]
  double duration = 0.0;     ///< jog, pull, push [s]
  double strength = 0.0;     ///< pull, push [N]
  double hit_speed = 0.0;    ///< tap; of a bare pen that is jogged [m/s]
  bool keeps_press = false;  ///< release
};

struct SweepResult {
  bool refused = false;
  std::string refusal;
  double guidance_stiffness = 0.0, paper_stiffness = 0.0;  ///< in effect, with the highest attraction factor [N/m]
  bool began = false;                                      ///< the stroke had begun when the disturbance came
  double motion = 0.0;                                     ///< peak to peak in the window [m], largest of the axes
  double twin_motion = 0.0;                                ///< of the twin
  double motion_excess = 0.0;                              ///< of the motion beyond the twin's, of all axes [m]
  double speed = 0.0, twin_speed = 0.0;                    ///< highest in the window [m/s]
  double force = 0.0;                                      ///< peak to peak in the window [N], largest of the axes
  double forgiven_force = 0.0;  ///< the same beyond the stiffness times the twin's own motion [N]
  double peak_force = 0.0;      ///< of the whole run [N]
  double energy = 0.0;          ///< most net energy that the force had given the hand by any time [J]
  bool acted = false;           ///< the force in the window was ever other than zero
  bool fails_later = false;     ///< it fails, and from 5 to 6 s after the disturbance too: it does not just settle late

  static constexpr double most_motion = 0.5e-3;  ///< [m]
  static constexpr double most_force = 0.2;      ///< [N]

  /// Faster than the twin by far: a pen that swings in place may move less than a twin that coasts away, and yet be
  /// driven. Whatever the same disturbance left of a swing is not.
  bool driven() const { return acted && speed > 3.0 * twin_speed + 0.05; }
  /// By the letter: beyond the twin's motion, or a force that swings.
  bool fails_by_letter() const { return !refused && (motion_excess > most_motion || force > most_force || driven()); }
  /// A hand that still swings by itself may move the spring, and a pen that coasts without any force is not driven.
  bool fails() const {
    return !refused && ((acted && motion_excess > most_motion) || forgiven_force > most_force || driven());
  }
  bool clipped_soft() const { return !refused && (guidance_stiffness < 150.0 || paper_stiffness < 150.0); }
};

/// Case `index` of a seed; the other cases do not matter to it.
SweepCase draw_case(std::uint64_t seed, int index);

/// Guidance laws of which nothing is known, and how they behave: "stiff", 5,000 N/m towards the stroke; "along", 2 N
/// along it; "away", 600 N/m away from it; "undamped", 600 N/m towards it without a damper; "spring", a good one of 600
/// N/m. With ", stated" they state 600 N/m, whether that is true or not. Others: as drawn.
inline constexpr std::array strange_laws = {"spring",       "spring, stated", "undamped",      "undamped, stated",
                                            "stiff",        "stiff, stated",  "along",         "along, stated",
                                            "away",         "away, stated"};
/// @throws ValueError unless it is one of these
calligraphy::GuidanceFactory strange_law(const std::string& name);

/// One instant of a case, for a table [s, m and N in page axes].
struct SweepSample {
  double time;
  Vector3d pen, twin, force;
  calligraphy::InteractionState state;
};

/// Runs a case beside its twin. `watch`, if any, is told of every tick.
/// The window begins `settle_time` after the disturbance [s].
SweepResult run_case(const SweepCase& drawn, const std::function<void(const SweepSample&)>& watch = nullptr,
                     double settle_time = 1.5);

/// All draws on one line.
std::string describe(const SweepCase& drawn);
std::string describe(const SweepResult& result);

/// Cases 0 to `count` - 1 of a seed, in order.
/// `change`, if any, is made to each as drawn.
std::vector<SweepResult> run_sweep(std::uint64_t seed, int count, int threads,
                                   const std::function<void(double)>& progress = nullptr,
                                   const std::function<void(SweepCase&)>& change = nullptr);

}  // namespace calligraphy_test
