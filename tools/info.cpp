// calligraphy info: the data structure of a character (Wang 2006, Table 3).
#include <memory>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/text.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string text;
  std::string characters;
  bool paper_example = false;
  bool json = false;
};

void print_table(const Character& character) {
  const SequenceData& sequence = character.sequence;
  fmt::print("{}\n", name_of(character.code));
  fmt::print("  {:<28} {}\n", "Number of typical strokes", sequence.stroke_ids.size());
  fmt::print("  {:<28} {}\n", "ID array of typical strokes", fmt::join(sequence.stroke_ids, ", "));
  fmt::print("  {:<28} {}\n", "Number of control points", character.structure.control_points.size());
  fmt::print("  {:<28} {}\n", "Number of feature points", sequence.feature_points.size());
  fmt::print("  {:<28} {}\n", "Sequence of typical strokes", fmt::join(sequence.stroke_ids, ", "));
  fmt::print("  {:<28} {}\n", "Feature points, by index", fmt::join(sequence.feature_points, ", "));
  int number = 0;
  for (const Stroke& stroke : strokes(character)) {
    fmt::print("  stroke {}: {} {} {}, elements {}, control points", ++number, stroke.type->id, stroke.type->name,
               stroke.type->pinyin, stroke.type->elements);
    for (const Point& point : stroke.control_points) fmt::print(" {:.4g},{:.4g}", point.x(), point.y());
    fmt::print("\n");
  }
}

Json json_of(const CharacterList& set, const Character& character) {
  Json drawn = Json::array();
  for (const Stroke& stroke : strokes(character)) {
    Json points = Json::array();
    for (const Point& point : stroke.control_points) points.push_back({point.x(), point.y()});
    drawn.push_back({{"id", stroke.type->id},
                     {"name", stroke.type->name},
                     {"pinyin", stroke.type->pinyin},
                     {"elements", stroke.type->elements},
                     {"control_points_em", points},
                     {"attraction_factors",
                      Json(std::vector<double>(stroke.attraction_factors.begin(), stroke.attraction_factors.end()))}});
  }
  return {{"character", encode_utf8(character.code)},
          {"number_of_typical_strokes", character.stroke_count()},
          {"typical_stroke_ids", character.sequence.stroke_ids},
          {"number_of_control_points", character.structure.control_points.size()},
          {"number_of_feature_points", character.sequence.feature_points.size()},
          {"sequence", character.sequence.stroke_ids},
          {"feature_points", character.sequence.feature_points},
          {"strokes", drawn},
          {"source", set.provenance.source},
          {"licence", set.provenance.licence},
          {"attribution", set.provenance.attribution}};
}

CharacterList chosen(const Options& options) {
  if (!options.paper_example) {
    return find_characters(characters_of(options.text), options.characters);
  }
  if (!options.characters.empty()) throw UsageError("--paper-example: comes with the program, not with --characters");
  const Character& example = paper_example();
  if (!options.text.empty() && characters_of(options.text) != std::u32string(1, example.code)) {
    throw UsageError(fmt::format("--paper-example: is {}, not \"{}\"", name_of(example.code), options.text));
  }
  const CharacterList& own = built_in_characters();
  return {
      {own.provenance.source + ", after Wang 2006, Table 3", own.provenance.licence, own.provenance.attribution, {}},
      {example}};
}

void run(const Options& options) {
  const CharacterList set = chosen(options);
  if (options.json) {
    Json list = Json::array();
    for (const Character& character : set.characters) list.push_back(json_of(set, character));
    fmt::print("{}\n", list.dump(2));
    return;
  }
  for (const Character& character : set.characters) print_table(character);
  fmt::print("source: {}\nlicence: {}\nattribution: {}\n", set.provenance.source, set.provenance.licence,
             set.provenance.attribution);
}

}  // namespace

void add_info(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("info", "Print the data structure of characters (Table 3).");
  const auto options = std::make_shared<Options>();
  CLI::Option* const text = command->add_option("TEXT", options->text, "Characters, each shown once");
  command
      ->add_option("--characters", options->characters,
                   "File of characters, or directory of hanzi-writer-data (default: the built-in set)")
      ->type_name("PATH");
  command->add_flag("--paper-example", options->paper_example, "The character of Table 3, verbatim");
  command->add_flag("--json", options->json, "Print JSON: a list with an object per character");
  command->callback([options, text] {
    if (text->count() == 0 && !options->paper_example) throw UsageError("TEXT is required");
    run(*options);
  });
}

}  // namespace calligraphy::tools
