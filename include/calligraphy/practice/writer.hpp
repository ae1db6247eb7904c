// A simulated person who writes: plans each stroke as they believe it to be, sees their error late, corrects it, and
// slows when it is large.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/practice/page.hpp>

namespace calligraphy {

/// How well a person writes. Lengths in em are relative to the character's square. Spreads are standard deviations, drawn
/// anew for each character, stroke or attempt.
struct WriterSkill {
  Hand hand;                 ///< impedance between the plan and the device
  double offset = 0.0;       ///< of the believed character [em]
  double scale = 0.0;        ///< of the believed character [1]
  double tilt = 0.0;         ///< of the believed character [rad]
  double shape = 0.0;        ///< of each stroke's believed place within the character [em]
  double drift = 0.0;        ///< slow wandering off the plan while writing, per square root of a second [em/s^0.5]
  double tremor = 0.0;       ///< amplitude of an 8 to 12 Hz tremor [m]
  double aim = 0.0;          ///< of where a stroke is begun [em]
  double wrong_order = 0.0;      ///< share of strokes begun with another one [1]
  double wrong_direction = 0.0;  ///< share of strokes begun at their end [1]
  double speed = 0.8;        ///< mean speed along a stroke when nothing is wrong [em/s]
  double pause = 0.25;       ///< before the pen moves to a stroke [s]
  double sight_delay = 0.18; ///< age of what is seen [s]
  double correction = 2.0;   ///< share of the error seen that is corrected per second [1/s]
  double caution = 0.03;     ///< error seen at which the pace is halved [em]

  static WriterSkill novice();
  static WriterSkill skilled();
};

/// What the display shows: nothing of forces, nothing of the mode.
struct Sight {
  Eigen::Vector3d pen_tip = Eigen::Vector3d::Zero();  ///< page [m]
  int character = 0;     ///< the yellow one
  int stroke = 0;        ///< the one whose start has the red ellipse
  bool writing = false;  ///< a green trace grows from the pen
};

/// Moves a hand through the strokes of a page. Deterministic per seed: the beliefs and mistakes of a stroke depend on the
/// seed, the character, the stroke and the attempt alone, not on what happened before.
class SimulatedWriter {
 public:
  /// @throws ValueError when a number of the skill is out of its domain
  SimulatedWriter(const Page& page, const WriterSkill& skill, std::uint64_t seed);

  /// Lets `seconds` pass and says where the pen is meant to be now, on the page.
  Intention update(const Sight& sight, double seconds);

  /// How often the pen was put down.
  int attempts() const noexcept { return attempts_; }
  /// Gave up: the same stroke failed too often.
  bool gave_up() const noexcept { return gave_up_; }
  bool done() const noexcept { return phase_ == Phase::done; }
 private:
  enum class Phase { pause, approach, lower, write, settle, raise, done };
  // (see src/practice/writer.cpp)
  Phase phase_ = Phase::pause;
  int attempts_ = 0;
  bool gave_up_ = false;
};

}  // namespace calligraphy
