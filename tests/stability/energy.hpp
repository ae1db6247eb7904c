// Runs that account the energy which the guidance gives to a hand, by the work of the force really at work.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <calligraphy/devices/capabilities.hpp>

namespace calligraphy_test {

/// Hands that try to get energy out of the guidance. Above 2 m/s none does positive work on the pen itself.
enum class EnergyHand {
  bare,              ///< nobody: a force that presses, and knocks towards the stroke's start
  soft,              ///< (0.05, 1, 100) writes and is jogged
  normal,            ///< (0.1, 3, 300)
  firm,              ///< (0.15, 5, 500)
  light,             ///< (0.02, 0.3, 30)
  negative_damping,  ///< pushes the pen along its velocity, 3 N s/m
  square_waves,      ///< 0.5 to 4 N in random directions, for 5 to 100 ms each
  hold_and_release,  ///< holds the pen beside the stroke and lets go, in gaps above all
  resonance,         ///< 0.5 to 2 N, always with the velocity: drives any oscillation
  pushes,            ///< a normal grip that is hit with 10 N for 10 to 50 ms
  greedy,            ///< goes where the force pulls, at 1.5 m/s, and comes back slowly
  shaking            ///< shakes the pen at up to 0.5 m/s, so fast that a damper behind the loop's delay pushes
};
inline constexpr std::array energy_hand_names = {
    "bare",      "soft",   "normal", "firm", "light", "negative damping", "square waves", "hold and release",
    "resonance", "pushes", "greedy", "shaking"};

enum class Timing {
  perfect,
  jitter,          ///< periods of 0.5 to 1.5 ticks
  gaps,            ///< of 2 to `longest_gap` ticks, in which the device goes on sampling
  stale_and_lost,  ///< the last sample again, and samples without a position, for 1 to 4 ticks
  everything,      ///< all of them
  idle_watchdog,   ///< gaps, half of them in the force law, and a watchdog that is called only while one lasts
  starved_watchdog  ///< the same gaps, and a watchdog that is not called for up to 40 ticks at a time
};
inline constexpr std::array timing_names = {"perfect",    "jitter",        "gaps",            "stale and lost",
                                            "all faults", "idle watchdog", "starved watchdog"};

/// Whether the timing concerns only a Servo.
inline bool needs_servo(Timing timing) { return timing >= Timing::idle_watchdog; }

struct EnergyRun {
  calligraphy::Capabilities device;
  EnergyHand hand = EnergyHand::normal;
  Timing timing = Timing::perfect;
  bool servo = false;  ///< behind a Servo with its watchdog, or the renderer alone; for every timing that needs_servo()
  std::int64_t ticks = 100000;
  int shortest_gap = 2, longest_gap = 20;  ///< [ticks]
  double gap_share = 0.05;  ///< of the ticks that begin with a gap, at most; for half a second it may be a twentieth;
                            ///< a fifth of that where the watchdog is late
  double budget = 0.1;      ///< [J]
  std::uint64_t seed = 1;
};

struct EnergyResult {
  std::string refusal;      ///< of the renderer
  double most_given = 0.0;  ///< maximum over time of the net energy given [J]
  /// The same beyond the budget and what gaps longer than `max_gap` allow: the sum of F v t in such a gap, until it is
  /// repaid [J].
  double most_excess = -1.0;
  double most_rise = 0.0;     ///< above the least ever given: what was returned before earns no credit [J]
  double most_claimed = 0.0;  ///< by the renderer's own account [J]
  double given_at_end = 0.0;  ///< [J]
  double peak_force = 0.0;    ///< [N]
  double mean_force = 0.0;    ///< over the ticks in the writing state [N]
  std::int64_t writing = 0;   ///< ticks in the writing state
  int strokes = 0;            ///< finished

  bool over() const { return !refusal.empty() || most_excess > 0.0; }
};

/// RendererOptions::everything() with the budget of the run.
EnergyResult run_energy(const EnergyRun& run);

}  // namespace calligraphy_test
