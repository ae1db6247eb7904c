// Stability maps: the wall stiffness up to which a virtual wall is stable, simulated and compared with theory.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <calligraphy/render/stiffness_advice.hpp>

namespace calligraphy {

/// The contact of the pen with the wall in a simulation. The pen is released at rest above the paper and pushed down by
/// a constant force; a grip, if any, pulls it towards the surface of the paper. The wall never pulls.
struct WallContact {
  double push = 1.0;        ///< constant force towards the wall, not limited by the device [N]
  double height = 0.00025;  ///< initial height of the pen; with 45 g alone it hits the wall at 0.1 m/s [m]
  double seconds = 12.0;    ///< duration, in virtual time [s]
  bool controlled = false;  ///< a PassivityController with injectable_damping() follows the wall
  double lost = 0.0;        ///< share of the samples that are lost: the last one is used again
  double reordered = 0.0;   ///< share of the samples that are swapped with the next one
};

/// The outcome of a simulated contact with the wall.
struct WallContactResult {
  /// The pen comes to rest: its peak-to-peak amplitude drops below 0.1 um, or decreases in each sixteenth of the second
  /// half of the time, by at least 5 % in total and at least 1 % in the last quarter.
  bool stable = false;
  double peak_to_peak = 0.0;  ///< amplitude in the last simulated sixteenth [m]
  double max_force = 0.0;     ///< maximum force sent [N]
  double last_force = 0.0;    ///< maximum force sent in the last simulated sixteenth [N]
};

/// Simulates one pen on a wall of this stiffness [N/m], in virtual time. The wall force is clipped at the peak force of
/// the device.
/// @throws ValueError naming the value when the loop, its device's peak force, the stiffness or the contact is
/// out of its domain
WallContactResult simulate_wall_contact(const SampledLoop& loop, double stiffness, const WallContact& contact = {});

/// The results for one loop at every stiffness of the map.
struct StabilityLine {
  SampledLoop loop;                        ///< its wall has every stiffness in turn
  double passive = 0.0;                    ///< StiffnessAdvice::passive [N/m]
  double quantised = 0.0;                  ///< StiffnessAdvice::quantised [N/m]
  double stable = 0.0;                     ///< StiffnessAdvice::stable [N/m]
  double approximate = 0.0;                ///< StiffnessAdvice::approximate [N/m]
  std::vector<bool> stable_at;             ///< per stiffness of the map, without the controller
  std::vector<bool> controlled_stable_at;  ///< likewise, with the controller
  /// Maximum stiffness below which every simulated one is stable, to 2 %; 0 if the lowest is unstable, the map's
  /// maximum if all are stable [N/m].
  double max_stable = 0.0;
  double controlled_max_stable = 0.0;             ///< likewise, with the controller [N/m]
  double controlled_max_stable_below_peak = 0.0;  ///< likewise, with the force below the peak [N/m]
};

/// Variation of one property of the loop, all others kept constant.
struct StabilitySweep {
  std::string name;                  ///< name of the property: "damping"
  std::string label;                 ///< the property with its unit, for people
  std::vector<std::string> values;   ///< values of the property, one per line
  std::vector<StabilityLine> lines;  ///< by increasing value
};

/// What a stability map simulates; its grid has every combination of the lists.
struct StabilityMapOptions {
  Capabilities device = point_mass();  ///< the properties that a sweep or the grid does not vary
  WallContact contact;                 ///< `controlled` is ignored: both are simulated
  int per_decade = 8;                  ///< number of stiffnesses per decade
  double min_stiffness = 10.0;         ///< lowest stiffness simulated [N/m]
  double max_stiffness = 1e5;          ///< highest stiffness simulated [N/m]
  double coulomb_friction = 0.06;      ///< friction of loops with quantised positions; the others have none [N]
  std::vector<double> dampings = {0.05, 0.1, 0.5, 2.0};     ///< viscous dampings in the grid [N s/m]
  std::vector<double> rates = {500.0, 1000.0, 4000.0};      ///< servo rates in the grid [Hz]
  std::vector<int> delays = {0, 1, 2, 5};                   ///< ages of a sample when it is read, in the grid [ticks]
  std::vector<double> encoder_steps = {0.0, 23e-6, 55e-6};  ///< encoder steps in the grid [m]
  std::vector<double> wall_dampings = {0.0, 1.0};           ///< dampings of the wall in the grid [N s/m]
  std::vector<GripImpedance> grips = {{0.0, 0.0, 0.0}, {0.1, 3.0, 300.0}};  ///< grips in the grid; all zero: no grip
  bool with_sweeps = true;                                                  ///< whether to vary one property at a time
  bool with_grid = true;                                                    ///< whether to simulate the grid
  std::function<void(double)> progress = nullptr;  ///< called from time to time with the share completed

  /// 45 g, 0.1 N s/m, the Desktop's peak force of 7.9 N; no Coulomb friction, quantisation or delay.
  static Capabilities point_mass();
};

/// Simulated stable stiffnesses, next to the bounds of theory.
struct StabilityMap {
  Capabilities device;                 ///< as in the options
  WallContact contact;                 ///< as in the options
  std::vector<double> stiffnesses;     ///< simulated for every line [N/m]
  std::vector<StabilitySweep> sweeps;  ///< variations of the device, free (no grip) and at 1 kHz
  std::vector<StabilityLine> grid;     ///< every combination of the options' lists
};

/// Computes the map on all cores. The result is the same in every run.
/// @throws ValueError naming the value when an option is out of its domain
StabilityMap stability_map(const StabilityMapOptions& options = {});

/// SVG plot by gnuplot: for each sweep, the stable stiffnesses without and with the controller, and the theoretical
/// bounds.
/// @throws ValueError when there is no sweep, Error with gnuplot's message when it cannot be started or fails
std::string stability_map_plot(const StabilityMap& map);

}  // namespace calligraphy
