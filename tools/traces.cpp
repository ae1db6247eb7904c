// calligraphy traces: reads pen recordings in other formats, and writes them as pen traces.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <CLI/CLI.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/ink_import.hpp>

#include "commands.hpp"
#include "counted.hpp"
#include "gzip_file.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_file.hpp"

namespace calligraphy::tools {
namespace {

struct TracesArguments {
  std::vector<std::string> in;
  std::string out;
  std::optional<std::string> text;
  std::string set;
  std::string notice;
  std::string y_axis = "auto";
  bool json = false;
};

/// What was read of a file, in numbers.
struct ReadFigures {
  std::string file;
  InkImport import;
  std::u32string characters = {};
  std::size_t strokes = 0, samples = 0;
  double duration = 0.0;     ///< of all traces, from the first sample to the last of each [s]
  double pen_down_time = 0;  ///< [s]
  std::size_t intervals = 0;

  /// Mean rate of samples while the pen is down [Hz]; 0: not known.
  double rate() const { return pen_down_time > 0.0 ? static_cast<double>(intervals) / pen_down_time : 0.0; }
};

ReadFigures figures_of(const std::string& file, InkImport import) {
  ReadFigures figures{file, std::move(import)};
  for (const PenTrace& trace : figures.import.traces) {
    figures.characters += trace.character;
    figures.strokes += trace.strokes.size();
    for (const PenStroke& stroke : trace.strokes) {
      figures.samples += stroke.size();
      figures.intervals += stroke.size() - 1;
      figures.pen_down_time += stroke.back().time - stroke.front().time;
    }
    for (const PenStroke& air : trace.air) figures.samples += air.size();
    figures.duration += trace.strokes.back().back().time - trace.strokes.front().front().time;
  }
  return figures;
}

std::string traces_table(const std::vector<ReadFigures>& files) {
  std::string text = fmt::format("{:<14}{:>11}{:>9}{:>9}{:>10}{:>10}  {}\n", "format", "characters", "strokes",
                                 "samples", "time [s]", "rate [Hz]", "file");
  for (const ReadFigures& each : files) {
    text += fmt::format("{:<14}{:>11}{:>9}{:>9}{:>10.2f}{:>10.1f}  {}\n", to_string(each.import.format),
                        each.import.traces.size(), each.strokes, each.samples, each.duration, each.rate(),
                        printable(each.file));
  }
  for (const ReadFigures& each : files) {
    for (const std::string& note : each.import.notes) {
      text += fmt::format("{}: {}\n", printable(each.file), printable(note));
    }
  }
  return text;
}

std::string traces_json(const std::vector<ReadFigures>& files, const std::string& out) {
  nlohmann::ordered_json all = {{"out", out}, {"files", nlohmann::ordered_json::array()}};
  for (const ReadFigures& each : files) {
    std::string characters;
    for (const char32_t code : each.characters) characters += encode_utf8(code);
    all["files"].push_back({{"file", each.file},
                            {"format", to_string(each.import.format)},
                            {"characters", characters},
                            {"strokes", each.strokes},
                            {"samples", each.samples},
                            {"duration_s", each.duration},
                            {"rate_Hz", each.rate() > 0.0 ? nlohmann::ordered_json(each.rate()) : nullptr},
                            {"notes", each.import.notes}});
  }
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// @throws UsageError if the file needs more of --text than earlier ones left
InkImport read_ink(const std::string& in, const InkOptions& asked, const TracesArguments& options) {
  try {
    return import_ink(unpacked(in), in, asked);
  } catch (const FormatError& error) {
    const std::string what = error.what();
    if (!options.text || !asked.text.empty() || what.find("(--text)") == what.npos) throw;
    throw UsageError(fmt::format("--text has {}, and more are needed: {}",
                                 counted(characters_of(*options.text).size(), "character"), what));
  }
}

void run(const TracesArguments& options) {
  const bool to_standard_output = options.out == standard_output;
  for (const std::string& in : options.in) {
    std::error_code failure;
    if (!to_standard_output && std::filesystem::equivalent(in, options.out, failure)) {
      throw UsageError("--out: " + options.out + " is one of the files to read");
    }
  }
  if (to_standard_output && options.json) throw UsageError("--json: standard output is taken by --out -");
  InkOptions asked;
  if (options.text) asked.text = characters_of(*options.text);
  if (options.y_axis != "auto") asked.y_axis = options.y_axis == "up" ? YAxis::up : YAxis::down;
  asked.set = options.set;
  check_output(options.out);
  const Interrupt interrupt;
  std::vector<ReadFigures> files;
  std::vector<PenTrace> traces;
  for (const std::string& in : options.in) {
    interrupt.check();
    InkImport import = read_ink(in, asked, options);
    asked.text.erase(asked.text.begin(), asked.text.begin() + static_cast<std::ptrdiff_t>(import.text_used));
    files.push_back(figures_of(in, std::move(import)));
    for (PenTrace& trace : files.back().import.traces) {
      traces.push_back(std::move(trace));
      trace = {};
    }
  }
  if (!asked.text.empty()) {
    throw UsageError(fmt::format("--text: the files need {} fewer, and have no {} that is not named",
                                 counted(asked.text.size(), "character"), character_label(asked.text.front().written)));
  }
  const std::string text = pen_traces_text(traces, options.notice);
  interrupt.check();
  write_output(options.out, text);
  fmt::print(to_standard_output ? stderr : stdout, "{}",
             options.json ? traces_json(files, options.out) : traces_table(files));
}

}  // namespace

void add_traces(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "traces",
      "Read pen recordings in other formats as pen traces, for `replay`. IN is InkML, JSON of signature_pad, XML of "
      "Tegaki, an SVC file as of research on handwriting, a CSV table with named columns, or pen traces; its content "
      "tells which. What was assumed is told.");
  command->footer(
      "calligraphy traces 永.json -o pens.txt    # see docs/pen-traces.md\n"
      "calligraphy traces lesson.inkml --text 永十 -o pens.txt\n"
      "calligraphy replay pens.txt");
  const auto options = std::make_shared<TracesArguments>();
  command->add_option("IN", options->in, "Pen recordings, compressed by gzip or not; written in this order")
      ->required()
      ->type_name("PATH");
  add_out_file(*command, options->out);
  command
      ->add_option("--text", options->text,
                   "The characters that were written, in order, of those that the files do not name")
      ->type_name("TEXT");
  command->add_option("--set", options->set, "Word that names the source (default: the name of each file)")
      ->type_name("WORD");
  command->add_option("--notice", options->notice, "Text for the head of the file, such as the licence of a corpus")
      ->type_name("TEXT");
  command
      ->add_option("--y-axis", options->y_axis,
                   "Where y of the files points; auto: as they declare, or else as most of it was written")
      ->check(CLI::IsMember({"auto", "up", "down"}))
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON instead of the table")->disable_flag_override();
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
