#include <calligraphy/experiments/stability_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/experiments/passivity_controller.hpp>

#include "base/parallel.hpp"
#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr double at_rest = 1e-7;         ///< from peak to peak, a hundredth of a coarse encoder's step [m]
constexpr double shrunk = 0.95;          ///< in half of the time
constexpr double still = 0.99;           ///< in the last quarter: one that settles to a smaller swing is still by then
constexpr double out_of_reach = 1.0;     ///< no pen is there [m]
constexpr int windows = 16;              ///< of the time, in each of which the swing is measured
constexpr double precision = 1.02;       ///< of the largest stable stiffness
constexpr Eigen::Index wall_normal = 2;  ///< the axis along which the pen meets the wall

void validate(const WallContact& contact) {
  require_above_zero("push", contact.push, "N");
  require(contact.height >= 0.0 && contact.height < out_of_reach, "height", contact.height, "m", "from 0 to below 1");
  require_above_zero("seconds", contact.seconds, "s", 1000.0);
  require_within("lost", contact.lost, "", 0.0, 0.9);
  require_within("reordered", contact.reordered, "", 0.0, 1.0);
}

Capabilities pushed(Capabilities device) {
  // The push is the hand's: it is neither limited nor rounded.
  device.peak_force = std::numeric_limits<double>::infinity();
  device.force_step = 0.0;
  return device;
}

/// Delivers samples over a bad line, which loses or reorders some.
class Line {
 public:
  Line(const WallContact& contact, double position)
      : lost_(contact.lost), reordered_(contact.reordered), last_(position), waiting_(position) {}

  double receive(double position) {
    if (lost_ > 0.0 && random_.next() < lost_) return last_;
    if (std::exchange(is_waiting_, false)) return last_ = waiting_;  // the older of the two, one tick late
    if (reordered_ > 0.0 && has_last_ && random_.next() < reordered_) {
      // This one arrives after the next: until then the last one is used again.
      is_waiting_ = true;
      waiting_ = position;
      return last_;
    }
    has_last_ = true;
    return last_ = position;
  }

 private:
  double lost_, reordered_;
  double last_, waiting_;
  bool is_waiting_ = false, has_last_ = false;
  Random random_{1};
};

/// The force of the wall, which pushes but never pulls.
class Wall {
 public:
  Wall(const SampledLoop& loop, double stiffness, double position)
      : stiffness_(stiffness), damping_(loop.wall_damping * loop.rate), before_(position) {}

  double force(double position) {
    const double step = position - std::exchange(before_, position);
    return position < 0.0 ? std::max(0.0, -stiffness_ * position - damping_ * step) : 0.0;
  }

 private:
  double stiffness_, damping_, before_;
};

/// Whether swings shrink from window to window, so that mere variation does not pass, by enough overall and to the end.
bool shrinks(std::span<const double> swings) {
  const bool falls = std::is_sorted(swings.rbegin(), swings.rend(), std::less_equal<>());
  return falls && swings.back() < shrunk * swings.front() && swings.back() < still * swings[swings.size() / 2];
}

PassivityController controller_for(const SampledLoop& loop, bool controlled) {
  PassivityOptions options;
  if (controlled) {
    options.delay = std::min(loop.device.sample_delay, PassivityController::max_delay);
    options.max_damping = injectable_damping(loop);
  }
  return {options, 1.0 / loop.rate};
}

}  // namespace

WallContactResult simulate_wall_contact(const SampledLoop& loop, double stiffness, const WallContact& contact) {
  validate(loop);
  validate(contact);
  require(loop.device.peak_force > 0.0, "peak force of the device", loop.device.peak_force, "N", "above 0");
  require_not_negative("stiffness", stiffness, "N/m");
  const double period = 1.0 / loop.rate;
  SimulatedDevice device(pushed(loop.device), loop.grip, {0.0, 0.0, contact.height});
  device.set_intention({});
  Line line(contact, contact.height);
  Wall wall(loop, stiffness, contact.height);
  PassivityController controller = controller_for(loop, contact.controlled);
  const int ticks = std::max(1, static_cast<int>(contact.seconds * loop.rate / windows));
  std::array<double, windows> swings{};
  WallContactResult outcome;
  for (double& swing : swings) {
    double low = out_of_reach, high = -out_of_reach;
    outcome.last_force = 0.0;
    for (int tick = 0; tick < ticks; ++tick) {
      const double position = line.receive(device.read().position[wall_normal]);
      Eigen::Vector3d wanted(0.0, 0.0, wall.force(position));
      if (contact.controlled) wanted = controller.next({0.0, 0.0, position}, wanted);
      const double sent = output_force(loop.device, {0.0, 0.0, wanted[wall_normal]})[wall_normal];
      controller.sent({0.0, 0.0, sent});
      device.write({0.0, 0.0, sent - contact.push});
      device.advance(period);
      outcome.last_force = std::max(outcome.last_force, std::abs(sent));
      low = std::min(low, device.true_position()[wall_normal]);
      high = std::max(high, device.true_position()[wall_normal]);
    }
    outcome.max_force = std::max(outcome.max_force, outcome.last_force);
    outcome.peak_to_peak = swing = high - low;
    if (swing < at_rest) {
      outcome.stable = true;
      return outcome;
    }
    if (!(low > -out_of_reach && high < out_of_reach)) return outcome;
  }
  outcome.stable = shrinks(std::span(swings).subspan(windows / 2 - 1));
  return outcome;
}

namespace {

std::vector<double> stiffnesses_of(const StabilityMapOptions& options) {
  std::vector<double> stiffnesses;
  const double steps = options.per_decade * std::log10(options.max_stiffness / options.min_stiffness);
  for (int i = 0; i <= static_cast<int>(std::lround(steps)); ++i) {
    stiffnesses.push_back(options.min_stiffness * std::pow(10.0, static_cast<double>(i) / options.per_decade));
  }
  return stiffnesses;
}

using Test = std::function<bool(const WallContactResult&)>;

/// Bisects, on a logarithmic scale, between the last stiffness that passes and the first that does not.
double largest(const StabilityLine& line, const std::vector<WallContactResult>& outcomes, const StabilityMap& map,
               const WallContact& contact, const Test& passes) {
  const auto first = std::find_if_not(outcomes.begin(), outcomes.end(), passes) - outcomes.begin();
  if (first == 0) return 0.0;
  double good = map.stiffnesses[static_cast<std::size_t>(first) - 1];
  if (static_cast<std::size_t>(first) == outcomes.size()) return good;
  double bad = map.stiffnesses[static_cast<std::size_t>(first)];
  while (bad > precision * good) {
    const double middle = std::sqrt(good * bad);
    (passes(simulate_wall_contact(line.loop, middle, contact)) ? good : bad) = middle;
  }
  return good;
}

/// The outcome for a pen at each stiffness of a line, without and with passivity control.
using Trials = std::array<std::vector<WallContactResult>, 2>;

/// The work is split into many short pieces, so that a caller can cancel it soon.
void try_all(const std::vector<StabilityLine*>& lines, const StabilityMap& map,
             const std::function<void(double)>& progress, std::vector<Trials>& trials) {
  const std::size_t stiffnesses = map.stiffnesses.size();
  for (Trials& each : trials) each.fill(std::vector<WallContactResult>(stiffnesses));
  parallel_for(2 * stiffnesses * lines.size(), 0, progress, [&](std::size_t i) {
    const std::size_t line = i / (2 * stiffnesses), controlled = i / stiffnesses % 2, stiffness = i % stiffnesses;
    WallContact contact = map.contact;
    contact.controlled = controlled == 1;
    trials[line][controlled][stiffness] = simulate_wall_contact(lines[line]->loop, map.stiffnesses[stiffness], contact);
  });
}

void find_max_stable(const std::vector<StabilityLine*>& lines, const StabilityMap& map,
                     const std::function<void(double)>& progress, const std::vector<Trials>& trials) {
  const Test comes_to_rest = [](const WallContactResult& outcome) { return outcome.stable; };
  const Test within_peak = [&map](const WallContactResult& outcome) {
    return outcome.stable && outcome.max_force < map.device.peak_force;
  };
  WallContact free = map.contact, controlled = map.contact;
  free.controlled = false;
  controlled.controlled = true;
  parallel_for(3 * lines.size(), 0, progress, [&](std::size_t i) {
    StabilityLine& line = *lines[i / 3];
    const auto& [without, with] = trials[i / 3];
    if (i % 3 == 0) line.max_stable = largest(line, without, map, free, comes_to_rest);
    if (i % 3 == 1) line.controlled_max_stable = largest(line, with, map, controlled, comes_to_rest);
    if (i % 3 == 2) line.controlled_max_stable_below_peak = largest(line, with, map, controlled, within_peak);
  });
}

void fill(const std::vector<StabilityLine*>& lines, const StabilityMap& map,
          const std::function<void(double)>& progress) {
  constexpr double share_of_trials = 0.8;  // of the time, about
  const auto part = [&progress](double from, double share) -> std::function<void(double)> {
    if (!progress) return nullptr;
    return [&progress, from, share](double done) { progress(from + share * done); };
  };
  std::vector<Trials> trials(lines.size());
  try_all(lines, map, part(0.0, share_of_trials), trials);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    StabilityLine& line = *lines[i];
    const StiffnessAdvice advice = advise_stiffness(line.loop);
    line.passive = advice.passive.value;
    line.quantised = advice.quantised.value;
    line.stable = advice.stable.value;
    line.approximate = advice.approximate.value;
    for (const WallContactResult& outcome : trials[i][0]) line.stable_at.push_back(outcome.stable);
    for (const WallContactResult& outcome : trials[i][1]) line.controlled_stable_at.push_back(outcome.stable);
  }
  find_max_stable(lines, map, part(share_of_trials, 1.0 - share_of_trials), trials);
}

template <typename Value, typename Change>
StabilitySweep sweep(const Capabilities& device, const char* name, const char* label, const std::vector<Value>& values,
                     double in_unit, Change change) {
  StabilitySweep result{name, label, {}, {}};
  for (const Value& value : values) {
    StabilityLine line;
    line.loop.device = device;
    change(line.loop, value);
    result.values.push_back((Message() << static_cast<double>(value) * in_unit).str());
    result.lines.push_back(std::move(line));
  }
  return result;
}

StabilitySweep grip_sweep(const Capabilities& device) {
  const std::pair<const char*, GripImpedance> grips[] = {{"none", {0.0, 0.0, 0.0}},
                                                         {"soft", {0.05, 1.0, 100.0}},
                                                         {"normal", {0.1, 3.0, 300.0}},
                                                         {"firm", {0.15, 5.0, 500.0}}};
  StabilitySweep result{"grip", "grip", {}, {}};
  for (const auto& [name, grip] : grips) {
    StabilityLine line;
    line.loop.device = device;
    line.loop.grip = grip;
    result.values.push_back(name);
    result.lines.push_back(std::move(line));
  }
  return result;
}

std::vector<StabilitySweep> sweeps_of(const Capabilities& device, double friction) {
  using Values = std::vector<double>;
  constexpr double kilohertz = 1e-3, micrometres = 1e6;
  return {
      sweep(device, "damping", "damping of the device b [N s/m]", Values{0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0}, 1.0,
            [](SampledLoop& loop, double value) { loop.device.viscous_friction = value; }),
      sweep(device, "rate", "servo rate [kHz]", Values{100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0, 20000.0},
            kilohertz, [](SampledLoop& loop, double value) { loop.rate = value; }),
      sweep(device, "delay", "delay [ticks]", std::vector<int>{0, 1, 2, 3, 4, 5}, 1.0,
            [](SampledLoop& loop, int value) { loop.device.sample_delay = value; }),
      sweep(device, "wall_damping", "damping of the wall B [N s/m]",
            Values{0.0, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0}, 1.0,
            [](SampledLoop& loop, double value) { loop.wall_damping = value; }),
      sweep(device, "encoder_step", "encoder step [um], with dry friction", Values{0.0, 1e-6, 23e-6, 55e-6, 200e-6},
            micrometres,
            [friction](SampledLoop& loop, double value) {
              loop.device.encoder_step = value;
              loop.device.coulomb_friction = friction;
            }),
      grip_sweep(device)};
}

std::vector<StabilityLine> grid_of(const StabilityMapOptions& options) {
  std::vector<StabilityLine> grid;
  for (const GripImpedance& grip : options.grips) {
    for (const double wall_damping : options.wall_dampings) {
      for (const double encoder_step : options.encoder_steps) {
        for (const int delay : options.delays) {
          for (const double rate : options.rates) {
            for (const double damping : options.dampings) {
              StabilityLine line;
              line.loop.device = options.device;
              line.loop.device.viscous_friction = damping;
              line.loop.rate = rate;
              line.loop.device.sample_delay = delay;
              line.loop.device.encoder_step = encoder_step;
              line.loop.device.coulomb_friction = encoder_step > 0.0 ? options.coulomb_friction : 0.0;
              line.loop.wall_damping = wall_damping;
              line.loop.grip = grip;
              grid.push_back(std::move(line));
            }
          }
        }
      }
    }
  }
  return grid;
}

}  // namespace

Capabilities StabilityMapOptions::point_mass() {
  Capabilities device;
  device.apparent_mass = 0.045;
  device.viscous_friction = 0.1;
  device.peak_force = 7.9;
  return device;
}

StabilityMap stability_map(const StabilityMapOptions& options) {
  validate(options.contact);
  require_within("per_decade", options.per_decade, "", 1, 100);
  require_above_zero("min_stiffness", options.min_stiffness, "N/m");
  require(std::isfinite(options.max_stiffness) && options.max_stiffness > options.min_stiffness, "max_stiffness",
          options.max_stiffness, "N/m", "finite and above min_stiffness");
  require(options.device.peak_force > 0.0, "peak force of the device", options.device.peak_force, "N", "above 0");
  StabilityMap map;
  map.contact = options.contact;
  map.device = options.device;
  map.stiffnesses = stiffnesses_of(options);
  if (options.with_sweeps) map.sweeps = sweeps_of(options.device, options.coulomb_friction);
  if (options.with_grid) map.grid = grid_of(options);
  std::vector<StabilityLine*> lines;
  for (StabilitySweep& sweep : map.sweeps) {
    for (StabilityLine& line : sweep.lines) lines.push_back(&line);
  }
  for (StabilityLine& line : map.grid) lines.push_back(&line);
  for (const StabilityLine* line : lines) validate(line->loop);
  fill(lines, map, options.progress);
  return map;
}

}  // namespace calligraphy
