// calligraphy stability: maximum stiffness of a virtual wall, for one loop or as a map.
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
#include "output_file.hpp"
#include "progress.hpp"
#include "run_record.hpp"
#include "stability_report.hpp"

namespace calligraphy::tools {
namespace {

constexpr double largest = 1e9;  ///< upper limit of most numeric options, as in the library

struct StabilityArguments {
  std::optional<std::string> device, grip;
  RunOutput out;
  std::optional<double> mass, damping, rate, wall_damping, friction, encoder_step;
  std::optional<int> delay;
  bool quick = false;
  bool json = false;
};

GripImpedance grip_of(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, GripImpedance>, 3> named = {
      {{"soft", {0.05, 1.0, 100.0}}, {"normal", {0.1, 3.0, 300.0}}, {"firm", {0.15, 5.0, 500.0}}}};
  for (const auto& [name, grip] : named) {
    if (word == name) return grip;
  }
  std::array<double, 3> values{};
  const char* at = word.data();
  const char* const end = at + word.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [rest, failure] = std::from_chars(at, end, values[i]);
    const bool separated = i + 1 < values.size() ? rest != end && *rest == ',' : rest == end;
    if (failure != std::errc() || !separated) {
      throw UsageError("--grip: " + word + ": expected soft, normal, firm or m,b,k [kg, N s/m, N/m]");
    }
    if (separated && rest != end) at = rest + 1;
  }
  return {values[0], values[1], values[2]};
}

/// @throws UsageError naming the missing option or the value that is not physical
SampledLoop loop_of(const StabilityArguments& options) {
  try {
    SampledLoop loop;
    if (options.device) {
      loop.device = chosen_device(*options.device);
      loop.rate = loop.device.update_rate;
    } else if (!options.mass || !options.damping) {
      throw UsageError(std::string(options.mass ? "--damping" : "--mass") + " is required unless --device is given");
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
  if (!options.out.directory.empty() || options.quick) {
    throw UsageError(std::string(options.quick ? "--quick" : "--out") + " applies to the map, not to a single loop");
  }
  const SampledLoop loop = loop_of(options);
  const StiffnessAdvice advice = advise_stiffness(loop);
  fmt::print("{}", options.json ? json(loop, advice) : table(loop, advice));
}

void map(const StabilityArguments& options) {
  const Interrupt interrupt;
  std::optional<OutputDirectory> out;
  if (!options.out.directory.empty()) out.emplace(options.out.directory, stability_file, options.out.force);
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
  fmt::print("{}", options.json ? json_text(json(map)) : tables(map));
  std::fflush(stdout);  // results are printed even if plotting fails
  if (!out) return;
  out->keep(json(map));
  const bool plots = gnuplot_available();
  interrupt.check();  // Ctrl-C also reaches gnuplot, which then seems unavailable
  if (plots) {
    out->write("stability.svg", stability_map_plot(map));
  } else {
    spdlog::warn("gnuplot is not available: the map is not plotted");
  }
  out->finish();
}

}  // namespace

void add_stability(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("stability",
                             "Maximum stiffness of a virtual wall. With --device, or --mass and --damping: the bounds "
                             "for that loop and their formulas. Otherwise: a stability map, by simulation.");
  command->footer(
      "calligraphy stability --device desktop\n"
      "calligraphy stability --mass 0.045 --damping 0.1 --rate 1000 --grip soft\n"
      "calligraphy stability --quick --out out");
  const auto options = std::make_shared<StabilityArguments>();
  const auto add = [&](const char* name, auto& value, const std::string& help, const char* unit) {
    return command->add_option(name, value, help)->type_name(unit);
  };
  const auto add_number = [&](const char* name, auto& value, const char* help, const char* unit, double least = 0.0,
                              double most = largest) { add(name, value, help, unit)->check(number(least, most)); };
  add("--device", options->device, "Device profile: " + device_names(), "DEVICE")->check(such_as(simulated_devices()));
  add_number("--mass", options->mass, "Apparent mass of the device at its tip, 1e-9 to 1e9", "KG", 1e-9);
  add_number("--damping", options->damping, "Viscous friction of the device, 0 to 1e9", "N_S/M");
  add_number("--friction", options->friction,
             "Coulomb friction of the device, 0 to 1e9 (default: 0, or the device's)", "N");
  add_number("--encoder-step", options->encoder_step,
             "Position resolution of its encoders, 0 to 1e9 (default: 0, or the device's)", "M");
  add_number("--rate", options->rate, "Servo rate, 1 to 1000000 (default: 1000, or the device's)", "HZ", 1.0, 1e6);
  add("--delay", options->delay, "Age of a sample when it is read, 0 to 1000 (default: 0, or the device's)", "TICKS")
      ->check(integer(0, 1000));
  add_number("--wall-damping", options->wall_damping, "Damping of the wall, 0 to 1e9 (default: 0)", "N_S/M");
  add("--grip", options->grip, "Grip: soft, normal, firm or m,b,k [kg, N s/m, N/m] (default: none)", "GRIP")
      ->check(such_as({"soft", "normal", "firm"}));
  add_out_directory(*command, options->out, "stability.json and stability.svg");
  command->add_flag("--quick", options->quick, "Only the sweeps of the map, on a coarser grid")
      ->disable_flag_override();
  command->add_flag("--json", options->json, "Print JSON instead of the tables")->disable_flag_override();
  command->callback([options] { asks_for_a_point(*options) ? advise(*options) : map(*options); });
}

}  // namespace calligraphy::tools
