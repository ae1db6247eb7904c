// calligraphy validate: strokes that are valid and yet look wrong.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>

#include "commands.hpp"
#include "import_report.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string file;
  std::string letters;
  std::optional<std::string> only;
  int threads = 0;
  bool json = false;
};

/// A stroke and what is doubtful about it.
struct Finding {
  StrokeReference place;
  std::string kind;
  std::string what;
};

struct Findings {
  int characters = 0;
  int strokes = 0;
  std::vector<Finding> list;
};

std::string words_for(const LabelConflict& conflict) {
  const std::string recognised = fmt::format("{} ({})", conflict.recognised, typical_stroke(conflict.recognised).name);
  if (conflict.resolution == LabelResolution::unknown)
    return fmt::format("label {} is unknown; it looks like {}", conflict.label, recognised);
  return fmt::format("is labelled {} and has the shape of {}", conflict.label, recognised);
}

Findings findings(const Options& options) {
  Progress progress;
  ImportOptions asked;
  asked.letters = options.letters;
  if (options.only) asked.only = characters_of(*options.only);
  asked.threads = options.threads;
  asked.progress = [&progress](double share) { progress.show(0.5 * share); };
  const ImportResult import = import_characters(options.file, asked);
  Findings found{import.report.characters, import.report.strokes, {}};
  for (const LabelConflict& conflict : import.report.label_conflicts) {
    found.list.push_back({conflict.place, "label", words_for(warning)});
  }
  const auto second_half = [&progress](double share) { progress.show(0.5 + 0.5 * share); };
  for (const CharacterWarnings& character : character_warnings(import.list.characters, options.threads, second_half)) {
    for (const StrokeWarning& warning : character.warnings) {
      found.list.push_back(
          {{character.code, character.order, warning.stroke}, calligraphy::to_string(warning.kind), warning.what});
    }
  }
  return found;
}

std::string json(const Findings& findings) {
  Json warnings = Json::array();
  for (const Finding& finding : findings.list) {
    warnings.push_back({{"character", encode_utf8(finding.place.code)},
                        {"order", finding.place.order},
                        {"stroke", finding.place.stroke},
                        {"kind", finding.kind},
                        {"what", finding.what}});
  }
  const Json all = {{"characters", findings.characters}, {"strokes", findings.strokes}, {"warnings", warnings}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string lines(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings.list) {
    text += fmt::format("{} stroke {}: {}: {}\n", character_label(finding.place.code, finding.place.order),
                        finding.place.stroke, finding.kind, finding.what);
  }
  return text + fmt::format("{} warnings in {} characters, {} strokes\n", findings.list.size(), findings.characters,
                            findings.strokes);
}

void run(const Options& options) {
  if (options.file.empty()) throw UsageError("FILE: an empty name");
  const Findings found = findings(options);
  fmt::print("{}", options.json ? json(found) : lines(found));
}

}  // namespace

void add_validate(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "validate",
      "List stroke warnings: type against shape, start against direction, overlaps, out of the em square. Of what "
      "`import` reads, labels against shapes, too. Exit code 0 unless FILE cannot be read whole.");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "File of characters, or what `import` takes")->required();
  command->add_option("--letters", options->letters, "Stroke letters for hanzi-writer-data: cnchar-order")
      ->type_name("PATH");
  command->add_option("--only", options->only, "Look at these characters and no others")->type_name("TEXT");
  command->add_option("--threads", options->threads, "Threads (default: one per core)")
      ->check(integer(1, 256))
      ->type_name("N");
  command->add_flag("--json", options->json, "Print JSON: characters, strokes, and a list of warnings")
      ->disable_flag_override();
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
