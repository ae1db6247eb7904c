// A simulated person who writes: plans each stroke as they believe it to be, sees their error late, corrects it, and
// slows when it is large.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include <calligraphy/base/random.hpp>
#include <calligraphy/collision/stroke_element.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/practice/page.hpp>

namespace calligraphy {

/// How well a person writes. Lengths in em are relative to the character's square. Spreads are standard deviations,
/// drawn anew for each character, stroke or attempt.
struct WriterSkill {
  Hand hand;                     ///< impedance between the plan and the device
  double offset = 0.0;           ///< of the believed character [em]
  double bias = 0.0;             ///< length of one more offset, in a direction drawn for each character; no spread [em]
  double scale = 0.0;            ///< of the believed character [1]
  double tilt = 0.0;             ///< of the believed character [rad]
  double shape = 0.0;            ///< of each stroke's believed place within the character [em]
  double drift = 0.0;            ///< slow wandering off the plan while writing, per square root of a second [em/s^0.5]
  double tremor = 0.0;           ///< amplitude of an 8 to 12 Hz tremor [m]
  double aim = 0.0;              ///< of where a stroke is begun [em]
  double wrong_order = 0.0;      ///< share of strokes begun with another one [1]
  double wrong_direction = 0.0;  ///< share of strokes begun at their end [1]
  double speed = 0.8;            ///< mean speed along a stroke when nothing is wrong [em/s]
  double pause = 0.25;           ///< before the pen moves to a stroke [s]
  double sight_delay = 0.18;     ///< age of what is seen [s]
  double correction = 2.0;       ///< share of the error seen that is corrected per second [1/s]
  double caution = 0.025;        ///< error seen at which the pace is halved [em]

  static WriterSkill novice();
  static WriterSkill skilled();
};

/// What the display shows: nothing of forces, nothing of the mode.
struct Sight {
  Eigen::Vector3d pen_tip = Eigen::Vector3d::Zero();  ///< page [m]
  int character = 0;                                  ///< the yellow one
  int stroke = 0;                                     ///< the one whose start has the red ellipse
  bool writing = false;                               ///< a green trace grows from the pen
};

/// Moves a hand through the strokes of a page.
///
/// Each stroke is planned as the writer believes it to be, at minimum-jerk speed from corner to corner (Flash and Hogan
/// 1985). What the display shows is seen late; the error seen shifts the plan and slows the pace. A stroke that the
/// display does not take is tried again with half the misbelief.
///
/// Deterministic per seed: the beliefs and mistakes of an attempt depend on the seed, the character, the stroke and the
/// number of the attempt alone, so that two runs in different modes are a fair pair.
class SimulatedWriter {
 public:
  /// @throws ValueError when the page is empty or a number of the skill is out of its domain
  SimulatedWriter(const Page& page, const WriterSkill& skill, std::uint64_t seed);

  /// Sees the display, lets `seconds` pass and says how the pen is meant to move in that time, on the page.
  Intention update(const Sight& sight, double seconds);

  /// All characters are written, or given up, and the pen is off the paper.
  bool done() const noexcept { return phase_ == Phase::done; }
  /// The same stroke failed ten times.
  bool gave_up() const noexcept { return gave_up_; }

 private:
  enum class Phase { pause, approach, lower, write, settle, raise, done };

  struct Belief {
    Point centre, offset;
    double scale, cosine, sine;
    Point operator()(const Point& truth) const;
  };
  struct PlannedElement {
    StrokeElement truth;  ///< as drawn on the page
    bool backwards;       ///< written from its end to its start
    double duration;      ///< at full pace [s]
    Point at(double share) const { return truth.point(backwards ? 1.0 - share : share); }
  };
  struct Seen {
    double time;
    Sight sight;
    std::size_t element;
    Point planned;  ///< where the template is at that moment's progress
    bool on_paper;  ///< a stroke was being written
  };

  void plan_attempt();
  void plan_elements(int stroke, bool backwards);
  void see(const Sight& sight);
  void think(double seconds);
  void follow_plan(double seconds);
  void leave_element();
  void correct(double seconds);
  void shake(double seconds);
  void begin(Phase phase);
  bool accepted() const;
  bool waiting_for_lift() const;
  Eigen::Vector3d target() const;

  std::vector<PlacedCharacter> page_;
  WriterSkill skill_;
  std::uint64_t seed_;
  Random random_{0};  ///< of the attempt

  Phase phase_ = Phase::pause;
  double time_ = 0.0;        ///< [s]
  double phase_time_ = 0.0;  ///< since the phase began [s]
  bool gave_up_ = false;
  int character_ = 0;  ///< to be written next, as far as the writer has seen
  int stroke_ = 0;
  int attempt_ = 0;

  std::vector<PlannedElement> plan_;
  Belief belief_ = {};
  Point aim_error_ = Point::Zero();
  std::size_t element_ = 0;  ///< of the plan
  double progress_ = 0.0;    ///< time at full pace within the element [s]
  Point correction_ = Point::Zero();
  Point drift_ = Point::Zero();
  Point tremor_ = Point::Zero();
  std::array<double, 6> tremor_phases_ = {};
  double untaken_ = 0.0;  ///< for how long no green trace was seen while writing [s]

  std::deque<Seen> sights_;      ///< from oldest to newest
  Seen seen_ = {};               ///< the newest that is old enough to be known
  double lateral_ = 0.0;         ///< distance from the template seen [m]
  Point error_ = Point::Zero();  ///< from the pen to where the template is, as seen [m]

  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();  ///< where the phase began
  Eigen::Vector3d now_ = Eigen::Vector3d::Zero();   ///< where the pen is meant to be
};

}  // namespace calligraphy
