// calligraphy import: converts other character collections to typical strokes.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/set_encoding.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "import_report.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "progress.hpp"

namespace calligraphy::tools {
namespace {

struct ImportArguments {
  std::string source;
  std::string out;
  std::string format = "set";
  std::optional<std::string> precision;
  std::string ink = "full";
  std::string letters;
  std::optional<std::string> only;
  std::string date;
  bool alternates = false;
  bool all = false;
  bool as_drawn = false;
  int threads = 0;
  bool strict = false;
  bool report = false;
  bool json = false;
};

const std::map<std::string, CoordinatePrecision> precisions = {{"coarse", CoordinatePrecision::coarse},
                                                               {"standard", CoordinatePrecision::standard},
                                                               {"fine", CoordinatePrecision::fine},
                                                               {"exact", CoordinatePrecision::exact}};

const std::map<std::string, InkDetail> ink_details = {
    {"none", InkDetail::none}, {"half-widths", InkDetail::half_widths}, {"full", InkDetail::full}};

/// Why the word is not a date; empty: it is one.
std::string not_a_date(const std::string& word) {
  int year = 0;
  unsigned month = 0, day = 0;
  std::sscanf(word.c_str(), "%4d-%2u-%2u", &year, &month, &day);
  const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
  const bool as_written = word == fmt::format("{:04}-{:02}-{:02}", year, month, day);  // without blanks and signs
  return as_written && year > 0 && date.ok() ? "" : word + ": expected a date, YYYY-MM-DD";
}

std::string encoded(const CharacterList& list, const ImportArguments& options) {
  if (options.format == "set") {
    const std::vector<std::byte> bytes =
        encode_character_set(list, precisions.at(options.precision.value_or("standard")));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  std::ostringstream text;
  write_characters(text, list);
  return text.str();
}

ImportResult imported(const ImportArguments& options, const Interrupt& interrupt) {
  ImportOptions asked;
  asked.letters = options.letters;
  asked.alternates = options.alternates;
  asked.ideographs_only = !options.all;
  asked.corrections = !options.as_drawn;
  asked.ink = ink_details.at(options.ink);
  if (options.only) asked.only = codes_of(characters_of(*options.only));
  asked.date = options.date;
  asked.threads = options.threads;
  asked.strict = options.strict;
  asked.report = options.report;
  Progress progress;
  asked.progress = [&](double share) {
    interrupt.check();
    progress.show(share);
  };
  return import_source(options.source, asked);
}

/// True if `out` is the source or a file in it.
bool is_in_source(const ImportArguments& options) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::path source = fs::canonical(options.source, failure);
  if (failure) return false;
  const fs::path out = fs::weakly_canonical(options.out, failure);
  const auto [rest, at] = std::mismatch(source.begin(), source.end(), out.begin(), out.end());
  return !failure && rest == source.end() && fs::exists(out, failure);
}

void run(const ImportArguments& options) {
  if (options.source.empty()) throw UsageError("SOURCE: the name is empty");
  if (is_in_source(options)) throw UsageError("--out: " + options.out + " is the source, or a file in it");
  if (options.format == "text" && options.precision) throw UsageError("--precision: the text format is always exact");
  const bool to_standard_output = options.out == standard_output;
  if (to_standard_output && options.json) throw UsageError("--json: standard output is taken by --out -");
  if (to_standard_output && options.format == "set" && isatty(STDOUT_FILENO) != 0) {
    throw UsageError("--out -: a set file is no text for a terminal; choose --format text, or a pipe");
  }
  check_output(options.out);
  const Interrupt interrupt;
  const ImportResult import = imported(options, interrupt);
  warn_of_unusable(import.report, options.source);
  if (options.only) tell_of_only(*options.only, import.list, options.source);
  const std::string bytes = encoded(import.list, options);
  interrupt.check();
  write_output(options.out, bytes);
  const ImportOutput output{options.out, options.format, bytes.size()};
  std::FILE* const report = to_standard_output ? stderr : stdout;
  fmt::print(report, "{}", options.json ? json(import, output) : tables(import, output));
}

}  // namespace

void add_import(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "import",
      "Convert other collections of characters to typical strokes. SOURCE is hanzi-writer-data, Make Me a Hanzi, animCJK "
      "or KanjiVG (directory, tarball, zip or one of their files), a set file or a file in the text format; its content "
      "tells which.");
  command->footer(
      "npm pack hanzi-writer-data@2.0.1    # the source, a .tgz\n"
      "calligraphy import hanzi-writer-data-2.0.1.tgz -o hanzi.set\n"
      "calligraphy import hanzi.set --only 永 --format text -o -    # to edit");
  const auto options = std::make_shared<ImportArguments>();
  command->add_option("SOURCE", options->source, "Directory, tarball, zip, JSON, SVG, set or text file")
      ->required()
      ->type_name("PATH");
  add_out_file(*command, options->out);
  command->add_option("--format", options->format, "Set file, or the text format, which can be edited")
      ->check(CLI::IsMember({"set", "text"}))
      ->capture_default_str();
  command
      ->add_option(
          "--precision", options->precision,
          "Coordinate precision of a set file (default: standard); see docs/set-file.md")
      ->check(CLI::IsMember({"coarse", "standard", "fine", "exact"}));
  command
      ->add_option("--ink", options->ink,
                   "hanzi-writer-data: keep the width of the brush along each stroke, alone or with where the "
                   "brush lies beside the path (full); see docs/strokes.md")
      ->check(CLI::IsMember({"none", "half-widths", "full"}))
      ->capture_default_str();
  command
      ->add_option("--letters", options->letters,
                   "hanzi-writer-data: stroke letters, the tarball, directory or .js file of cnchar-order")
      ->type_name("PATH");
  command->add_flag("--alternates", options->alternates, "KanjiVG: also import variants, as alternate stroke orders")
      ->disable_flag_override();
  command->add_flag("--all", options->all, "KanjiVG: also import kana, Latin letters, radicals and signs")
      ->disable_flag_override();
  add_no_corrections_flag(*command, options->as_drawn);
  command->add_option("--only", options->only, "Import only these characters")->type_name("TEXT");
  command
      ->add_option("--date", options->date,
                   "hanzi-writer-data, KanjiVG: date of the modification, YYYY-MM-DD, for the attribution")
      ->check(CLI::Validator(not_a_date, ""))
      ->type_name("DATE");
  command->add_option("--threads", options->threads, "Threads (default: one per core)")
      ->check(integer(1, 256))
      ->type_name("N");
  command->add_flag("--strict", options->strict, "Fail at the first unusable file, instead of skipping it")
      ->disable_flag_override();
  command->add_flag("--report", options->report, "Also measure every stroke against its source; docs/strokes.md")
      ->disable_flag_override();
  command->add_flag("--json", options->json, "Print the report as JSON")->disable_flag_override();
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
