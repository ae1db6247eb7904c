// What accuracy costs: the method of the nearest point, the servo rate, the width of stored coordinates.
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

/// "exact", "tracked", "sampled", "wang2006".
const char* method_name(NearestPointMethod method) noexcept;

/// A method of the nearest point with its settings.
struct NearestPointSetting {
  std::string name;  ///< "exact 1e-09", "sampled 16 x 2"
  NearestPointOptions options;
};

/// Every method, each at the settings from fast to accurate.
std::vector<NearestPointSetting> nearest_point_settings();

/// What a method costs and how right it is. Errors are of the distance, against `exact` at 1e-12, in sizes of the curve
/// (diagonals of its control points' box).
struct NearestPointCost {
  std::string queries;    ///< which ones
  double ns = 0.0;        ///< per query, median over the rounds
  double ns_p90 = 0.0;    ///< 90 % of the rounds took at most this per query
  double batch_ns = 0.0;  ///< per query, all queries to a curve in one call, median
  double error = 0.0;     ///< median
  double error_p99 = 0.0;
  double error_worst = 0.0;
  double wrong = 0.0;  ///< share of wrong branches: error above 1e-3
};

/// What the hand feels when a pen is drawn along curves, with the force K (foot - tip).
struct PenFeel {
  double largest_step = 0.0;  ///< change of the force from one tick to the next; the pen's own motion is a part [N]
  double wrong = 0.0;         ///< share of the ticks on a wrong branch
};

struct NearestPointTrade {
  NearestPointSetting setting;
  NearestPointCost real;                    ///< the workloads on real strokes together; times are the means of theirs
  NearestPointCost hard;                    ///< all others together, likewise
  std::vector<NearestPointCost> workloads;  ///< each by itself, see nearest_point_workload.hpp
  /// Following a pen along whole strokes: at each tick every element is asked, or a StrokeTracker where the method is
  /// `tracked`. No batches.
  NearestPointCost ticks;
  PenFeel strokes;  ///< along every curve of the characters, straying by up to 3 mm
  PenFeel arcs;     ///< along gentle arcs, 15 to 40 mm in radius, steadily 1 to 4 mm beside them
};

struct NearestPointTradeOptions {
  int queries = 4000;  ///< of each of the 19 workloads
  int rounds = 21;     ///< in each of them every method has its turn on every workload
  std::uint64_t seed = 1;
  double stiffness = 1000.0;                       ///< K [N/m]
  double speed = 0.05;                             ///< of the pen [m/s]
  double rate = 1000.0;                            ///< ticks per second [Hz]
  std::function<void(double)> progress = nullptr;  ///< called now and then with the share that is done
};

/// One entry per setting. All but the times is the same in every run.
/// @throws ValueError when the characters have no cubic curve or an option is not positive
std::vector<NearestPointTrade> nearest_point_trade(std::span<const Character> characters,
                                                   const NearestPointTradeOptions& options = {});

/// A simulated novice writes in closed loop at one servo rate.
struct ServoRateTrade {
  double rate = 0.0;  ///< [Hz]

  double stiffness = 0.0;    ///< of the paper, the default [N/m]
  bool stable = false;       ///< a pen that is pressed on this paper comes to rest
  double penetration = 0.0;  ///< largest, while the paper is solid [m]
  double path_error = 0.0;   ///< RMS, lateral [m]
  double force_step = 0.0;   ///< largest, from one tick to the next [N]
  double written = 0.0;      ///< share of the strokes that were completed

  double loop_stiffness = 0.0;       ///< largest of the paper at which a pressed pen comes to rest [N/m]
  double unlimited_stiffness = 0.0;  ///< the same with no limit on the rate of the normal force [N/m]
  double held_stiffness = 0.0;       ///< critical_stiffness() in the writer's hand [N/m]
  double free_stiffness = 0.0;       ///< critical_stiffness() of the device let go [N/m]

  double hard_stiffness = 0.0;    ///< half of unlimited_stiffness: what this rate can afford [N/m]
  double hard_penetration = 0.0;  ///< on such paper [m]
  double hard_force_step = 0.0;   ///< on such paper [N]
};

struct ServoRateTradeOptions {
  std::vector<double> rates = {250.0, 500.0, 1000.0, 2000.0, 4000.0, 10000.0, 20000.0};  ///< [Hz]
  int seeds = 3;  ///< each character is written so often
  std::uint64_t seed = 1;
  std::string device = "desktop";                  ///< name of a profile
  std::function<void(double)> progress = nullptr;  ///< called now and then with the share that is done
};

/// One entry per rate. The same in every run.
/// @throws ValueError when there is no character or an option is out of its domain
std::vector<ServoRateTrade> servo_rate_trade(std::span<const Character> characters,
                                             const ServoRateTradeOptions& options = {});

/// Control points rounded to a grid of 2^bits places along each edge of the em square.
struct CoordinateWidthTrade {
  int bits = 0;                ///< per coordinate
  double step = 0.0;           ///< of the grid [em]
  double largest_error = 0.0;  ///< distance between the strokes as they are and as stored, both ways [em]
  double rms_error = 0.0;      ///< over their length, both ways [em]
  double bytes = 0.0;          ///< per character: coordinates packed, and a byte per stroke for its id
};

/// The character with its control points on the grid; those outside the em square go to its edge.
/// @throws ValueError when bits are not in [1, 32]
Character with_coordinate_width(const Character& character, int bits);

/// One entry per width from 4 to 16 bits. The same in every run. `progress` is called now and then with the share that
/// is done.
/// @throws ValueError when there is no character
std::vector<CoordinateWidthTrade> coordinate_width_trade(std::span<const Character> characters,
                                                         const std::function<void(double)>& progress = {});

/// SVG by gnuplot, log-log: cost against largest error of every method and setting, on real strokes and on the hard
/// workloads; penetration, path error, force step and stability over the servo rate; error and bytes over the width.
/// @throws ValueError when there are no entries, Error with gnuplot's message when it cannot be started or fails
std::string nearest_point_trade_plot(std::span<const NearestPointTrade> trade);
std::string servo_rate_trade_plot(std::span<const ServoRateTrade> trade);
std::string coordinate_width_trade_plot(std::span<const CoordinateWidthTrade> trade);

}  // namespace calligraphy
