// Trade-offs of accuracy against cost: the nearest-point method, the servo rate, the width of stored coordinates.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// A nearest-point method with its settings.
struct NearestPointSetting {
  std::string name;             ///< "exact 1e-09", "sampled 16 x 2"
  NearestPointOptions options;  ///< method and settings
};

/// All methods, each at settings from fast to accurate.
std::vector<NearestPointSetting> nearest_point_settings();

/// Cost and accuracy of a method. Errors are those of the distance compared with `exact` at 1e-12, relative to the size
/// of the curve (the diagonal of the bounding box of its control points).
struct NearestPointCost {
  std::string queries;       ///< name of the queries
  double ns = 0.0;           ///< per query, median over the rounds
  double ns_p90 = 0.0;       ///< per query, 90th percentile of the rounds
  double batch_ns = 0.0;     ///< per query, with all queries to a curve in one call, median
  double error = 0.0;        ///< median [1]
  double error_p99 = 0.0;    ///< 99th percentile [1]
  double error_worst = 0.0;  ///< maximum [1]
  double wrong = 0.0;        ///< share of wrong branches: error above 1e-3
};

/// What the user feels when moving a pen along curves, with the force K (closest - tip).
struct PenFeel {
  double max_step = 0.0;  ///< maximum change of the force per tick, including that due to the pen's own motion [N]
  double wrong = 0.0;     ///< share of the ticks on a wrong branch
};

/// Cost and accuracy of one method at one setting.
struct NearestPointTradeoff {
  NearestPointSetting setting;  ///< method and settings
  NearestPointCost real;        ///< all workloads on real strokes together; times are means over the workloads
  NearestPointCost hard;        ///< all other workloads together, likewise
  std::vector<NearestPointCost> workloads;  ///< each workload separately, see nearest_point_workload.hpp
  /// Tracking a pen along whole strokes: each tick queries every element, or a StrokeTracker if the method is
  /// `tracked`. No batches.
  NearestPointCost ticks;
  PenFeel strokes;  ///< along every curve of the characters, deviating by up to 3 mm
  PenFeel arcs;     ///< along gentle arcs of 15 to 40 mm radius, at a constant distance of 1 to 4 mm
};

/// How nearest_point_tradeoff() measures.
struct NearestPointTradeoffOptions {
  int queries = 4000;                              ///< per workload (there are 19)
  int rounds = 21;                                 ///< each round runs every method on every workload
  std::uint64_t seed = 1;                          ///< seed of the random queries and curves
  double stiffness = 1000.0;                       ///< K [N/m]
  double speed = 0.05;                             ///< speed of the pen [m/s]
  double rate = 1000.0;                            ///< ticks per second [Hz]
  std::function<void(double)> progress = nullptr;  ///< called from time to time with the share completed
};

/// One entry per setting. Everything except the times is the same in every run.
/// @throws ValueError when the characters have no cubic curve or an option is not positive
std::vector<NearestPointTradeoff> nearest_point_tradeoff(std::span<const Character> characters,
                                                         const NearestPointTradeoffOptions& options = {});

/// A simulated novice writing in closed loop at one servo rate.
struct ServoRateTradeoff {
  double rate = 0.0;  ///< rate of the servo loop [Hz]

  double stiffness = 0.0;    ///< default paper stiffness at this rate [N/m]
  bool stable = false;       ///< a pen pressed onto this paper comes to rest
  double penetration = 0.0;  ///< maximum, while the paper is solid [m]
  double path_error = 0.0;   ///< RMS of the lateral error [m]
  double force_step = 0.0;   ///< maximum change of the force per tick [N]
  double written = 0.0;      ///< share of the strokes completed

  double loop_stiffness = 0.0;       ///< maximum paper stiffness at which a pressed pen comes to rest [N/m]
  double unlimited_stiffness = 0.0;  ///< likewise, without a limit on the rate of the normal force [N/m]
  double held_stiffness = 0.0;       ///< critical_stiffness() in the writer's hand [N/m]
  double free_stiffness = 0.0;       ///< critical_stiffness() of the device released [N/m]

  double hard_stiffness = 0.0;    ///< half of unlimited_stiffness: usable at this rate [N/m]
  double hard_penetration = 0.0;  ///< penetration into such paper [m]
  double hard_force_step = 0.0;   ///< force step on such paper [N]
};

/// How servo_rate_tradeoff() measures.
struct ServoRateTradeoffOptions {
  std::vector<double> rates = {250.0, 500.0, 1000.0, 2000.0, 4000.0, 10000.0, 20000.0};  ///< servo rates [Hz]
  int seeds = 3;                   ///< how many times each character is written
  std::uint64_t seed = 1;          ///< for the first writing of a character; each further one uses the next seed
  std::string device = "desktop";  ///< name of a device profile
  std::function<void(double)> progress = nullptr;  ///< called from time to time with the share completed
};

/// One entry per rate. The result is the same in every run.
/// @throws ValueError when there is no character or an option is out of its domain
std::vector<ServoRateTradeoff> servo_rate_tradeoff(std::span<const Character> characters,
                                                   const ServoRateTradeoffOptions& options = {});

/// Control points rounded to a grid of 2^bits positions along each edge of the em square.
struct CoordinateWidthTradeoff {
  int bits = 0;            ///< bits of a stored coordinate
  double step = 0.0;       ///< step of the grid [em]
  double max_error = 0.0;  ///< maximum distance between the original and the stored strokes, in both directions [em]
  double rms_error = 0.0;  ///< RMS over their length, in both directions [em]
  double bytes = 0.0;      ///< per character: packed coordinates, and one byte per stroke for its ID
};

/// The character with its control points rounded to the grid; points outside the em square are clamped to its edge.
/// @throws ValueError when bits is not in [1, 32]
Character with_coordinate_width(const Character& character, int bits);

/// One entry per width from 4 to 16 bits. The result is the same in every run. `progress` is called from time to time
/// with the share completed.
/// @throws ValueError when there is no character
std::vector<CoordinateWidthTradeoff> coordinate_width_tradeoff(std::span<const Character> characters,
                                                               const std::function<void(double)>& progress = {});

/// SVG plot by gnuplot, log-log: cost against maximum error of every method and setting, on real strokes and on the
/// hard workloads.
/// @throws ValueError when there are no entries, Error with gnuplot's message when it cannot be started or fails
std::string nearest_point_tradeoff_plot(std::span<const NearestPointTradeoff> tradeoff);
/// SVG plot by gnuplot, log-log: penetration, path error, force step and stability over the servo rate. @throws as
/// above
std::string servo_rate_tradeoff_plot(std::span<const ServoRateTradeoff> tradeoff);
/// SVG plot by gnuplot, log-log: error and bytes over the width. @throws as above
std::string coordinate_width_tradeoff_plot(std::span<const CoordinateWidthTradeoff> tradeoff);

}  // namespace calligraphy
