// calligraphy stability: how stiff a wall a device can render, for one loop or as a map.
#include <array>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/stability_map.hpp>
#include <calligraphy/pictures/plot.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_directory.hpp"
#include "progress.hpp"
#include "stability_report.hpp"

namespace calligraphy::tools {
namespace {

constexpr double largest = 1e9;  ///< of any number that is typed; the library says what is physical

struct StabilityArguments {
  std::optional<std::string> device, grip, out;
  std::optional<double> mass, damping, rate, wall_damping, friction, encoder_step;
  std::optional<int> delay;
  bool quick = false;
  bool json = false;
};

Hand grip_of(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, Hand>, 3> named = {
      {{"soft", {0.05, 1.0, 100.0}}, {"normal", {0.1, 3.0, 300.0}}, {"firm", {0.15, 5.0, 500.0}}}};
  for (const auto& [name, hand] : named) {
    if (word == name) return hand;
  }
  std::array<double, 3> values{};
  const char* at = word.data();
  const char* const end = at + word.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [rest, failure] = std::from_chars(at, end, values[i]);
    const bool separated = i + 1 < values.size() ? rest != end && *rest == ',' : rest == end;
    if (failure != std::errc() || !separated) {
      throw UsageError("--grip " + word + ": expected soft, normal, firm or m,b,k [kg, N s/m, N/m]");
    }
    if (separated && rest != end) at = rest + 1;
  }
  return {values[0], values[1], values[2]};
}

/// @throws UsageError naming the option or the value that is missing or not physical
SampledLoop loop_of(const StabilityArguments& options) {
  try {
    SampledLoop loop;
    if (options.device) {
      loop.device = chosen_device(*options.device);
      loop.rate = loop.device.update_rate;
    } else if (!options.mass || !options.damping) {
      throw UsageError(std::string(options.mass ? "--damping" : "--mass") + " is missing, or --device");
    }
    if (options.mass) loop.device.apparent_mass = *options.mass;
    if (options.damping) loop.device.viscous_friction = *options.damping;
    if (options.rate) loop.rate = *options.rate;
    if (options.delay) loop.device.sample_delay = *options.delay;
    if (options.wall_damping) loop.wall_damping = *options.wall_damping;
    if (options.friction) loop.device.coulomb_friction = *options.friction;
    if (options.encoder_step) loop.device.encoder_step = *options.encoder_step;
    if (options.grip) loop.grip = grip_of(*options.grip);
    validate(loop);
    return loop;
  } catch (const ValueError& error) {
    throw UsageError(error.what());
  }
}

bool asks_for_a_point(const StabilityArguments& options) {
  return options.device || options.grip || options.mass || options.damping || options.rate || options.wall_damping ||
         options.friction || options.encoder_step || options.delay;
}

void advise(const StabilityArguments& options) {
  if (options.out || options.quick) {
    throw UsageError(std::string(options.out ? "--out" : "--quick") + " is for the map, not for one loop");
  }
  const SampledLoop loop = loop_of(options);
  const StiffnessAdvice advice = advise_stiffness(loop);
  fmt::print("{}", options.json ? json(loop, advice) : table(loop, advice));
}

void map(const StabilityArguments& options) {
  if (options.out && options.out->empty()) throw UsageError("--out: an empty name");
  const Interrupt interrupt;
  std::optional<OutputDirectory> out;
  if (options.out) out.emplace(*options.out);
  StabilityMapOptions wanted;
  if (options.quick) {
    wanted.with_grid = false;
    wanted.per_decade = 4;
  }
  Progress progress;
  wanted.progress = [&](double share) {
    interrupt.check();
    progress.show(share);
  };
  const StabilityMap map = stability_map(wanted);
  fmt::print("{}", options.json ? json(map) : tables(map));
  std::fflush(stdout);  // what was found is not lost when drawing fails
  if (!out) return;
  out->write("stability.json", json(map));
  const bool plots = can_plot();
  interrupt.check();  // Ctrl-C is for gnuplot too, which then cannot be run
  if (plots) {
    out->write("stability.svg", stability_map_plot(map));
  } else {
    spdlog::warn("gnuplot cannot be run: no picture of the map");
  }
}

}  // namespace

void add_stability(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("stability",
                                                   "How stiff a wall a device can render. With --mass and --damping, "
                                                   "or --device: the bounds of that loop, with their "
                                                   "formulas. Without: the map, by simulation.");
  const auto options = std::make_shared<StabilityArguments>();
  const auto add = [&](const char* name, auto& value, const char* help, const char* unit) {
    return command->add_option(name, value, help)->type_name(unit);
  };
  const auto add_number = [&](const char* name, auto& value, const char* help, const char* unit) {
    add(name, value, help, unit)->check(number(0.0, largest));
  };
  add("--device", options->device, "A simulated device: omni, touch, desktop, premium-1.5, ideal", "NAME");
  add_number("--mass", options->mass, "Of the device at its tip", "KG");
  add_number("--damping", options->damping, "Of the device", "N_S/M");
  add_number("--friction", options->friction, "Dry friction of the device (default: 0)", "N");
  add_number("--encoder-step", options->encoder_step, "Of its positions (default: 0)", "M");
  add_number("--rate", options->rate, "Of the servo loop (default: 1000, or the device's)", "HZ");
  add("--delay", options->delay, "Age of a sample (default: 0, or the device's)", "TICKS")->check(integer(0, 1000));
  add_number("--wall-damping", options->wall_damping, "Of the wall (default: 0)", "N_S/M");
  add("--grip", options->grip, "soft, normal, firm or m,b,k [kg, N s/m, N/m] (default: none)", "GRIP");
  add("--out", options->out, "Directory for the map as JSON and picture, created when missing", "DIR");
  command->add_flag("--quick", options->quick, "The map's sweeps alone, and coarser")->disable_flag_override();
  command->add_flag("--json", options->json, "Print JSON instead of the tables")->disable_flag_override();
  command->callback([options] { asks_for_a_point(*options) ? advise(*options) : map(*options); });
}

}  // namespace calligraphy::tools
