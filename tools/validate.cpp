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
#include <calligraphy/importers/validation.hpp>

#include "commands.hpp"
#include "import_report.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

struct ValidateArguments {
  std::string file;
  std::string letters;
  std::optional<std::string> only;
  int threads = 0;
  bool json = false;
};

/// A stroke and what is doubtful about it.
struct Finding {
  StrokePlace place;
  std::string kind;
  std::string what;
};

struct Findings {
  int characters = 0;
  int strokes = 0;
  std::vector<Finding> list;
};

std::string words_for(const LabelDoubt& doubt) {
  const std::string recognised = fmt::format("{} ({})", doubt.recognised, typical_stroke(doubt.recognised).name);
  if (doubt.fate == LabelFate::unknown)
    return fmt::format("label {} is unknown; it looks like {}", doubt.label, recognised);
  return fmt::format("is labelled {} and has the shape of {}", doubt.label, recognised);
}

Findings findings(const ValidateArguments& options) {
  Progress progress;
  ImportOptions asked;
  asked.letters = options.letters;
  if (options.only) asked.only = characters_of(*options.only);
  asked.threads = options.threads;
  asked.progress = [&progress](double share) { progress.show(0.5 * share); };
  const Import import = import_characters(options.file, asked);
  Findings found{import.report.characters, import.report.strokes, {}};
  for (const LabelDoubt& doubt : import.report.label_doubts) {
    found.list.push_back({doubt.place, "label", words_for(doubt)});
  }
  const auto second_half = [&progress](double share) { progress.show(0.5 + 0.5 * share); };
  for (const DoubtfulCharacter& character : doubtful_characters(import.list.characters, options.threads, second_half)) {
    for (const Doubt& doubt : character.doubts) {
      found.list.push_back(
          {{character.code, character.order, doubt.stroke}, calligraphy::name_of(doubt.kind), doubt.what});
    }
  }
  return found;
}

std::string listed_as_json(const Findings& findings) {
  Json doubts = Json::array();
  for (const Finding& finding : findings.list) {
    doubts.push_back({{"character", encode_utf8(finding.place.code)},
                      {"order", finding.place.order},
                      {"stroke", finding.place.stroke},
                      {"kind", finding.kind},
                      {"what", finding.what}});
  }
  const Json all = {{"characters", findings.characters}, {"strokes", findings.strokes}, {"doubts", doubts}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string listed(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings.list) {
    text += fmt::format("{} stroke {}: {}: {}\n", name_of(finding.place.code, finding.place.order),
                        finding.place.stroke, finding.kind, finding.what);
  }
  return text + fmt::format("{} doubts in {} characters, {} strokes\n", findings.list.size(), findings.characters,
                            findings.strokes);
}

void run(const ValidateArguments& options) {
  if (options.file.empty()) throw UsageError("FILE: an empty name");
  const Findings found = findings(options);
  fmt::print("{}", options.json ? listed_as_json(found) : listed(found));
}

}  // namespace

void add_validate(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "validate",
      "List doubtful strokes: type against shape, start against direction, overlaps, out of the em square. Of what "
      "`import` reads, labels against shapes, too. Exit code 0 unless FILE cannot be read whole.");
  const auto options = std::make_shared<ValidateArguments>();
  command->add_option("FILE", options->file, "File of characters, or what `import` takes")->required();
  command->add_option("--letters", options->letters, "Stroke letters for hanzi-writer-data: cnchar-order")
      ->type_name("PATH");
  command->add_option("--only", options->only, "Look at these characters and no others")->type_name("TEXT");
  command->add_option("--threads", options->threads, "Threads (default: one per core)")
      ->check(integer(1, 256))
      ->type_name("N");
  command->add_flag("--json", options->json, "Print JSON: characters, strokes, and a list of doubts")
      ->disable_flag_override();
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
