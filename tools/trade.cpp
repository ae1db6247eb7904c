// calligraphy trade: what accuracy costs, side by side in one run.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/force_field.hpp>
#include <calligraphy/experiments/nearest_point_workload.hpp>
#include <calligraphy/experiments/trade.hpp>
#include <calligraphy/pictures/plot.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_directory.hpp"
#include "progress.hpp"
#include "trade_report.hpp"

namespace calligraphy::tools {
namespace {

/// Characters that are written at every servo rate.
constexpr std::size_t most_written = 2;

struct TradeArguments {
  std::string text = "永北京航空天大学和年书法";
  std::vector<std::string> characters;
  std::optional<std::string> out;
  std::uint64_t seed = 1;
  std::optional<int> queries;
  bool quick = false;
  bool json = false;
};

TradeReport asked_for(const TradeArguments& options) {
  TradeReport report;
  for (const char32_t code : characters_of(options.text)) {
    if (report.text.find(code) == std::u32string::npos) report.text += code;
  }
  report.written = report.text.substr(0, options.quick ? 1 : most_written);
  report.seed = report.nearest_options.seed = report.servo_options.seed = options.seed;
  if (options.quick) {
    report.nearest_options.queries = 400;
    report.nearest_options.rounds = 5;
    report.servo_options.rates = {250.0, 1000.0, 4000.0};
    report.servo_options.seeds = 1;
  }
  if (options.queries) report.nearest_options.queries = *options.queries;
  return report;
}

void measure(TradeReport& report, const std::vector<Character>& characters, const Interrupt& interrupt) {
  Progress progress;
  const auto part = [&](double begin, double end) {
    return [&, begin, end](double share) {
      interrupt.check();
      progress.show(begin + share * (end - begin));
    };
  };
  report.nearest_options.progress = part(0.0, 0.6);
  report.nearest_point = nearest_point_trade(characters, report.nearest_options);
  report.servo_options.progress = part(0.6, 0.95);
  report.servo_rate = servo_rate_trade(std::span(characters).first(report.written.size()), report.servo_options);
  report.coordinate_width = coordinate_width_trade(characters, part(0.95, 1.0));
  progress.show(1.0);
}

void draw(const TradeReport& report, const OutputDirectory& out, const Interrupt& interrupt) {
  out.write("trade.json", json(report));
  for (const ForceFieldFigure& figure : ambiguity_figures()) {
    out.write("field-" + figure.name + ".svg", force_field_picture(figure));
  }
  const bool plots = can_plot();
  interrupt.check();  // Ctrl-C is for gnuplot too, which then cannot be run
  if (!plots) {
    spdlog::warn("gnuplot cannot be run: no plots of the trade");
    return;
  }
  out.write("trade.svg", nearest_point_trade_plot(report.nearest_point));
  out.write("servo_rate.svg", servo_rate_trade_plot(report.servo_rate));
  out.write("coordinate_width.svg", coordinate_width_trade_plot(report.coordinate_width));
}

void run(const TradeArguments& options) {
  if (options.out && options.out->empty()) throw UsageError("--out: an empty name");
  TradeReport report = asked_for(options);
  const CharacterSet set = open_characters(options.characters, report.text);
  const std::vector<Character> characters = characters_of(set, report.text);
  if (curve_control_points(characters).empty()) {
    throw Error("no stroke of the text has a curve, which is what the nearest point is measured on");
  }
  const Interrupt interrupt;
  std::optional<OutputDirectory> out;
  if (options.out) out.emplace(*options.out);
  measure(report, characters, interrupt);
  fmt::print("{}", options.json ? json(report) : tables(report));
  std::fflush(stdout);  // what was measured is not lost when drawing fails
  if (!out) return;
  try {
    draw(report, *out, interrupt);
  } catch (const Error&) {
    interrupt.check();
    throw;
  }
}

}  // namespace

void add_trade(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "trade",
      "What accuracy costs: every method of the nearest point, the servo rate, the width of stored coordinates. With "
      "--out DIR also as plots and trade.json, and the force fields of Figs. 25 to 28.");
  const auto options = std::make_shared<TradeArguments>();
  command->add_option("TEXT", options->text, "Characters to measure on; the first two are written at every servo rate")
      ->capture_default_str();
  add_characters_option(*command, options->characters);
  command->add_option("--out", options->out, "Directory for plots and JSON, created when missing")->type_name("DIR");
  command->add_option("--seed", options->seed, "Seed of all that is drawn at random")
      ->check(integer(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--queries", options->queries, "Of each of the 19 workloads (default: 4000, quick: 400)")
      ->check(integer(1, 1000000))
      ->type_name("N");
  command->add_flag("--quick", options->quick, "In a few seconds, and coarse")->disable_flag_override();
  command->add_flag("--json", options->json, "Print JSON instead of the tables")->disable_flag_override();
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
