// Pens that the guidance lets go of, each beside its twin that it does not let go of.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <calligraphy/render/haptic_renderer.hpp>

#include "independent_hand.hpp"

namespace calligraphy_test {

inline constexpr double release_window = 0.2;    ///< [s]
inline constexpr double tolerated_speed = 0.15;  ///< of the released pen beyond its twin [m/s]

enum class Strain {
  finish,  ///< writes to the end and beyond, ever further aside
  pull,    ///< on the way, pulls aside until far out of the tube
  lift,    ///< on the way, lifts the strained pen
  open,    ///< on the way, lets go of the strained pen, which something light presses down
  coast    ///< lets go of the pen shortly before the end, while it moves
};
inline constexpr std::array strain_names = {"finish", "pull", "lift", "open", "coast"};

enum class Release {
  finished,   ///< stroke_finished
  abandoned,  ///< stroke_abandoned, the pen still on the paper
  lifted,     ///< from a strained state
  weakened    ///< the weight fell below 0.95 while writing
};
inline constexpr std::array release_names = {"finished", "abandoned", "lifted", "weakened"};

/// All draws of one case. The hand's intention moves at no more than 0.1 m/s in the plane, so that what the pen gains
/// beyond its twin is the guidance's doing, not the hand's.
struct ReleaseCase {
  std::uint64_t seed = 0;
  int index = 0;
  calligraphy::Capabilities device;
  bool everything = false;  ///< or else RendererOptions::for_device()
  int character = 0;        ///< of the built-in ones
  int stroke = 0;           ///< it is made the first, and only, stroke of its character
  double em = 0.04;         ///< [m]
  GripImpedance grip;
  Strain strain = Strain::finish;
  double aside = 0.0;  ///< how far the hand means to be aside; to the left if above 0 [m]
  double share = 0.0;  ///< of the stroke, where it happens
  double speed = 0.0;  ///< along the stroke, and aside while pulling [m/s]
  double press = 0.0;  ///< of a pen that was let go [N]
};

struct ReleaseEvent {
  Release kind = Release::finished;
  double time = 0.0;       ///< [s]
  double force = 0.0;      ///< of the guidance just before [N]
  double excess = 0.0;     ///< largest speed of the pen in the plane beyond its twin's at the same time [m/s]
  double excess_at = 0.0;  ///< after the release [s]

  bool fails() const { return excess > tolerated_speed; }
};

/// What a replayed case shows, tick by tick.
struct ReleaseSample {
  double time;
  calligraphy::HapticTick tick;
  Vector3d pen, velocity, intended;  ///< page
  double twin_speed;                 ///< of the newest twin, or NaN [m/s]
};

ReleaseCase draw_release(std::uint64_t seed, int index);
std::vector<ReleaseEvent> run_release(const ReleaseCase& drawn,
                                      const std::function<void(const ReleaseSample&)>& watch = nullptr);
std::vector<std::vector<ReleaseEvent>> run_releases(std::uint64_t seed, int count, int threads,
                                                    const std::function<void(double)>& progress = nullptr);
std::string describe(const ReleaseCase& drawn);

}  // namespace calligraphy_test
