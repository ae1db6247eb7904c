// Energy observer and budget: true energy, and a budget that is never exceeded.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/render/detail/energy_observer.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "render/energy_budget.hpp"
#include "render/force_limiter.hpp"
#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"
#include "../sanitized.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;
const Vector3d lost(not_a_number, not_a_number, not_a_number);

Vector3d random_vector(Sequence& random, double largest) {
  const double x = random.between(-largest, largest), y = random.between(-largest, largest);
  return {x, y, random.between(-largest, largest)};
}

using Pen = std::function<Vector3d(double time)>;
using Field = std::function<Vector3d(double time, const Vector3d& velocity, const Vector3d& last_force)>;

struct Setting {
  double rate = 1000.0;
  int delay = 0;
  double budget = 0.01;
  bool limited = true;          ///< a force limiter follows
  double share_of_lost = 0.0;   ///< fraction of the samples, at most 16 ms in a row; the force is released meanwhile
  double share_of_stale = 0.0;  ///< likewise, while the field asks for more of the last force
  double share_of_gaps = 0.0;   ///< fraction of the ticks after which the loop pauses for up to max_gap
  bool guarded = false;         ///< a later stage scales the force down at random, in the midst of gaps too
};

constexpr double force_rate = 100.0, peak = 3.3, hand_speed = 2.0, max_gap = 0.016;

/// Maximum energy that the force has delivered at any tick to a pen on a prescribed path, relative to the budget: true
/// work of the force that acts, whatever the budget was told.
double max_given(const Setting& setting, const Pen& pen, const Field& field, double seconds) {
  const double period = 1.0 / setting.rate;
  EnergyBudgetOptions options;
  options.budget = setting.budget;
  options.observer.delay = setting.delay;
  options.mass = 1e9;  // the pen moves as prescribed
  options.observer.hand_speed = hand_speed;
  options.observer.max_gap = max_gap;
  EnergyBudget budget(options, period);
  const double step = setting.limited ? force_rate * period : ForceLimiter::no_limit;
  const ForceLimiter limiter{step, 4.0 * step, peak};
  Sequence random(3);
  Vector3d sent(0, 0, 0), place = pen(0.0);
  double given = 0.0, most = 0.0;
  const auto sample = [&](int tick) { return pen(std::max(0, tick) * period); };
  const auto act = [&](int tick, const Vector3d& force) {
    const Vector3d next = pen((tick + 1) * period);
    given += force.dot(next - place);
    most = std::max(most, given);
    place = next;
  };
  int unseen = 0, passed = 1;
  Vector3d acted(0, 0, 0);
  for (int i = 0; i < static_cast<int>(seconds * setting.rate); i += passed) {
    if (i > 0) budget.acted(acted, passed);
    const double kind = random.next();
    const bool may_fail = (unseen + 1) * period <= max_gap && i > 0;
    const bool is_lost = may_fail && kind < setting.share_of_lost;
    const bool is_stale = may_fail && !is_lost && kind < setting.share_of_lost + setting.share_of_stale;
    if (is_lost || is_stale) {
      ++unseen;
      const Vector3d wanted = budget.next(lost, is_stale ? Vector3d(3.0 * sent) : Vector3d(0, 0, 0));
      sent = is_stale ? limiter.next(sent, wanted, {}, budget.max_force()) : limiter.release(sent);
    } else {
      unseen = 0;
      const Vector3d position = sample(i - setting.delay);
      const Vector3d velocity = (position - sample(i - setting.delay - 1)) / period;
      const Vector3d wanted = budget.next(position, field(i * period, velocity, sent));
      sent = limiter.next(sent, wanted, {}, budget.max_force());
    }
    budget.sent(sent);
    passed = 1;
    if (unseen == 0 && random.next() < setting.share_of_gaps) {
      passed = 1 + static_cast<int>(random.between(0.0, std::floor(max_gap * setting.rate) + 0.999));
    }
    // Reduced at some moment of the gap, or from its beginning on.
    const bool reduces = setting.guarded && random.next() < 0.3;
    const double share = reduces ? random.between(0.0, 1.0) : 1.0;
    const int held = passed > 1 ? static_cast<int>(random.between(0.0, passed)) : 0;
    acted = share * sent;
    for (int k = 0; k < passed; ++k) act(i + k, k < held ? sent : acted);
  }
  return most / setting.budget;
}

Pen straight(double speed) {
  return [speed](double time) { return Vector3d(0.6 * speed * time, 0.8 * speed * time, 0.0); };
}

/// Back and forth, up to `speed`, with accelerations up to `acceleration`.
Pen to_and_fro(double speed, double acceleration) {
  const double frequency = acceleration / speed;
  return [=](double time) {
    const double way = speed / frequency * std::sin(frequency * time);
    return Vector3d(0.6 * way, 0.8 * way, 0.0);
  };
}

/// In a circle, so that the direction of motion turns constantly.
Pen round(double speed, double acceleration) {
  const double frequency = acceleration / speed, radius = speed / frequency;
  return [=](double time) {
    return Vector3d(radius * std::cos(frequency * time), radius * std::sin(frequency * time), 0.0);
  };
}

Vector3d unit(const Vector3d& velocity) {
  const double speed = velocity.norm();
  return speed > 0.0 ? Vector3d(velocity / speed) : Vector3d(0, 0, 0);
}

/// Fields that deliver energy as fast as they can.
const std::vector<std::pair<const char*, Field>> hostile_fields = {
    {"along the motion",
     [](double, const Vector3d& velocity, const Vector3d&) -> Vector3d { return 10.0 * unit(velocity); }},
    {"along the motion and to and fro along the normal",
     [](double time, const Vector3d& velocity, const Vector3d&) -> Vector3d {
       const double normal = std::fmod(time, 0.02) < 0.01 ? 2.0 : -2.0;
       return 10.0 * (unit(velocity) + Vector3d(0, 0, normal));
     }},
    {"along the motion and swinging about it",
     [](double time, const Vector3d& velocity, const Vector3d&) -> Vector3d {
       const Vector3d along = unit(velocity), across(-along.y(), along.x(), 0.0);
       return 10.0 * (along + (std::fmod(time, 0.01) < 0.005 ? 1.5 : -1.5) * across);
     }},
    {"turning away from the last force, so that it hardly falls",
     [](double, const Vector3d& velocity, const Vector3d& last) -> Vector3d {
       const Vector3d along = unit(velocity);
       return 10.0 * along + 3.0 * Vector3d(-last.y(), last.x(), 0.0);
     }},
    {"on and off", [](double time, const Vector3d& velocity, const Vector3d&) -> Vector3d {
       return (std::fmod(time, 0.06) < 0.03 ? 10.0 : -1.0) * unit(velocity);
     }}};

constexpr double hostile_seconds = calligraphy_test::sanitized ? 0.5 : 2.0;

}  // namespace

TEST_CASE("the observed energy is the true work of the held force", "[render]") {
  // Random forces and steps, so that nothing but F(n) . (x(n + 1) - x(n)) can add up to it.
  for (const int delay : {0, 1, 2, 5, detail::EnergyObserver::max_delay}) {
    EnergyBudgetOptions options;
    options.observer.delay = delay;
    EnergyBudget budget(options, 0.001);
    Sequence random(41);
    std::vector<Vector3d> places = {random_vector(random, 0.1)};
    std::vector<double> work = {0.0};  // done until each tick
    double max_error = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const std::size_t seen = static_cast<std::size_t>(std::max(0, i - delay));
      budget.next(places[seen], random_vector(random, 3.0));
      max_error = std::max(max_error, std::abs(budget.energy_given() - work[seen]));
      const Vector3d force = random_vector(random, 3.0);
      budget.sent(force);
      places.push_back(places.back() + random_vector(random, 1e-3));
      work.push_back(work.back() + force.dot(places[places.size() - 1] - places[places.size() - 2]));
    }
    INFO("delay " << delay);
    CHECK(std::abs(work.back()) > 1e-3);
    CHECK(max_error < 1e-13 * 5000);
  }
}

TEST_CASE("no field, pen up to the speed of a hand, rate or delay extracts more than the budget", "[render]") {
  for (const double rate : {100.0, 1000.0, 20'000.0}) {
    for (const int delay : {0, 1, 2, 5, detail::EnergyObserver::max_delay}) {
      const Setting setting{rate, delay};
      const double seconds = rate > 5000.0 ? 0.25 * hostile_seconds : hostile_seconds;
      for (const auto& [name, field] : hostile_fields) {
        for (const Pen& pen : {straight(0.1), straight(2.0), to_and_fro(2.0, 100.0), round(2.0, 100.0)}) {
          INFO(name << ", " << rate << " Hz, delay " << delay);
          CHECK(max_given(setting, pen, field, seconds) <= 1.0 + 1e-9);
        }
      }
    }
  }
}

TEST_CASE("a hand that shakes so fast that late samples make the brake push gets no more than the budget in minutes",
          "[render]") {
  const double seconds = calligraphy_test::sanitized ? 4.0 : 300.0;
  for (int delay = 0; delay <= detail::EnergyObserver::max_delay; ++delay) {
    Setting setting{1000.0, delay};
    for (const double swing : {2.1, 2.7, 3.5}) {  // periods of the swing over the age of the brake
      const Pen pen = to_and_fro(0.2, 0.2 * 2.0 * std::numbers::pi * setting.rate / (swing * (delay + 1)));
      CAPTURE(delay, swing);
      CHECK(max_given(setting, pen, hostile_fields[0].second, seconds) <= 1.0 + 1e-9);
    }
  }
}

TEST_CASE("the budget holds whatever its size, and is used", "[render]") {
  for (const double budget : {0.0, 1e-9, 1e-3, 0.1}) {
    for (const auto& [name, field] : hostile_fields) {
      Setting setting;
      setting.budget = std::max(budget, 1e-300);
      const double share = max_given(setting, straight(1.0), field, hostile_seconds);
      INFO(name << ", " << budget << " J");
      CHECK(share <= 1.0 + 1e-9);
      if (budget == 0.1) CHECK(share > (std::string(name) == "on and off" ? 0.65 : 0.9));
    }
  }
}

TEST_CASE("the budget holds without a limiter, where a force appears and disappears at once", "[render]") {
  for (const auto& [name, field] : hostile_fields) {
    for (const double rate : {100.0, 1000.0, 20'000.0}) {
      Setting setting{rate};
      setting.limited = false;
      INFO(name << ", " << rate << " Hz");
      CHECK(max_given(setting, straight(2.0), field, 0.25 * hostile_seconds) <= 1.0 + 1e-9);
    }
  }
}

TEST_CASE("the budget holds over gaps of up to max_gap in which the force is held", "[render]") {
  for (const double rate : {100.0, 500.0, 1000.0, 4000.0}) {
    for (const int delay : {0, 1, 5}) {
      for (const auto& [name, field] : hostile_fields) {
        for (const Pen& pen : {straight(2.0), to_and_fro(2.0, 100.0)}) {
          Setting setting{rate, delay};
          setting.budget = 0.1;
          setting.share_of_gaps = 0.2;
          INFO(name << ", " << rate << " Hz, delay " << delay);
          // What the brake gives when it is held over a turn of the pen is in reserve.
          CHECK(max_given(setting, pen, field, hostile_seconds) <= 1.0 + 1e-9);
        }
      }
    }
  }
}

TEST_CASE("the budget holds when a later stage weakens the force and reports it, in gaps and between them",
          "[render]") {
  for (const double share_of_gaps : {0.0, 0.2}) {
    for (const int delay : {0, 2, 5}) {
      for (const auto& [name, field] : hostile_fields) {
        for (const Pen& pen : {straight(2.0), to_and_fro(2.0, 100.0), round(1.0, 50.0)}) {
          Setting setting{1000.0, delay};
          setting.guarded = true;
          setting.share_of_gaps = share_of_gaps;
          INFO(name << ", delay " << delay << ", gaps " << share_of_gaps);
          CHECK(max_given(setting, pen, field, hostile_seconds) <= 1.0 + 1e-9);
        }
      }
    }
  }
}

TEST_CASE("lost and stale samples are charged as if the pen moved along the force as fast as a hand", "[render]") {
  for (const double share : {0.01, 0.3, 0.9}) {
    for (const bool is_stale : {false, true}) {
      for (const int delay : {0, 2}) {
        Setting setting{1000.0, delay};
        (is_stale ? setting.share_of_stale : setting.share_of_lost) = share;
        setting.budget = 0.05;
        for (const auto& [name, field] : hostile_fields) {
          for (const Pen& pen : {straight(2.0), to_and_fro(2.0, 100.0)}) {
            INFO(name << ", " << share << (is_stale ? " stale" : " lost") << ", delay " << delay);
            CHECK(max_given(setting, pen, field, hostile_seconds) <= 1.0 + 1e-9);
          }
        }
      }
    }
  }
}

namespace {

EnergyBudgetOptions budget_of(double joules, double mass, int delay = 0) {
  EnergyBudgetOptions options;
  options.budget = joules;
  options.mass = mass;
  options.observer.hand_speed = hand_speed;
  options.observer.max_gap = max_gap;
  options.observer.delay = delay;
  return options;
}

/// What remains when a budget is exhausted [N].
constexpr double brake = 0.1;
/// Less than anyone feels: with an overdrawn budget [N].
constexpr double nothing = 1e-6;

/// Of a budget, held for the brake: its work on a pen that turns and moves with it through the longest gap, at 1 kHz
/// [J].
constexpr double reserve = brake * hand_speed * (max_gap + 0.001);

/// F with F v t + (F t)^2 / (2 m) = E, for a hand and a pen of 45 g.
double payable(double energy, double time) {
  const double square = time * time / (2.0 * 0.045), linear = hand_speed * time;
  return (-linear + std::sqrt(linear * linear + 4.0 * square * energy)) / (2.0 * square);
}

}  // namespace

TEST_CASE("energy that the hand returns is added to the budget, up to its size", "[render]") {
  EnergyBudget budget(budget_of(0.1, 0.045), 0.001);
  double place = 0.0;
  const auto give = [&](double energy) {  // over 1 mm
    budget.sent({energy / 0.001, 0, 0});
    budget.next({place += 0.001, 0, 0}, {9.0, 0, 0});
  };
  const auto remains = [&](double energy) { return budget.max_force() == Approx(payable(energy - reserve, 0.017)); };
  budget.next({0, 0, 0}, {9.0, 0, 0});
  CHECK(remains(0.1));
  give(0.04);
  CHECK(remains(0.06));
  give(-0.03);
  CHECK(remains(0.09));
  give(-0.09);
  CHECK(remains(0.1));
  give(0.3);
  CHECK(budget.max_force() < nothing);  // overdrawn
  budget.restart();
  budget.next({0, 0, 0}, {9.0, 0, 0});
  CHECK(remains(0.1));
}

TEST_CASE("a force whose work no sample has shown is charged at the speed of a hand", "[render]") {
  EnergyBudget budget(budget_of(0.1, 0.045), 0.001);
  budget.next({0, 0, 0}, {5.0, 0, 0});
  for (int missed = 1; missed <= 3; ++missed) {
    budget.sent({1.0, 0, 0});
    budget.next(lost, {5.0, 0, 0});
    // The gap foreseen is shorter by what has passed of it.
    CHECK(budget.max_force() == Approx(payable(0.1 - reserve - 0.002 * missed, 0.017 - 0.001 * missed)));
  }
}

TEST_CASE("an infinite budget limits nothing", "[render]") {
  EnergyBudget budget({}, 0.001);
  budget.next({0, 0, 0}, {9.0, 0, 0});
  budget.sent({1e9, 0, 0});
  CHECK(budget.next({0.001, 0, 0}, {9.0, 0, 0}) == Vector3d(9.0, 0, 0));
  CHECK(budget.energy_given() == Approx(1e6));
  CHECK(budget.max_force() == infinity);
}

TEST_CASE(
    "a bare pen that leaves the hand at its full speed and is thrown through the longest gap gains the budget, "
    "less a reserve for the brake",
    "[render]") {
  for (const double mass : {0.02, 0.045, 0.075}) {
    for (const double joules : {0.01, 0.1}) {
      const double spent = joules - reserve;
      EnergyBudget budget(budget_of(joules, mass), 0.001);
      budget.next({0, 0, 0}, {0, 0, 0});
      budget.sent({0, 0, 0});
      const Vector3d force = budget.next({0.002, 0, 0}, {1000.0, 0, 0});
      budget.sent(force);
      // Newton's second law over the tick that was due and 16 missed ones.
      const double time = 0.017, way = hand_speed * time + 0.5 * force.x() / mass * time * time;
      CAPTURE(mass, joules);
      CHECK(force.x() * way == Approx(spent));
      CHECK(budget.max_force() == Approx(force.x()));
      budget.acted(force, 17);
      CHECK(budget.next({0.002 + way, 0, 0}, {1000.0, 0, 0}).x() <= 0.0);  // now it may only be braked
      CHECK(budget.energy_given() == Approx(spent));
    }
  }
}

TEST_CASE("a budget of 0.1 J leaves 2.3 N to a pen of 45 g at rest", "[render]") {
  // (0.017 s)^2 / (2 45 g) F^2 + 2 m/s 0.017 s F - (0.1 J - 3.4 mJ) = 0
  EnergyBudget budget(budget_of(0.1, 0.045), 0.001);
  budget.next({0, 0, 0}, {10.0, 0, 0});
  const double square = 0.017 * 0.017 / (2.0 * 0.045), linear = 2.0 * 0.017;
  const double root = (-linear + std::sqrt(linear * linear + 4.0 * square * (0.1 - 0.0034))) / (2.0 * square);
  CHECK(budget.max_force() == Approx(root));
  CHECK(root == Approx(2.33).epsilon(0.005));
}

TEST_CASE("a pen faster than a hand leaves as much force as a hand of its speed would", "[render]") {
  EnergyBudgetOptions options;
  options.budget = 0.1;
  options.observer.hand_speed = hand_speed;
  options.mass = 0.045;
  for (const double speed : {0.5, 2.0, 4.0, 8.0}) {
    EnergyBudget budget(options, 0.001);
    Vector3d force = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {  // nothing is wanted until it is known how fast the pen is
      force = budget.next({0.001 * speed * i, 0.0, 0.0}, {i < 2 ? 0.0 : 1e3, 0.0, 0.0});
      budget.sent(force);
    }
    const double time = 0.017, reserved = 0.1 * hand_speed * time;
    const double given = force.x() * std::max(speed, hand_speed) * time + std::pow(force.x() * time, 2) / (2.0 * 0.045);
    CHECK(given == Approx(0.1 - reserved));
  }
}

TEST_CASE("a nearly exhausted budget leaves a brake of 0.1 N, and less where samples are older than 10 ms", "[render]") {
  struct Case {
    double rate;
    int delay;
    double brake;
  };
  for (const Case& each : {Case{1000.0, 0, 0.1}, Case{1000.0, 5, 0.1}, Case{1000.0, 9, 0.1}, Case{1000.0, 15, 0.0625},
                           Case{500.0, 15, 0.03125}, Case{100.0, 0, 0.1}, Case{100.0, 4, 0.02}}) {
    const double period = 1.0 / each.rate;
    // As much as the brake may give before its work is known, and no guidance.
    const double joules = each.brake * hand_speed * (max_gap + (each.delay + 1) * period);
    EnergyBudget budget(budget_of(joules, infinity, each.delay), period);
    for (const double speed : {0.01, 0.99}) {
      budget.restart();
      Vector3d force(0, 0, 0);
      for (int i = 0; i < 3 + each.delay + static_cast<int>(0.3 / period); ++i) {  // until its average is the speed
        force = budget.next({0.6 * speed * period * i, 0, -0.8 * speed * period * i}, {5.0, 5.0, 5.0});
        budget.sent(force);
      }
      CAPTURE(each.rate, each.delay, speed);
      // Against the motion; half of it at 10 mm/s, so that a pen at rest is not shaken.
      const double size = each.brake * speed / (speed + 0.01);
      CHECK(force.isApprox(size * Vector3d(-0.6, 0.0, 0.8)));
      CHECK(budget.max_force() == Approx(each.brake));
    }
  }
}

TEST_CASE("the brake pays for what the steps of the encoder may hide of the work of a force that changes", "[render]") {
  // Of a true way x = q + e with |e| <= D / 2 along each axis, the sum of F (x(n + 1) - x(n)) differs from that of the
  // encoder's q by the sum of e (F(n) - F(n - 1)), summed by parts.
  EnergyBudgetOptions options = budget_of(reserve, infinity);
  options.encoder_step = 55e-6;
  EnergyBudget budget(options, 0.001);
  Vector3d last(0, 0, 0);
  double hidden = 0.0;
  for (const Vector3d& force : {Vector3d(0.04, 0, 0), Vector3d(0.04, 0, 0), Vector3d(-0.01, 0.02, 0), Vector3d(0, 0, 0.05)}) {
    budget.next({0, 0, 0}, {5.0, 0, 0});
    CHECK(budget.max_force() == Approx((reserve - hidden) / (hand_speed * (max_gap + 0.001))));
    budget.sent(force);
    hidden += 0.5 * options.encoder_step * (force - last).lpNorm<1>();
    last = force;
  }
  CHECK(hidden > 0.001 * reserve);
}

TEST_CASE("as much of the budget is held in reserve as the brake may give while it is held over a gap", "[render]") {
  for (const double gap : {0.0, 0.016, 0.1}) {
    for (const int delay : {0, 15}) {
      const double least = delay == 0 ? 0.1 : 0.0625;
      EnergyBudgetOptions options = budget_of(0.1, 0.045, delay);
      options.observer.max_gap = gap;
      EnergyBudget budget(options, 0.001);
      budget.next({0, 0, 0}, {100.0, 0, 0});
      const double time = std::max(gap, 0.001) + 0.001, force = budget.max_force();
      const double reserved = least * hand_speed * (gap + 0.001 * (delay + 1));
      CAPTURE(gap, delay);
      CHECK(force * hand_speed * time + force * force * time * time / (2.0 * 0.045) == Approx(0.1 - reserved));
    }
  }
}

TEST_CASE("with the budget of everything() guidance keeps at least 1 N on every shipped device, behind any delay",
          "[render]") {
  for (const Capabilities& profile : device_profiles()) {
    const RendererOptions renderer = RendererOptions::everything(profile);
    CHECK(renderer.energy.budget == 0.1);
    for (int delay = 0; delay <= 5; ++delay) {
      EnergyBudgetOptions options = budget_of(renderer.energy.budget, profile.apparent_mass, delay);
      options.observer.max_gap = renderer.energy.max_gap;
      EnergyBudget budget(options, 1.0 / profile.update_rate);
      double least = infinity;
      for (int i = 0; i < 200; ++i) {
        const Vector3d force = budget.next({0, 0, 0}, {10.0, 0, 0});
        budget.sent(force);
        if (i >= 100) least = std::min(least, force.norm());
      }
      CAPTURE(profile.name, delay);
      CHECK(least >= 1.0);
    }
  }
}

TEST_CASE("a force that was removed in a pause is charged for max_gap, however long the pause", "[render]") {
  for (const int missed : {30, 1000, 1'000'000'000}) {  // in bounded time
    EnergyBudget budget(budget_of(0.1, 0.045), 0.001);
    budget.next({0, 0, 0}, {0, 0, 0});
    budget.sent({1.0, 0, 0});
    budget.acted({0, 0, 0}, missed);
    budget.next({0, 0, 0}, {1.0, 0, 0});
    CAPTURE(missed);
    // At most 17 ticks of 1 N at 2 m/s.
    CHECK(budget.energy_given() <= 0.034 * (1.0 + 1e-9));
    CHECK(budget.energy_given() > 0.030);
    CHECK(budget.max_force() > 1.0);
  }
}

TEST_CASE("a pause counts like as many ticks without a sample, whatever the delay", "[render]") {
  for (const int delay : {0, 1, 5, 15}) {
    for (const int missed : {1, 3, 16, 40, 500}) {
      EnergyBudget at_once(budget_of(0.1, 0.045, delay), 0.001), one_by_one = at_once;
      double place = 0.0;
      for (EnergyBudget* each : {&at_once, &one_by_one}) {
        place = 0.0;
        for (int i = 0; i < 20; ++i) {
          each->next({place += 1e-4, 0, 0}, {0.0, 0, 0});
          each->sent({0.4 + 0.01 * i, 0, 0});
        }
      }
      const Vector3d held(0.4 + 0.19, 0, 0);
      at_once.acted(held, missed + 1);
      for (int i = 0; i < missed; ++i) {
        one_by_one.next(lost, held);
        one_by_one.sent(held);
      }
      CAPTURE(delay, missed);
      for (EnergyBudget* each : {&at_once, &one_by_one}) {
        each->next(lost, held);
        each->sent(held);
      }
      CHECK(at_once.max_force() == Approx(one_by_one.max_force()).epsilon(1e-12));
      for (EnergyBudget* each : {&at_once, &one_by_one}) each->next({place + 0.003, 0, 0}, {0.0, 0, 0});
      CHECK(at_once.energy_given() == Approx(one_by_one.energy_given()).epsilon(1e-12));
      CHECK(at_once.max_force() == Approx(one_by_one.max_force()).epsilon(1e-12));
    }
  }
}

TEST_CASE("a gap longer than foreseen gives at most |F| v t, and until that is repaid nothing more", "[render]") {
  for (const int missed : {50, 200}) {
    EnergyBudget budget(budget_of(0.1, 0.045), 0.001);
    const auto force_at = [&](double place, const Vector3d& acted, int ticks) {
      budget.acted(acted, ticks);
      const Vector3d force = budget.next({place, 0, 0}, {3.0, 0, 0});
      budget.sent(force);
      return force;
    };
    budget.next({0, 0, 0}, {3.0, 0, 0});
    budget.sent({0, 0, 0});
    Vector3d force = force_at(0.0, {0, 0, 0}, 1);
    const double held = force.x(), way = hand_speed * 0.001 * (missed + 1);
    REQUIRE(held > 1.0);
    force = force_at(way, force, missed + 1);
    const double overdrawn = held * way;
    CAPTURE(missed, overdrawn);
    REQUIRE(overdrawn > 0.1);
    CHECK(budget.energy_given() == Approx(overdrawn));
    // The hand swings the pen about there: the force wanted would feed the swing, the brake does not.
    double given = overdrawn, most = given, place = way, strongest = 0.0;
    for (int i = 1; i <= 1000; ++i) {
      const double next = way + 0.04 * std::sin(0.05 * i);
      given += force.x() * (next - place);
      most = std::max(most, given);
      place = next;
      force = force_at(place, force, 1);
      strongest = std::max(strongest, force.norm());
    }
    CHECK(most <= overdrawn * (1.0 + 1e-9));
    CHECK(given < overdrawn - 0.3 * brake * 1.27);  // of the second, it needs two thirds to earn its reserve
    CHECK(strongest <= brake * (1.0 + 1e-9));
    CHECK(budget.energy_given() == Approx(given));
  }
}

TEST_CASE("what a gap has overdrawn is repaid by the hand, then the force returns", "[render]") {
  EnergyBudget budget(budget_of(0.1, 0.045), 0.001);
  budget.next({0, 0, 0}, {2.0, 0, 0});
  budget.sent({2.0, 0, 0});
  budget.acted({2.0, 0, 0}, 100);
  budget.next({0.1, 0, 0}, {2.0, 0, 0});
  CHECK(budget.energy_given() == Approx(0.2));
  CHECK(budget.max_force() < nothing);
  // A force elsewhere at work takes energy in: 2 N against a pen pushed back.
  double place = 0.1;
  for (int i = 0; i < 100; ++i) {
    budget.sent({2.0, 0, 0});
    place -= 0.001;
    budget.next({place, 0, 0}, {2.0, 0, 0});
    const double left = -0.1 + 2.0 * (0.1 - place);
    CHECK(budget.energy_given() == Approx(0.1 - left).margin(1e-12));
    CHECK((budget.max_force() > brake) == (left > 0.0069));  // the reserve, and as much for a force of 0.1 N
  }
  CHECK(budget.max_force() > 2.0);
}

TEST_CASE("the force that really acted is charged, not the one sent", "[render]") {
  for (const int delay : {0, 3}) {
    EnergyBudget budget(budget_of(10.0, 0.045, delay), 0.001);
    Sequence random(21);
    std::vector<Vector3d> places = {Vector3d(0, 0, 0)};
    std::vector<double> work = {0.0};  // done until each tick
    Vector3d acted(0, 0, 0);
    double max_error = 0.0;
    for (int i = 0; i < 500; ++i) {
      if (i > 0) budget.acted(acted, 1);
      const std::size_t seen = static_cast<std::size_t>(std::max(0, i - delay));
      budget.next(places[seen], random_vector(random, 3.0));
      max_error = std::max(max_error, std::abs(budget.energy_given() - work[seen]));
      const Vector3d sent = random_vector(random, 3.0);
      budget.sent(sent);
      acted = random.next() * sent;
      places.push_back(places.back() + random_vector(random, 1e-3));
      work.push_back(work.back() + acted.dot(places[places.size() - 1] - places[places.size() - 2]));
    }
    CAPTURE(delay);
    CHECK(std::abs(work.back()) > 1e-3);
    CHECK(max_error < 1e-12);
  }
}

TEST_CASE("a force that changes within a period is charged by its share of the time", "[render]") {
  for (const int delay : {0, 3}) {
    EnergyBudget budget(budget_of(10.0, 0.045, delay), 0.001);
    Sequence random(22);
    std::vector<Vector3d> places = {Vector3d(0, 0, 0)};
    std::vector<double> work = {0.0};  // done until each tick
    Vector3d acted(0, 0, 0);
    double share = 0.0, max_error = 0.0;
    for (int i = 0; i < 500; ++i) {
      if (i > 0) budget.acted(acted, 1, share * 0.001);
      const std::size_t seen = static_cast<std::size_t>(std::max(0, i - delay));
      budget.next(places[seen], random_vector(random, 3.0));
      max_error = std::max(max_error, std::abs(budget.energy_given() - work[seen]));
      const Vector3d sent = random_vector(random, 3.0), step = random_vector(random, 1e-3);
      budget.sent(sent);
      share = i % 10 == 0 ? 0.0 : random.next();  // the law needs this part of the period, in which the pen moves on
      work.push_back(work.back() + share * acted.dot(step) + (1.0 - share) * sent.dot(step));
      places.push_back(places.back() + step);
      acted = sent;
    }
    CAPTURE(delay);
    CHECK(std::abs(work.back()) > 1e-3);
    CHECK(max_error < 1e-12);
  }
}

TEST_CASE("over a gap in which the force is held, the work observed is exact", "[render]") {
  EnergyBudget budget(budget_of(1.0, 0.045), 0.001);
  budget.next({0, 0, 0}, {1.0, 2.0, 0.5});
  budget.sent({1.0, 2.0, 0.5});
  budget.acted({1.0, 2.0, 0.5}, 12);
  budget.next({0.003, -0.001, 0.002}, {0, 0, 0});
  CHECK(budget.energy_given() == Approx(1.0 * 0.003 - 2.0 * 0.001 + 0.5 * 0.002));
}

TEST_CASE("where the budget limits the force, a share of it is left to damping, and its length is kept", "[render]") {
  EnergyBudget budget(budget_of(0.1, 0.045), 0.001);
  const Vector3d spring(8.0, 0.0, 0.0), viscous(0.0, -1.0, 0.0);
  const Vector3d force = budget.next({0, 0, 0}, spring + viscous, viscous);
  const double most = budget.max_force();
  CHECK(force.norm() <= most * (1.0 + 1e-12));
  CHECK(force.y() == Approx(-0.15 * most));
  CHECK(force.x() == Approx(0.85 * most));
  // As much of it as there is, where that is less.
  const Vector3d weak(0.0, -0.01, 0.0);
  CHECK(budget.next({0, 0, 0}, spring + weak, weak).y() == Approx(-0.01));
}

TEST_CASE("without a budget the desired force is unchanged", "[render]") {
  EnergyBudget budget({}, 0.001);
  Sequence random(9);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d wanted = random_vector(random, 10.0);
    CHECK(budget.next(random_vector(random, 0.01), wanted) == wanted);
    budget.sent(random_vector(random, 3.0));
  }
  CHECK(std::isinf(budget.max_force()));
}

TEST_CASE("a lost sample leaves every value finite", "[render]") {
  EnergyBudget budget({.budget = 0.01}, 0.001);
  Sequence random(10);
  bool finite = true;
  for (int i = 0; i < 2000; ++i) {
    Vector3d position = random_vector(random, 0.001);
    if (i % 5 < 2) position[i % 3] = i % 2 ? not_a_number : infinity;
    const Vector3d force = budget.next(position, random_vector(random, 3.0));
    finite = finite && force.allFinite() && std::isfinite(budget.energy_given());
    budget.sent(force);
  }
  CHECK(finite);
}

TEST_CASE("samples lost before the first good one are not charged", "[render]") {
  EnergyBudgetOptions options;
  options.budget = 0.01;
  EnergyBudget budget(options, 0.001);
  for (int i = 0; i < 10; ++i) {
    budget.next(lost, {0, 0, 0});
    budget.sent({0, 0, 0});
  }
  budget.next({0.1, 0.2, 0.3}, {0, 0, 0});
  CHECK(budget.energy_given() == 0.0);
}

TEST_CASE("a restarted energy budget behaves like a new one", "[render]") {
  for (const double joules : {0.0, 0.01}) {  // with none left, the brake acts from the first tick
    const EnergyBudgetOptions options{.budget = joules, .observer = {.delay = 3}};
    EnergyBudget used(options, 0.001);
    Sequence random(11);
    for (int i = 0; i < 102; ++i) {
      used.next(i % 7 ? random_vector(random, 0.001) : lost, random_vector(random, 3.0));
      used.sent(random_vector(random, 3.0));
    }
    if (joules > 0.0) {
      used.next(lost, {0, 0, 0});
      used.sent({1.0, 0, 0});
    }
    used.restart();
    EnergyBudget fresh(options, 0.001);
    for (int i = 0; i < 100; ++i) {
      const Vector3d position = random_vector(random, 0.01), wanted = random_vector(random, 3.0);
      const Vector3d force = fresh.next(position, wanted);
      CHECK(used.next(position, wanted) == force);
      CHECK(used.max_force() == fresh.max_force());
      fresh.sent(force);
      used.sent(force);
    }
  }
}

TEST_CASE("an option of the energy budget out of range is named with its value", "[render]") {
  const auto complaint = [](const EnergyBudgetOptions& options, double period) -> std::string {
    try {
      EnergyBudget(options, period);
    } catch (const ValueError& error) {
      return error.what();
    }
    return "";
  };
  const auto names = [&](const EnergyBudgetOptions& options, double period, const std::string& text) {
    const std::string found = complaint(options, period);
    INFO(found << " should have " << text);
    CHECK(found.find("energy budget: " + text) == 0);
  };
  CHECK(complaint({}, 0.001).empty());
  for (const auto& [value, text] : {std::pair{-0.5, "-0.5"}, {not_a_number, "nan"}, {-infinity, "-inf"}}) {
    names({.budget = value}, 0.001, std::string("budget = ") + text);
    names({.mass = value}, 0.001, std::string("mass = ") + text);
    names({.observer = {.hand_speed = value}}, 0.001, std::string("hand_speed = ") + text);
    names({.observer = {.max_gap = value}}, 0.001, std::string("max_gap = ") + text);
    names({.observer = {.scale = value}}, 0.001, std::string("scale = ") + text);
    names({}, value, std::string("period = ") + text);
  }
  names({.mass = 0.0}, 0.001, "mass = 0");
  names({.observer = {.hand_speed = 0.0}}, 0.001, "hand_speed = 0");
  names({.observer = {.max_gap = infinity}}, 0.001, "max_gap = inf");
  names({}, 0.0, "period = 0");
  names({}, infinity, "period = inf");
  names({.observer = {.delay = -1}}, 0.001, "delay = -1");
  names({.observer = {.delay = 16}}, 0.001, "delay = 16");
  names({.observer = {.delay = std::numeric_limits<int>::max()}}, 0.001, "delay = 2147483647");
}

TEST_CASE("the energy budget does not allocate", "[render]") {
  EnergyBudget budget({.budget = 0.01, .observer = {.delay = 2}}, 0.001);
  Sequence random(12);
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 10'000; ++i) {
    budget.sent(budget.next(i % 11 ? random_vector(random, 0.01) : lost, random_vector(random, 3.0)));
  }
  budget.restart();
  CHECK(calligraphy_test::allocations() == before);
}
