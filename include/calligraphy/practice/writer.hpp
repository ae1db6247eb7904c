// A simulated writer: plans each stroke from a belief about its shape, sees the error with a delay, corrects it, and
// slows down when it is large.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include <calligraphy/base/random.hpp>
#include <calligraphy/collision/stroke_element.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/render/haptic_tick.hpp>

namespace calligraphy {

/// Skill of a simulated writer. Lengths in em are relative to the character's square. Spreads are standard deviations
/// of values drawn anew for each character, stroke or attempt.
struct WriterSkill {
  GripImpedance grip = {};       ///< impedance between the plan and the device
  double offset = 0.0;           ///< spread of the position of the believed character [em]
  double bias = 0.0;             ///< length of an additional offset in a direction drawn for each character [em]
  double scale = 0.0;            ///< spread of the scale of the believed character [1]
  double tilt = 0.0;             ///< spread of the tilt of the believed character [rad]
  double shape = 0.0;            ///< spread of the believed position of each stroke within the character [em]
  double drift = 0.0;            ///< slow random walk off the plan while writing [em/s^0.5]
  double tremor = 0.0;           ///< amplitude of an 8 to 12 Hz tremor [m]
  double aim = 0.0;              ///< spread of the initial placement of a stroke [em]
  double wrong_order = 0.0;      ///< share of strokes for which another one is begun instead [1]
  double wrong_direction = 0.0;  ///< share of strokes begun at their end [1]
  double speed = 0.8;            ///< mean speed along a stroke without perceived error [em/s]
  double pause = 0.25;           ///< pause before the pen moves to a stroke [s]
  double visual_delay = 0.18;    ///< delay of visual perception [s]
  double correction = 2.0;       ///< share of the perceived error corrected per second [1/s]
  double caution = 0.025;        ///< perceived lateral error at which the speed is halved [em]

  /// An unskilled writer, who believes characters to be several percent of the em off and begins some strokes out of
  /// order or backwards (docs/practice.md).
  static WriterSkill novice();
  /// A skilled writer: a third of the novice's spreads, faster, and without mistakes of order or direction.
  static WriterSkill skilled();
};

/// What the display shows. It reveals neither forces nor the mode.
struct VisualFeedback {
  Eigen::Vector3d pen_tip = Eigen::Vector3d::Zero();  ///< virtual pen tip, page frame [m]
  int character = 0;                                  ///< index of the active character, shown in yellow
  int stroke = 0;                                     ///< index of the active stroke, whose start has the red ellipse
  bool writing = false;                               ///< a green trace grows from the pen
};

/// What a display shows at a tick: ink grows from the pen as soon as it stands at the start of the stroke that is due,
/// and disappears if it turns out to write something else.
VisualFeedback visual_feedback(const HapticTick& tick) noexcept;

/// Moves a hand through the strokes of a page.
///
/// Each stroke is planned as the writer believes it to be, with minimum jerk from corner to corner (Flash and Hogan
/// 1985). The display is perceived with a delay; the perceived error shifts the plan and slows the writer down. A
/// stroke that is not accepted is retried with half the error of the belief.
///
/// Deterministic per seed: the beliefs and mistakes of an attempt depend only on the seed, the character (its code
/// point and its index on the page), the stroke and the number of the attempt, so that runs in different modes can be
/// compared in pairs. Any two characters are drawn independently, even with the same seed and when alone on their
/// pages; the same character at the same index with the same seed gives the same draw.
class SimulatedWriter {
 public:
  /// A writer before the first stroke of the page.
  /// @throws ValueError when the page is empty or a parameter of the skill is out of its domain
  SimulatedWriter(const PracticePage& page, const WriterSkill& skill, std::uint64_t seed);

  /// Sees the display, advances time by `seconds` and returns the intended motion of the pen in that time, on the page.
  /// The pen senses its pressure and its height above the paper, in the steps of a tablet.
  Intention update(const VisualFeedback& sight, double seconds);

  /// Whether all characters are written, or the writer has given up after ten failures at the same stroke, and the pen
  /// is off the paper.
  bool done() const noexcept { return phase_ == Phase::done; }
  /// Index of the stroke that the current attempt intends to write; when out of order, not the one that is due.
  int intended_stroke() const noexcept { return intended_; }

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
    double duration;      ///< at full speed [s]
    Point at(double share) const { return truth.point(backwards ? 1.0 - share : share); }
  };
  struct Seen {
    double time;
    VisualFeedback sight;
    std::size_t element;
    Point planned;  ///< point of the template that was planned then
    bool on_paper;  ///< a stroke was being written
  };

  void plan_attempt();
  void plan_elements(int stroke, bool backwards);
  void see(const VisualFeedback& sight);
  void think(double seconds);
  void look_on();
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
  Random random_{0};  ///< draws for the attempt

  Phase phase_ = Phase::pause;
  double time_ = 0.0;        ///< [s]
  double phase_time_ = 0.0;  ///< since the phase began [s]
  int character_ = 0;        ///< next to be written, as far as the writer has seen
  int stroke_ = 0;
  int attempt_ = 0;

  int intended_ = 0;  ///< the stroke of the plan
  std::vector<PlannedElement> plan_;
  Belief belief_ = {};
  Point aim_error_ = Point::Zero();
  std::size_t element_ = 0;  ///< index into the plan
  double progress_ = 0.0;    ///< time within the element, at full speed [s]
  Point correction_ = Point::Zero();
  Point drift_ = Point::Zero();
  Point tremor_ = Point::Zero();
  std::array<double, 6> tremor_phases_ = {};
  double untraced_ = 0.0;  ///< time without a green trace while writing [s]

  std::deque<Seen> sights_;      ///< oldest first
  Seen seen_ = {};               ///< the newest one older than the visual delay
  double lateral_ = 0.0;         ///< perceived distance from the template [m]
  Point error_ = Point::Zero();  ///< perceived vector from the pen to the template [m]

  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();  ///< position at the beginning of the phase
  Eigen::Vector3d now_ = Eigen::Vector3d::Zero();   ///< intended position of the pen
};

}  // namespace calligraphy
