// calligraphy tradeoff: cost against accuracy, side by side in one run.
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
#include <calligraphy/experiments/tradeoff.hpp>
#include <calligraphy/pictures/plot.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "experiments/nearest_point_workload.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_directory.hpp"
#include "output_file.hpp"
#include "progress.hpp"
#include "run_record.hpp"
#include "tradeoff_report.hpp"

namespace calligraphy::tools {
namespace {

/// Number of characters written at every servo rate.
constexpr std::size_t max_written = 2;

struct TradeoffArguments {
  std::string text = "永北京航空天大学和年书法";
  std::vector<std::string> characters;
  std::string ink;
  RunOutput out;
  std::uint64_t seed = 1;
  std::optional<int> queries;
  bool quick = false;
  bool json = false;
};

TradeoffReport asked_for(const TradeoffArguments& options) {
  TradeoffReport report;
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

/// The characters from a source of outlines, measured against these.
ImportResult with_ink(const std::string& source, const std::u32string& text, const Interrupt& interrupt) {
  if (is_own_format(source)) throw Error("--ink: " + source + " is no source of outlines but holds imported characters");
  ImportOptions asked;
  asked.only = text;
  asked.report = true;
  asked.progress = [&](double) { interrupt.check(); };
  ImportResult import = import_source(source, asked);
  if (import.report.ink.strokes.empty()) throw Error("--ink: " + source + " has no outlines of strokes");
  return import;
}

void measure(TradeoffReport& report, const std::vector<Character>& characters, const Interrupt& interrupt) {
  Progress progress;
  const auto part = [&](double begin, double end) {
    return [&, begin, end](double share) {
      interrupt.check();
      progress.show(begin + share * (end - begin));
    };
  };
  report.nearest_options.progress = part(0.0, 0.6);
  report.nearest_point = nearest_point_tradeoff(characters, report.nearest_options);
  report.servo_options.progress = part(0.6, 0.95);
  report.servo_rate = servo_rate_tradeoff(std::span(characters).first(report.written.size()), report.servo_options);
  report.coordinate_width = coordinate_width_tradeoff(characters, part(0.95, 1.0));
  progress.show(1.0);
}

void draw(const TradeoffReport& report, OutputDirectory& out, const Interrupt& interrupt) {
  out.keep(json(report));
  for (const ForceFieldFigure& figure : ambiguity_figures()) {
    out.write("field-" + figure.name + ".svg", force_field_picture(figure));
  }
  const bool plots = gnuplot_available();
  interrupt.check();  // Ctrl-C also reaches gnuplot, which then seems unavailable
  if (!plots) {
    spdlog::warn("gnuplot is not available: tradeoffs are not plotted");
    return;
  }
  out.write("tradeoff.svg", nearest_point_tradeoff_plot(report.nearest_point));
  out.write("servo_rate.svg", servo_rate_tradeoff_plot(report.servo_rate));
  out.write("coordinate_width.svg", coordinate_width_tradeoff_plot(report.coordinate_width));
}

void run(const TradeoffArguments& options) {
  TradeoffReport report = asked_for(options);
  const auto [set, read] = open_characters(options.characters, characters_of(options.text));
  const std::u32string text = report.text = each_once(read);
  report.written = text.substr(0, options.quick ? 1 : max_written);
  const std::vector<Character> characters = characters_of(set, text);
  if (curve_control_points(characters).empty()) {
    throw Error("TEXT has no stroke with a curve to measure the nearest point on");
  }
  const Interrupt interrupt;
  if (!options.ink.empty()) report.ink = with_ink(options.ink, report.text, interrupt);
  std::optional<OutputDirectory> out;
  if (!options.out.directory.empty()) out.emplace(options.out.directory, tradeoff_file, options.out.force);
  measure(report, characters, interrupt);
  fmt::print("{}", options.json ? json_text(json(report)) : tables(report));
  std::fflush(stdout);  // results are printed even if plotting fails
  if (!out) return;
  try {
    draw(report, *out, interrupt);
    out->finish();
  } catch (const Error&) {
    interrupt.check();
    throw;
  }
}

}  // namespace

void add_tradeoff(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("tradeoff",
                             "Measure cost against accuracy. Nearest-point methods, servo rate and width of stored "
                             "coordinates, side by side. With --out DIR, also write plots, tradeoff.json and the force "
                             "fields of Figs. 25 to 28.");
  command->footer(
      "calligraphy tradeoff --quick\n"
      "calligraphy tradeoff 永和九年 --out out");
  const auto options = std::make_shared<TradeoffArguments>();
  command->add_option("TEXT", options->text, "Characters to measure; the first two are written at every servo rate")
      ->capture_default_str();
  add_characters_option(*command, options->characters);
  command
      ->add_option("--ink", options->ink,
                   "hanzi-writer-data (directory or npm tarball): also measure what the ink of TEXT takes and covers")
      ->type_name("PATH");
  add_out_directory(*command, options->out, "plots and JSON");
  command->add_option("--seed", options->seed, "Seed of all random draws")
      ->check(integer(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->capture_default_str();
  command
      ->add_option("--queries", options->queries,
                   "Queries in each of the 19 workloads (default: 4000; with --quick: 400)")
      ->check(integer(1, 1000000))
      ->type_name("N");
  command->add_flag("--quick", options->quick, "Coarse results in a few seconds")->disable_flag_override();
  command->add_flag("--json", options->json, "Print JSON instead of the tables")->disable_flag_override();
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
