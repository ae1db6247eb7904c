// Where a virtual wall is stable, by simulation, beside what theory says.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <calligraphy/render/stiffness_advice.hpp>

namespace calligraphy {

/// How the pen meets the wall in a simulation. It is let go above the paper, at rest, and a steady force pushes it
/// down; a grip, if any, holds it towards the paper's surface. The wall never pulls.
struct WallEncounter {
  double push = 1.0;        ///< steady force towards the wall, not limited by the device [N]
  double height = 0.00025;  ///< from which the pen falls [m]: with 45 g alone it meets the wall at 0.1 m/s
  double seconds = 12.0;    ///< of virtual time
  bool controlled = false;  ///< a PassivityController at its usable damping follows the wall
  double lost = 0.0;        ///< share of the samples that do not arrive: the last one is used again
  double reordered = 0.0;   ///< share of the samples that change places with the next one
};

struct WallOutcome {
  /// The pen comes to rest: its swing from peak to peak falls below 0.1 um, or becomes smaller in each sixteenth of the
  /// second half of the time, by 5 % or more in all and by 1 % or more in the last quarter.
  bool settles = false;
  double swing = 0.0;          ///< from peak to peak, in the last sixteenth that was simulated [m]
  double largest_force = 0.0;  ///< sent [N]
  double last_force = 0.0;     ///< largest sent in the last sixteenth that was simulated [N]
};

/// One pen on one wall of this stiffness [N/m], in virtual time. The wall's force is cut off at the device's peak.
/// @throws ValueError naming the value when the loop, its device's peak force, the stiffness or the encounter is
/// out of its domain
WallOutcome meet_wall(const SampledLoop& loop, double stiffness, const WallEncounter& encounter = {});

/// Every stiffness against one loop.
struct StabilityLine {
  SampledLoop loop;
  double passive = 0.0, quantised = 0.0, stable = 0.0, approximate = 0.0;  ///< the bounds of advise_stiffness() [N/m]
  std::vector<bool> settles;             ///< for each stiffness of the map, the controller off
  std::vector<bool> controlled_settles;  ///< the same, on
  /// Largest below which no stiffness that was tried is unstable, to 2 % [N/m]; 0 if the softest is not, the map's
  /// largest if all are.
  double largest = 0.0, controlled_largest = 0.0;
  double controlled_within_peak = 0.0;  ///< likewise, where moreover the force never comes to the device's peak [N/m]
};

/// One property of the loop varied, all others kept.
struct StabilitySweep {
  std::string name;                 ///< "damping"
  std::string label;                ///< with its unit, for people
  std::vector<std::string> values;  ///< one per line
  std::vector<StabilityLine> lines;
};

struct StabilityMapOptions {
  Capabilities device = point_mass();
  WallEncounter encounter;         ///< `controlled` does not count: both are tried
  int per_decade = 8;              ///< stiffnesses that are tried
  double softest = 10.0;           ///< [N/m]
  double stiffest = 1e5;           ///< [N/m]
  double coulomb_friction = 0.06;  ///< of the loops whose positions are rounded; the others have none [N]
  std::vector<double> dampings = {0.05, 0.1, 0.5, 2.0};     ///< of the grid [N s/m]
  std::vector<double> rates = {500.0, 1000.0, 4000.0};      ///< [Hz]
  std::vector<int> delays = {0, 1, 2, 5};                   ///< [ticks]
  std::vector<double> encoder_steps = {0.0, 23e-6, 55e-6};  ///< [m]
  std::vector<double> wall_dampings = {0.0, 1.0};           ///< [N s/m]
  std::vector<Hand> grips = {{0.0, 0.0, 0.0}, {0.1, 3.0, 300.0}};
  bool with_sweeps = true, with_grid = true;       ///< what to try
  std::function<void(double)> progress = nullptr;  ///< called now and then with the share that is done

  /// 45 g, 0.1 N s/m, the Desktop's peak of 7.9 N; no dry friction, rounding or delay.
  static Capabilities point_mass();
};

struct StabilityMap {
  Capabilities device;
  WallEncounter encounter;
  std::vector<double> stiffnesses;     ///< that every line was tried at [N/m]
  std::vector<StabilitySweep> sweeps;  ///< one property of the device, held by nobody at 1 kHz, varied
  std::vector<StabilityLine> grid;     ///< every combination of the options' lists
};

/// The map, on every core. The same in every run.
/// @throws ValueError naming the value when an option is out of its domain
StabilityMap stability_map(const StabilityMapOptions& options = {});

/// SVG by gnuplot: for each sweep, where the pen settles without and with the controller, and the bounds of theory.
/// @throws ValueError when there is no sweep, Error with gnuplot's message when it cannot be started or fails
std::string stability_map_plot(const StabilityMap& map);

}  // namespace calligraphy
