// session_soak: days of writing in virtual time, with random faults, while every guarantee of the loop is checked.
// Exit codes: 0 all kept, 1 one broken, 2 usage.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <calligraphy/calligraphy.hpp>
#include <calligraphy/devices/detail/flush_denormals.hpp>

#include "allocation_counter.hpp"
#include "faults.hpp"
#include "restless_hand.hpp"
#include "tools/options.hpp"
#include "tools/progress.hpp"

namespace calligraphy_test {
namespace {

using namespace calligraphy;
using Eigen::Vector3d;

struct Options {
  std::uint64_t ticks = 1'000'000;
  std::uint64_t seed = 1;
  std::string composition = "everything";
  std::string device = "omni";
  bool faults = true;
};

struct Watched {
  std::uint64_t faults = 0, bad_ticks = 0, not_finite = 0, above_peak = 0, steps_too_large = 0, strokes = 0,
                allocations = 0;
  std::uint64_t felt_late = 0;  ///< ticks of the last tenth with a force above 0.1 N
  double max_force = 0.0, max_step = 0.0;
  double given = 0.0, max_given = 0.0, min_given = 0.0;  ///< net work of the force actually applied [J]
  bool page_was_too_short = false;
};

RendererOptions renderer_options(const Options& options, const Capabilities& capabilities) {
  return options.composition == "everything" ? RendererOptions::everything(capabilities)
                                             : RendererOptions::for_device(capabilities);
}

Watched run(const Options& options) {
  const Capabilities& profile = device_profile(options.device);
  const RendererOptions chosen = renderer_options(options, profile);
  // More characters than the hand can write: restarting the page would start a new energy budget.
  const auto characters = static_cast<int>(options.ticks / 1500 + 2);
  HapticRenderer renderer(soak_page(characters), upright_page(0.145, 0.08), profile, chosen);
  RestlessHand hand(renderer, options.seed);
  Faults faults(options.seed + 1);
  SimulatedDevice device(profile, {0.1, 3.0, 300.0}, renderer.mapping().to_device(hand.place()));
  const double period = 1.0 / chosen.servo_rate;
  const double peak = profile.peak_force * (1.0 + 1e-12);
  const double step_limit = renderer.max_force_step() * (1.0 + 1e-9);

  tools::Progress progress;
  const FlushDenormals as_a_servo_thread;
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
      progress.show(static_cast<double>(i + 1) / static_cast<double>(options.ticks));
    }
  }
  watched.allocations = std::max<std::uint64_t>(watched.allocations, allocations() - allocated);
  watched.faults = faults.count();
  return watched;
}

bool kept(const char* promise, bool is_kept) {
  fmt::print("  {:<60} {}\n", promise, is_kept ? "kept" : "BROKEN");
  return is_kept;
}

int report(const Options& options, const Watched& watched) {
  const Capabilities& capabilities = device_profile(options.device);
  const RendererOptions chosen = renderer_options(options, capabilities);
  fmt::print("{} ticks ({:.1f} h at {} Hz), composition {}, device {}, seed {}\n", options.ticks,
             static_cast<double>(options.ticks) / chosen.servo_rate / 3600.0, chosen.servo_rate, options.composition,
             options.device, options.seed);
  fmt::print("  {} strokes written, {} faults in {} ticks\n", watched.strokes, watched.faults, watched.bad_ticks);
  fmt::print("  maximum force {:.3f} N, maximum step {:.3f} N\n", watched.max_force, watched.max_step);
  fmt::print("  net energy delivered to the hand: {:.4f} J at the end, {:.4f} J at most\n", watched.given,
             watched.max_given);
  bool all = kept("no allocations", watched.allocations == 0);
  all &= kept("every force is finite", watched.not_finite == 0);
  all &= kept("no force above the peak", watched.above_peak == 0);
  all &= kept("no force step above the limit", watched.steps_too_large == 0);
  if (std::isfinite(chosen.energy_budget)) {
    all &= kept("net energy delivered never exceeds the budget", watched.max_given <= chosen.energy_budget);
  }
  all &= kept("forces are still rendered in the last tenth", watched.felt_late > options.ticks / 200);
  all &= kept("strokes are written", watched.strokes > options.ticks / 20'000 && !watched.page_was_too_short);
  return all ? 0 : 1;
}

int parse_and_run(int argc, char** argv) {
  Options options;
  CLI::App program("Days of writing in virtual time, with random faults.", "session_soak");
  program.add_option("--ticks", options.ticks, "Number of ticks; 86400000 are 24 h at 1 kHz")
      ->check(tools::integer(1, 10'000'000'000ull));
  program.add_option("--seed", options.seed, "Seed of the hand and of the faults");
  program.add_option("--composition", options.composition, "Renderer options: default or everything")
      ->check(CLI::IsMember({"default", "everything"}));
  program.add_option("--device", options.device, "Profile of the simulated device");
  program.add_flag("!--no-faults", options.faults, "Inject no faults");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  return report(options, run(options));
}

}  // namespace
}  // namespace calligraphy_test

int main(int argc, char** argv) {
  try {
    return calligraphy_test::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "session_soak: %s\n", error.what());
    return 1;
  }
}
