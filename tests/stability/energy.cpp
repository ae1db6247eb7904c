#include "energy.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/servo.hpp>

#include "independent_hand.hpp"
#include "scene.hpp"

namespace calligraphy_test {
namespace {

using namespace calligraphy;

constexpr double hand_speed = 2.0;  // above it a hand does no positive work [m/s]
constexpr std::array<char32_t, 3> written = {U'一', U'十', U'永'};

Vector3d random_direction(Random& random) {
  const double z = random.between(-1.0, 1.0), angle = random.between(0.0, 2.0 * std::numbers::pi);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

Vector3d along_page(Random& random) {
  const double angle = random.between(0.0, 2.0 * std::numbers::pi);
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// Page axes, which are those of the device but for an offset.
class TryingHand {
 public:
  /// `delay`: age of the loop's samples [s].
  TryingHand(EnergyHand kind, double delay, std::uint64_t seed) : kind_(kind), delay_(delay), random_(seed) {
    for (const char32_t code : written) {
      const PlacedCharacter placed = in_the_middle(built_in_characters().at(code));
      std::vector<StrokePath> paths;
      for (int i = 0; i < placed.character.stroke_count(); ++i) paths.emplace_back(placed, static_cast<std::size_t>(i));
      paths_.push_back(std::move(paths));
    }
    place_ = on_page(paths_[0][0].at(0.0), 0.005);
    switch (kind_) {
      case EnergyHand::soft:
        grip_ = {0.05, 1.0, 100.0};
        break;
      case EnergyHand::firm:
        grip_ = {0.15, 5.0, 500.0};
        break;
      case EnergyHand::light:
        grip_ = {0.02, 0.3, 30.0};
        break;
      case EnergyHand::negative_damping:
        grip_ = {0.05, -3.0, 100.0};
        break;
      case EnergyHand::square_waves:
      case EnergyHand::resonance:
        grip_ = {0.02, 0.0, 40.0};
        break;
      case EnergyHand::hold_and_release:
        grip_ = {0.15, 10.0, 1000.0};
        break;
      case EnergyHand::greedy:
        grip_ = {0.05, 10.0, 0.0};
        break;
      case EnergyHand::shaking:
        grip_ = {0.02, 50.0, 0.0};
        break;
      default:
        break;
    }
  }

  const Vector3d& place() const { return place_; }

  /// At a tick: what the hand does until the next one. It knows whether a gap follows.
  void plan(double time, double elapsed, const HapticTick& felt, bool gap_follows) {
    planned_ = time;
    write(felt, elapsed);
    if (time >= next_) disturb(time);
    if (kind_ == EnergyHand::hold_and_release) {
      if (gap_follows && random_.next() < 0.7) opened_until_ = time + random_.between(0.004, 0.03);
    }
  }

  HandAction act(double time, const Vector3d& position, const Vector3d& velocity, const Vector3d& device_force) const {
    HandAction action;
    const Vector3d to = place_ + (time - planned_) * going_ + (time < jogged_until_ ? jog_ : Vector3d(0.0, 0.0, 0.0));
    const bool held = kind_ != EnergyHand::bare && time >= opened_until_;
    if (held) action.mass = grip_.mass;
    if (kind_ == EnergyHand::greedy) {
      Vector3d wish = 0.3 * (to - position) / 0.02;
      const double size = device_force.norm();
      if (size > 0.05 && (position - to).norm() < 0.02) wish += 1.5 / size * device_force;
      action.force = grip_.damping * (wish - velocity);
    } else if (kind_ == EnergyHand::shaking) {
      const Vector3d wish = 0.3 * (to - position) / 0.02 + std::sin(frequency_ * time) * shake_;
      action.force = grip_.damping * (wish - velocity);
    } else if (held) {
      action.force = grip_force(grip_, to, going_, position, velocity);
    } else {
      action.force = 5.0 * (to - position);  // it does not drift away
      action.force.z() = 0.0;
    }
    if (kind_ == EnergyHand::resonance && velocity.norm() > 1e-4)
      action.force += strength_ / velocity.norm() * velocity;
    if (time < knocked_until_) action.force += knock_;
    action.force.z() -= press_;
    // The end of the workspace.
    if ((position - Vector3d(0.5 * page_width, 0.5 * page_height, 0.0)).norm() > 0.1 || position.z() < -0.015) {
      action.force -= 5.0 * velocity;
      if (position.z() < -0.015) action.force.z() += 400.0 * (-0.015 - position.z());
    }
    const double speed = velocity.norm(), power = action.force.dot(velocity);
    if (speed >= hand_speed && power > 0.0) action.force -= power / (speed * speed) * velocity;
    return action;
  }

 private:
  enum class Phase { approach, lower, follow, raise };

  static Vector3d on_page(const Point& point, double z) { return {point.x(), point.y(), z}; }

  /// Moves the intended place along the stroke that is due.
  void write(const HapticTick& felt, double elapsed) {
    place_ += elapsed * going_;
    const auto& strokes = paths_[static_cast<std::size_t>(felt.character) % paths_.size()];
    const std::size_t due = std::min(static_cast<std::size_t>(felt.stroke), strokes.size() - 1);
    const StrokePath& path = strokes[due];
    Vector3d goal = place_;
    double speed = 0.3;
    if (phase_ == Phase::approach) {
      goal = on_page(path.at(0.0) + miss_, 0.004);
    } else if (phase_ == Phase::lower) {
      goal = on_page(path.at(0.0) + miss_, -depth_);
      speed = 0.15;
    } else if (phase_ == Phase::follow) {
      arc_ += writing_speed_ * elapsed;
      goal = on_page(path.at(arc_) + miss_, -depth_);
    } else {
      goal.z() = 0.004;
    }
    const Vector3d way = goal - place_;
    const double distance = way.norm(), period = 0.001;
    going_ = distance > speed * period ? Vector3d(way * (speed / distance)) : Vector3d(way / period);
    if (phase_ == Phase::follow) {
      patience_ -= elapsed;
      const bool left = felt.stroke != stroke_ || felt.character != character_;
      if (left || patience_ < 0.0 || arc_ > path.length() + 0.005) phase_ = Phase::raise;
    } else if (distance <= speed * period) {
      if (phase_ == Phase::approach) {
        phase_ = Phase::lower;
      } else if (phase_ == Phase::lower) {
        phase_ = Phase::follow;
        stroke_ = felt.stroke;
        character_ = felt.character;
        arc_ = 0.0;
      } else {
        phase_ = Phase::approach;
        const double miss = random_.between(0.0, 0.007);
        miss_ = miss * along_page(random_).head<2>();
        depth_ = random_.between(0.0005, 0.003);
        writing_speed_ = random_.between(0.02, 0.15);
        patience_ = 2.0;
        if (random_.next() < 0.3) {  // stays at the start
          writing_speed_ = 0.0;
          patience_ = 6.0;
        }
      }
    }
  }

  void disturb(double time) {
    switch (kind_) {
      case EnergyHand::bare:
        press_ = random_.next() < 0.2 ? -0.3 : random_.between(0.1, 2.0);
        knock_ = random_.between(0.0, 5.0) * random_direction(random_);
        knocked_until_ = time + 0.01;
        next_ = time + random_.between(0.05, 0.6);
        break;
      case EnergyHand::square_waves:
        knock_ = random_.between(0.5, 4.0) * random_direction(random_);
        knocked_until_ = next_ = time + random_.between(0.005, 0.1);
        break;
      case EnergyHand::hold_and_release:
        opened_until_ = time + random_.between(0.005, 0.06);
        next_ = opened_until_ + random_.between(0.02, 0.3);
        break;
      case EnergyHand::resonance:
        strength_ = random_.between(0.5, 2.0);
        press_ = random_.between(0.0, 1.0);
        next_ = time + random_.between(0.5, 3.0);
        break;
      case EnergyHand::pushes:
        knock_ = 10.0 * random_direction(random_);
        knocked_until_ = time + random_.between(0.01, 0.05);
        next_ = knocked_until_ + random_.between(0.05, 0.5);
        break;
      case EnergyHand::shaking:
        // In the middle of those that are late by a quarter to three quarters of a swing; no hand is faster than 60 Hz.
        frequency_ = 2.0 * std::numbers::pi * std::min(60.0, random_.between(0.35, 0.65) / delay_);
        shake_ = random_.between(0.05, 0.5) * along_page(random_);
        next_ = time + random_.between(0.5, 3.0);
        break;
      case EnergyHand::greedy:
        press_ = random_.between(0.0, 1.0);
        next_ = time + random_.between(0.5, 2.0);
        break;
      default:
        jog_ = random_.between(0.002, 0.012) * random_direction(random_);
        jogged_until_ = time + random_.between(0.02, 0.06);
        next_ = jogged_until_ + random_.between(0.1, 1.0);
        break;
    }
  }

  EnergyHand kind_;
  double delay_;  ///< [s]
  Random random_;
  GripImpedance grip_;
  std::vector<std::vector<StrokePath>> paths_;  ///< of the characters that repeat
  Phase phase_ = Phase::approach;
  Vector3d place_, going_ = Vector3d::Zero();
  Point miss_ = Point::Zero();
  double depth_ = 0.001, writing_speed_ = 0.05, arc_ = 0.0, patience_ = 2.0, planned_ = 0.0;
  int stroke_ = 0, character_ = 0;
  double next_ = 0.3;  ///< when the hand does something else [s]
  double opened_until_ = 0.0, jogged_until_ = 0.0, knocked_until_ = 0.0, strength_ = 1.0, press_ = 0.0;
  double frequency_ = 0.0;  ///< [rad/s]
  Vector3d jog_ = Vector3d::Zero(), knock_ = Vector3d::Zero(), shake_ = Vector3d::Zero();
};

/// The clock of the run in this thread, for the work of its servo [s].
thread_local double now = 0.0;
double clock_of_run() noexcept { return now; }

/// Faults that last for a few ticks.
class Burst {
 public:
  bool next(Random& random, double share, int longest) {
    if (left_ == 0 && random.next() < share) {
      left_ = 1 + static_cast<int>(random.index(static_cast<std::uint64_t>(longest)));
    }
    return left_ > 0 && left_-- > 0;
  }

 private:
  int left_ = 0;
};

}  // namespace

EnergyResult run_energy(const EnergyRun& run) {
  EnergyResult result;
  const double rate = run.device.update_rate, period = 1.0 / rate;
  const MotionMapping mapping = upright_page(page_width, page_height);
  // A stroke takes a quarter of a second at least.
  const std::int64_t characters = 2 + static_cast<std::int64_t>(static_cast<double>(run.ticks) * period * 4.0);
  std::vector<PlacedCharacter> page;
  for (std::int64_t i = 0; i < characters; ++i) {
    page.push_back(in_the_middle(built_in_characters().at(written[static_cast<std::size_t>(i) % written.size()])));
  }
  std::optional<HapticRenderer> made;
  try {
    RendererOptions options = RendererOptions::everything(run.device);
    options.energy.budget = run.budget;
    options.stiffness_check = StiffnessCheck::clip;
    made.emplace(std::move(page), mapping, run.device, options);
  } catch (const Error& error) {
    result.refusal = error.what();
    return result;
  }
  HapticRenderer& renderer = *made;
  const double max_gap = renderer.options().energy.max_gap;

  Random random(run.seed, {static_cast<int>(run.hand), static_cast<int>(run.timing), run.device.sample_delay});
  TryingHand hand(run.hand, (run.device.sample_delay + 1) * period, random.bits());
  IndependentDevice device(run.device, mapping.to_device(hand.place()));
  const auto act = [&](double time, const Vector3d& position, const Vector3d& velocity) {
    return hand.act(time, mapping.to_page(position), velocity, device.force());
  };
  const bool jitters = run.timing == Timing::jitter || run.timing == Timing::everything;
  const bool idles = run.timing == Timing::idle_watchdog, starves = run.timing == Timing::starved_watchdog;
  const bool gaps = run.timing == Timing::gaps || run.timing == Timing::everything || idles || starves;
  const bool faulty = run.timing == Timing::stale_and_lost || run.timing == Timing::everything;
  Burst stale, lost, starved;
  double elapsed = period, last_elapsed = 0.0;  // of the time planned last [s]
  int pieces = 1, in_law = 0, pieces_left = 1;  // of a tick, those that the force law takes, and those to come
  Servo* watched = nullptr;
  const auto pass = [&](int count) {
    hand.plan(device.time(), std::exchange(last_elapsed, elapsed * count / pieces), renderer.last(), pieces > 1);
    for (int i = 0; i < count; ++i) {
      device.advance(elapsed / pieces, act);
      now = device.time();
      const bool called = starves ? !starved.next(random, 0.1, 40) : !idles || pieces > 1;
      if (watched != nullptr && called) watched->supervise(now);
    }
  };
  ServoOptions servo_options;
  servo_options.rate = rate;
  servo_options.timeout = std::max(servo_options.timeout, 2.0 * period);
  servo_options.work_clock = clock_of_run;
  Servo servo(
      device,
      [&](const DeviceState& state) {
        const Vector3d force = renderer.update(state).force;
        if (in_law > 0) pass(in_law);
        pieces_left -= in_law;
        return force;
      },
      servo_options);
  if (run.servo) watched = &servo;

  double allowance = 0.0, least = 0.0;
  // The force takes 0.2 s to return after a watchdog has removed it.
  const double most_gaps = needs_servo(run.timing) ? 0.2 * run.gap_share : run.gap_share;
  double gap_share = most_gaps;
  bool frozen = false;
  for (std::int64_t tick = 0; tick < run.ticks; ++tick) {
    if (tick % 500 == 0) {
      gap_share = std::min(most_gaps, most_gaps * std::exp(random.between(-3.0, 0.7)));
    }
    if (faulty) {
      device.stale = stale.next(random, 0.03, 4);
      device.lost = !device.stale && lost.next(random, 0.003, 3);
    }
    elapsed = jitters ? period * random.between(0.5, 1.5) : period;
    pieces = 1;
    if (gaps && random.next() < gap_share) {
      // Half of them so short that the watchdog of a Servo does not ramp down.
      const int longest = random.next() < 0.5 ? std::min(run.longest_gap, run.shortest_gap + 2) : run.longest_gap;
      pieces = run.shortest_gap +
               static_cast<int>(random.index(static_cast<std::uint64_t>(std::max(1, longest - run.shortest_gap + 1))));
      elapsed = pieces * period;
    }
    pieces_left = pieces;
    in_law = needs_servo(run.timing) && pieces > 1 && random.next() < 0.5 ? pieces - 1 : 0;
    const double possible = device.energy_possible();
    if (run.servo) {
      servo.step(device.time());
    } else {
      device.write(renderer.update(device.read()).force);
    }
    const HapticTick& felt = renderer.last();
    result.most_claimed = std::max(result.most_claimed, felt.energy_given);
    result.peak_force = std::max(result.peak_force, device.force().norm());
    if (felt.state == InteractionState::writing) {
      ++result.writing;
      result.mean_force += device.force().norm();
    }
    if (has_event(felt.events, TickEvent::stroke_finished) && !frozen) ++result.strokes;
    frozen = device.stale || device.lost;

    pass(pieces_left);
    const bool long_gap = elapsed > max_gap * (1.0 + 1e-9);
    if (long_gap) allowance += device.energy_possible() - possible;
    result.most_excess = std::max(result.most_excess, device.energy_given() - run.budget - allowance);
    if (!long_gap && device.energy_given() <= run.budget) allowance = 0.0;
    least = std::min(least, device.energy_given());
    result.most_rise = std::max(result.most_rise, device.energy_given() - least);
  }
  result.most_given = device.most_energy_given();
  result.given_at_end = device.energy_given();
  if (result.writing > 0) result.mean_force /= static_cast<double>(result.writing);
  return result;
}

}  // namespace calligraphy_test
