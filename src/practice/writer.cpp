#include <calligraphy/practice/writer.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/nearest_point.hpp>

#include "base/require.hpp"
#include "hand_motion.hpp"

namespace calligraphy {
namespace {

constexpr double min_approach = 0.2;    // [s]
constexpr double min_element = 0.12;    // time for a hook or a dot [s]
constexpr double max_settling = 1.2;    // how long the writer looks for the end of a stroke or for a corner [s]
constexpr double close_enough = 0.02;   // distance at which a corner or an end looks reached [em]
constexpr double notice_time = 0.5;     // time on the paper without a green trace until the writer notices [s]
constexpr double drift_decay = 1.0;     // time constant with which drift is forgotten [s]
constexpr int max_attempts = 10;

Point normal_point(Random& random) {
  const double x = random.normal();
  return {x, random.normal()};
}

void validate(const WriterSkill& skill) {
  require_within("writer: offset", skill.offset, "em", 0.0, 1.0);
  require_within("writer: bias", skill.bias, "em", 0.0, 1.0);
  require_within("writer: scale", skill.scale, "", 0.0, 0.5);
  require_within("writer: tilt", skill.tilt, "rad", 0.0, 1.0);
  require_within("writer: shape", skill.shape, "em", 0.0, 1.0);
  require_within("writer: drift", skill.drift, "em/s^0.5", 0.0, 1.0);
  require_within("writer: tremor", skill.tremor, "m", 0.0, 0.01);
  require_within("writer: aim", skill.aim, "em", 0.0, 1.0);
  require_within("writer: wrong_order", skill.wrong_order, "", 0.0, 1.0);
  require_within("writer: wrong_direction", skill.wrong_direction, "", 0.0, 1.0);
  require_within("writer: speed", skill.speed, "em/s", 0.01, 10.0);
  require_within("writer: pause", skill.pause, "s", 0.0, 10.0);
  require_within("writer: visual_delay", skill.visual_delay, "s", 0.0, 1.0);
  require_within("writer: correction", skill.correction, "1/s", 0.0, 20.0);
  require_within("writer: caution", skill.caution, "em", 1e-3, 10.0);
}

}  // namespace

VisualFeedback visual_feedback(const HapticTick& tick) noexcept {
  const bool inked = tick.state == InteractionState::writing || tick.hint == WritingHint::write;
  return {tick.pen_tip, tick.character, tick.stroke, inked};
}

WriterSkill WriterSkill::novice() {
  return {.offset = 0.04,
          .scale = 0.06,
          .tilt = 0.05,
          .shape = 0.03,
          .drift = 0.04,
          .tremor = 0.0002,
          .aim = 0.03,
          .wrong_order = 0.04,
          .wrong_direction = 0.03,
          .speed = 0.6,
          .pause = 0.35,
          .caution = 0.025};
}

WriterSkill WriterSkill::skilled() {
  return {.offset = 0.012,
          .scale = 0.02,
          .tilt = 0.015,
          .shape = 0.01,
          .drift = 0.012,
          .tremor = 0.00005,
          .aim = 0.01,
          .speed = 1.0,
          .pause = 0.2,
          .caution = 0.025};
}

Point SimulatedWriter::Belief::operator()(const Point& truth) const {
  const Point arm = scale * (truth - centre);
  return centre + offset + Point(cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y());
}

SimulatedWriter::SimulatedWriter(const PracticePage& page, const WriterSkill& skill, std::uint64_t seed)
    : page_(page.characters), skill_(skill), seed_(seed) {
  if (page_.empty()) throw ValueError("writer: the page has no character");
  validate(skill);
  now_ = {0.5 * page.width, 0.5 * page.height, raised_height};
  plan_attempt();
  begin(Phase::pause);
}

Intention SimulatedWriter::update(const VisualFeedback& sight, double seconds) {
  if (!(seconds > 0.0) || done()) return {now_, Eigen::Vector3d::Zero(), sensed_at(now_.z())};
  see(sight);
  time_ += seconds;
  phase_time_ += seconds;
  think(seconds);
  const Eigen::Vector3d before = now_;
  now_ = target();
  return {before, (now_ - before) / seconds, sensed_at(before.z())};
}

/// What is shown now is perceived only after the visual delay.
void SimulatedWriter::see(const VisualFeedback& sight) {
  const double duration = plan_[element_].duration;
  sights_.push_back({time_, sight, element_, plan_[element_].at(minimum_jerk(progress_ / duration)),
                     phase_ == Phase::write || phase_ == Phase::settle});
  while (!sights_.empty() && sights_.front().time <= time_ - skill_.visual_delay) {
    seen_ = sights_.front();
    sights_.pop_front();
  }
}

void SimulatedWriter::think(double seconds) {
  const double em = page_[static_cast<std::size_t>(character_)].placement.em;
  switch (phase_) {
    case Phase::pause:
      if (phase_time_ < skill_.pause) return;
      accepted() ? look_on() : begin(Phase::approach);  // what became of the stroke may be shown late
      return;
    case Phase::approach: {
      const double way = (belief_(plan_[0].at(0.0)) + aim_error_ - from_.head<2>()).norm();
      if (phase_time_ >= std::max(min_approach, way / approach_speed)) begin(Phase::lower);
      return;
    }
    case Phase::lower:
      if (phase_time_ >= lowering_time) begin(Phase::write);
      return;
    case Phase::write:
    case Phase::settle: {
      shake(seconds);
      correct(seconds);
      untraced_ = seen_.sight.writing || accepted() ? 0.0 : untraced_ + seconds;
      if (untraced_ > notice_time + skill_.visual_delay) {
        begin(Phase::raise);
      } else if (phase_ == Phase::write) {
        follow_plan(seconds);
      } else if (accepted() || phase_time_ > max_settling) {
        begin(Phase::raise);
      } else if (error_.norm() < close_enough * em && phase_time_ > skill_.visual_delay) {
        leave_element();
      }
      return;
    }
    case Phase::raise: {
      if (phase_time_ < raising_time + skill_.visual_delay) return;  // long enough to see what became of the stroke
      if (waiting_for_lift()) return;
      look_on();
      return;
    }
    case Phase::done:
      return;
  }
}

/// Whether the character on display has no stroke left: the next one follows once the pen leaves the paper.
bool SimulatedWriter::waiting_for_lift() const {
  const int shown = seen_.sight.character;
  return shown < static_cast<int>(page_.size()) &&
         seen_.sight.stroke >= page_[static_cast<std::size_t>(shown)].character.stroke_count();
}

/// Whether the display has moved on to another stroke.
bool SimulatedWriter::accepted() const { return seen_.sight.character != character_ || seen_.sight.stroke != stroke_; }

/// Turns to the stroke on display, or to another attempt at the last one.
void SimulatedWriter::look_on() {
  const bool next = accepted();
  attempt_ = next ? 0 : attempt_ + 1;
  character_ = next ? seen_.sight.character : character_;
  stroke_ = next ? seen_.sight.stroke : stroke_;
  if (attempt_ >= max_attempts || character_ >= static_cast<int>(page_.size())) {
    begin(Phase::done);
    return;
  }
  plan_attempt();
  begin(Phase::pause);
}

void SimulatedWriter::follow_plan(double seconds) {
  const double em = page_[static_cast<std::size_t>(character_)].placement.em;
  const double caution = skill_.caution * em;
  const double pace = 1.0 / (1.0 + (lateral_ / caution) * (lateral_ / caution));
  progress_ += pace * seconds;
  if (progress_ < plan_[element_].duration) return;
  progress_ = plan_[element_].duration;
  if (error_.norm() > close_enough * em) {
    begin(Phase::settle);  // see whether the corner or the end is reached, and go there
  } else {
    leave_element();
  }
}

/// Moves on to the next element, or off the paper after the last one.
void SimulatedWriter::leave_element() {
  if (element_ + 1 == plan_.size()) {
    begin(Phase::raise);
    return;
  }
  ++element_;
  progress_ = 0.0;
  if (phase_ == Phase::settle) begin(Phase::write);
}

/// Compares where the pen was with the template at that moment, and shifts the plan by a share of the difference.
void SimulatedWriter::correct(double seconds) {
  if (!seen_.on_paper) return;
  const Point tip = seen_.sight.pen_tip.head<2>();
  error_ = seen_.planned - tip;
  lateral_ = nearest_point(plan_[seen_.element].truth, tip).distance;
  correction_ += skill_.correction * seconds * error_;
}

void SimulatedWriter::shake(double seconds) {
  const double em = page_[static_cast<std::size_t>(character_)].placement.em;
  drift_ *= std::exp(-seconds / drift_decay);
  drift_ += skill_.drift * em * std::sqrt(seconds) * normal_point(random_);
  tremor_ = Point::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi * (8.0 + 2.0 * static_cast<double>(i)) * time_;
    tremor_ += skill_.tremor / 3.0 *
               Point(std::sin(angle + tremor_phases_[2 * i]), std::sin(angle + tremor_phases_[2 * i + 1]));
  }
}

void SimulatedWriter::begin(Phase phase) {
  phase_ = phase;
  phase_time_ = 0.0;
  from_ = now_;
}

/// Draws what the writer believes about the stroke that is due; each further attempt halves the error.
void SimulatedWriter::plan_attempt() {
  const PlacedCharacter& placed = page_[static_cast<std::size_t>(character_)];
  const double em = placed.placement.em;
  const double misbelief = std::pow(0.5, attempt_);

  // Each belief has its own random sequence, so none depends on how many were drawn before. The code point is in every
  // key, because characters alone on their pages all have index 0.
  const int code = static_cast<int>(placed.character.code);
  Random of_character(seed_, {code, character_});
  const Point offset = skill_.offset * em * normal_point(of_character);
  const double scale = skill_.scale * of_character.normal();
  const double tilt = misbelief * skill_.tilt * of_character.normal();
  const double direction = 2.0 * std::numbers::pi * of_character.next();
  const Point bias = skill_.bias * em * Point(std::cos(direction), std::sin(direction));
  Random of_stroke(seed_, {code, character_, stroke_});
  const Point shape = skill_.shape * em * normal_point(of_stroke);
  belief_ = {placed.placement.to_page(Point(0.5, 0.5)), misbelief * (offset + bias + shape), 1.0 + misbelief * scale,
             std::cos(tilt), std::sin(tilt)};

  random_ = Random(seed_, {code, character_, stroke_, attempt_});
  aim_error_ = misbelief * skill_.aim * em * normal_point(random_);
  for (double& phase : tremor_phases_) phase = 2.0 * std::numbers::pi * random_.next();
  const int later = placed.character.stroke_count() - stroke_ - 1;
  const double order_draw = random_.next(), direction_draw = random_.next(), which = random_.next();
  const bool out_of_order = attempt_ == 0 && later > 0 && order_draw < skill_.wrong_order;
  const bool backwards = attempt_ == 0 && !out_of_order && direction_draw < skill_.wrong_direction;
  plan_elements(out_of_order ? stroke_ + 1 + static_cast<int>(which * later) : stroke_, backwards);

  sights_.clear();  // they refer to the last plan
  seen_.on_paper = false;
  element_ = 0;
  progress_ = 0.0;
  untraced_ = 0.0;
  correction_ = drift_ = tremor_ = error_ = Point::Zero();
  lateral_ = 0.0;
}

void SimulatedWriter::plan_elements(int stroke, bool backwards) {
  const PlacedCharacter& placed = page_[static_cast<std::size_t>(character_)];
  intended_ = stroke;
  plan_.clear();
  const Stroke drawn = strokes(placed.character)[static_cast<std::size_t>(stroke)];
  for (const StrokeElement& truth : place_elements(drawn, placed.placement)) {
    const double duration = truth.length() / (skill_.speed * placed.placement.em);
    plan_.push_back({truth, backwards, std::max(min_element, duration)});
  }
  if (backwards) std::reverse(plan_.begin(), plan_.end());
}

Eigen::Vector3d SimulatedWriter::target() const {
  Eigen::Vector3d point = now_;
  const auto& element = plan_[element_];
  const Point start = belief_(plan_[0].at(0.0)) + aim_error_;
  switch (phase_) {
    case Phase::pause:
    case Phase::done:
      return point;
    case Phase::approach: {
      const double way = (start - from_.head<2>()).norm();
      const double share = minimum_jerk(phase_time_ / std::max(min_approach, way / approach_speed));
      point.head<2>() = from_.head<2>() + share * (start - from_.head<2>());
      return point;
    }
    case Phase::lower:
      point.z() = raised_height - minimum_jerk(phase_time_ / lowering_time) * (raised_height + pressed_depth);
      return point;
    case Phase::write:
    case Phase::settle: {
      const double share = minimum_jerk(progress_ / element.duration);
      // The error at the start persists until it is seen and corrected.
      point.head<2>() = belief_(element.at(share)) + aim_error_ + correction_ + drift_ + tremor_;
      point.z() = -pressed_depth;
      return point;
    }
    case Phase::raise:
      point.z() = from_.z() + minimum_jerk(phase_time_ / raising_time) * (raised_height - from_.z());
      return point;
  }
  return point;
}

}  // namespace calligraphy
