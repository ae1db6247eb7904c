#include "soak.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/calligraphy.hpp>
#include <calligraphy/devices/detail/flush_denormals.hpp>

#include "allocation_counter.hpp"
#include "faults.hpp"
#include "restless_hand.hpp"

namespace calligraphy_test {

using namespace calligraphy;
using Eigen::Vector3d;

RendererOptions SoakOptions::renderer_options() const {
  const Capabilities& profile = device_profile(device);
  return composition == "everything" ? RendererOptions::everything(profile) : RendererOptions::for_device(profile);
}

Watched soak(const SoakOptions& options, const std::function<void(double)>& progress) {
  const Capabilities& profile = device_profile(options.device);
  const RendererOptions chosen = options.renderer_options();
  // More characters than the hand can write: restarting the page would start a new energy budget.
  const auto characters = static_cast<int>(options.ticks / 1500 + 2);
  HapticRenderer renderer(soak_page(characters), upright_page(0.145, 0.08), profile, chosen);
  RestlessHand hand(renderer, options.seed);
  Faults faults(options.seed + 1);
  SimulatedDevice device(profile, {0.1, 3.0, 300.0}, renderer.mapping().to_device(hand.place()));
  const double period = 1.0 / renderer.options().servo_rate;
  const double peak = profile.peak_force * (1.0 + 1e-12);
  const double step_limit = renderer.max_force_step() * (1.0 + 1e-9);

  const detail::FlushDenormals as_a_servo_thread;
  Watched watched;
  Vector3d last = Vector3d::Zero();
  const std::size_t allocated = allocations();
  for (std::uint64_t i = 0; i < options.ticks; ++i) {
    const DeviceState state = device.read();
    const HapticTick& tick = renderer.update(options.faults ? faults.tamper(state) : state);
    const double size = tick.force.norm(), step = (tick.force - last).norm();
    watched.not_finite += !tick.force.allFinite();
    watched.above_peak += size > peak;
    watched.steps_too_large += step > step_limit;
    watched.max_force = std::max(watched.max_force, size);
    watched.max_step = std::max(watched.max_step, step);
    watched.felt_late += i >= options.ticks / 10 * 9 && size > 0.1;
    watched.bad_ticks += tick.status != TickStatus::ok;
    watched.strokes += has_event(tick.events, TickEvent::stroke_finished);
    last = tick.force;

    device.write(faults.force_is_lost() ? Vector3d(0.0, 0.0, 0.0) : tick.force);
    device.set_intention(hand.next(tick, period));
    const Vector3d before = device.true_position();
    device.advance(period);
    watched.given += device.applied_force().dot(device.true_position() - before);
    watched.max_given = std::max(watched.max_given, watched.given);
    watched.min_given = std::min(watched.min_given, watched.given);
    watched.page_was_too_short = tick.character >= characters;
    if (i % 1'000'000 == 999'999) {
      watched.allocations = allocations() - allocated;
      if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(options.ticks));
    }
  }
  watched.allocations = std::max<std::uint64_t>(watched.allocations, allocations() - allocated);
  watched.faults = faults.count();
  return watched;
}

std::vector<Guarantee> guarantees(const SoakOptions& options, const Watched& watched) {
  const double budget = options.renderer_options().energy.budget;
  std::vector<Guarantee> all = {{"no allocations", watched.allocations == 0},
                                {"every force is finite", watched.not_finite == 0},
                                {"no force above the peak", watched.above_peak == 0},
                                {"no force step above the limit", watched.steps_too_large == 0}};
  if (std::isfinite(budget)) {
    all.push_back({"net energy delivered never exceeds the budget", watched.max_given <= budget});
  }
  all.push_back({"forces are still rendered in the last tenth", watched.felt_late > options.ticks / 200});
  all.push_back({"strokes are written", watched.strokes > options.ticks / 20'000 && !watched.page_was_too_short});
  return all;
}

}  // namespace calligraphy_test
