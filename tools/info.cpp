// calligraphy info: contents of a character set, and the data structure of a character (Wang 2006, Table 3).
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_set.hpp>

#include "character_source.hpp"
#include "commands.hpp"
#include "mistyped.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  std::optional<std::string> first;   ///< FILE, or TEXT if no file has this name
  std::optional<std::string> second;  ///< TEXT
  std::vector<std::string> characters;
  std::string order;
  bool paper_example = false;
  bool licence_text = false;
  bool json = false;
};

/// Interpreted arguments.
struct Request {
  std::vector<std::string> paths;
  std::vector<TextCharacter> text;  ///< empty: the set as a whole
  bool may_mean_file = false;  ///< the text is the only argument, and no file has this name
};

/// Totals of a set.
struct Summary {
  std::size_t characters = 0;
  std::size_t strokes = 0;           ///< in the standard order of each character
  std::size_t alternate_orders = 0;  ///< not counting the first one of each character
  std::size_t with_ink = 0;          ///< characters, in their standard order
  std::optional<std::uintmax_t> bytes;  ///< of the files
  double coordinate_error = 0.0;  ///< [em]
  Provenance provenance;          ///< of all layers, each once
};

void add(std::string& all, const std::string& one, const std::string& separator) {
  if (all.find(one) == std::string::npos) all += (all.empty() ? "" : separator) + one;
}

Provenance joined(const std::vector<Provenance>& layers) {
  Provenance all;
  for (const Provenance& layer : layers) {
    add(all.source, layer.source, "; ");
    add(all.licence, layer.licence, "; ");
    add(all.attribution, layer.attribution, "; ");
    add(all.licence_text, layer.licence_text, "\n\n");
  }
  return all;
}

/// The size of all files together; none if the characters are built in, or if one of the paths is a directory.
std::optional<std::uintmax_t> bytes_of(const std::vector<std::string>& paths) {
  std::optional<std::uintmax_t> sum;
  for (const std::string& path : paths) {
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
    if (failure) return std::nullopt;
    sum = sum.value_or(0) + bytes;
  }
  return sum;
}

Summary summary_of(const CharacterSet& set, const std::vector<std::string>& paths) {
  Summary summary;
  for (const StoredCharacter& character : set) {
    if (character.stroke_count() == 0) character.character();  // throws, naming the damage
    ++summary.characters;
    summary.strokes += static_cast<std::size_t>(character.stroke_count());
    if (character.has_ink()) ++summary.with_ink;
    summary.alternate_orders += set.orders(character.code()).size() - 1;
  }
  if (summary.characters == 0) throw FormatError(fmt::format("{}: contains no character", fmt::join(paths, ", ")));
  summary.bytes = bytes_of(paths);
  summary.coordinate_error = set.coordinate_error();
  summary.provenance = joined(set.provenances());
  return summary;
}

std::optional<double> bytes_per_character(const Summary& summary) {
  if (!summary.bytes) return std::nullopt;
  return static_cast<double>(*summary.bytes) / static_cast<double>(summary.characters);
}

void print(const Summary& summary) {
  const auto line = [](const char* name, const auto& value) { fmt::print("{:<28} {}\n", name, value); };
  line("Characters", summary.characters);
  line("Strokes", summary.strokes);
  if (summary.alternate_orders > 0) line("Alternate stroke orders", summary.alternate_orders);
  if (summary.with_ink > 0) line("Characters with ink", summary.with_ink);
  if (summary.bytes) {
    line("Bytes", *summary.bytes);
    line("Bytes per character", fmt::format("{:.1f}", *bytes_per_character(summary)));
  }
  line("Coordinate error [em]", fmt::format("{:.3g}", summary.coordinate_error));
}

void print(const Provenance& provenance) {
  fmt::print("source: {}\nlicence: {}\nattribution: {}\n", provenance.source, provenance.licence,
             provenance.attribution);
}

/// `orders`: the names of those it has, if there are several.
void print(const Character& character, const std::string& orders) {
  const SequenceData& sequence = character.sequence;
  fmt::print("{}{}\n", character_label(character.code), character.order.empty() ? "" : ", order " + character.order);
  if (!orders.empty()) fmt::print("  {:<28} {}\n", "Stroke orders (--order)", orders);
  fmt::print("  {:<28} {}\n", "Number of typical strokes", sequence.stroke_ids.size());
  fmt::print("  {:<28} {}\n", "ID array of typical strokes", fmt::join(sequence.stroke_ids, ", "));
  fmt::print("  {:<28} {}\n", "Number of control points", character.structure.control_points.size());
  fmt::print("  {:<28} {}\n", "Number of feature points", sequence.feature_points.size());
  fmt::print("  {:<28} {}\n", "Sequence of typical strokes", fmt::join(sequence.stroke_ids, ", "));
  fmt::print("  {:<28} {}\n", "Feature points, by index", fmt::join(sequence.feature_points, ", "));
  int number = 0;
  for (const Stroke& stroke : strokes(character)) {
    fmt::print("  stroke {}: {} {} {}, elements {}, control points", ++number, stroke.type->id, stroke.type->name,
               stroke.type->pinyin, stroke.elements);
    for (const Point& point : stroke.control_points) fmt::print(" {:.4g},{:.4g}", point.x(), point.y());
    fmt::print("\n");
  }
}

Json json_of(const Summary& summary) {
  const auto number_or_null = [](const auto& number) { return number ? Json(*number) : Json(); };
  return {{"characters", summary.characters},
          {"strokes", summary.strokes},
          {"alternate_orders", summary.alternate_orders},
          {"characters_with_ink", summary.with_ink},
          {"bytes", number_or_null(summary.bytes)},
          {"bytes_per_character", number_or_null(bytes_per_character(summary))},
          {"coordinate_error_em", summary.coordinate_error},
          {"source", summary.provenance.source},
          {"licence", summary.provenance.licence},
          {"attribution", summary.provenance.attribution}};
}

Json json_of(const Character& character, const Provenance& provenance, const std::vector<std::string>& orders) {
  Json drawn = Json::array();
  for (const Stroke& stroke : strokes(character)) {
    Json points = Json::array();
    for (const Point& point : stroke.control_points) points.push_back({point.x(), point.y()});
    drawn.push_back({{"id", stroke.type->id},
                     {"name", stroke.type->name},
                     {"pinyin", stroke.type->pinyin},
                     {"elements", stroke.elements},
                     {"control_points_em", points},
                     {"attraction_factors",
                      Json(std::vector<double>(stroke.attraction_factors.begin(), stroke.attraction_factors.end()))}});
  }
  return {{"character", encode_utf8(character.code)},
          {"order", character.order},
          {"orders", orders},
          {"number_of_typical_strokes", character.stroke_count()},
          {"typical_stroke_ids", character.sequence.stroke_ids},
          {"number_of_control_points", character.structure.control_points.size()},
          {"number_of_feature_points", character.sequence.feature_points.size()},
          {"sequence", character.sequence.stroke_ids},
          {"feature_points", character.sequence.feature_points},
          {"strokes", drawn},
          {"source", provenance.source},
          {"licence", provenance.licence},
          {"attribution", provenance.attribution}};
}

bool has_file_name_characters(const std::string& word) { return word.find_first_of("./") != std::string::npos; }

/// With two arguments the first is a FILE, or the second does not belong there. @throws FileError, UsageError
void check_first_of_two(const std::string& first, const std::string& second) {
  std::error_code failure;
  if (std::filesystem::exists(first, failure) || failure) return;
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (has_file_name_characters(first) || std::all_of(first.begin(), first.end(), is_ascii)) {
    throw FileError(first + ": no such file");
  }
  throw unexpected(second);
}

/// The first argument is FILE if such a file exists, otherwise TEXT.
Request request_of(const InfoArguments& options) {
  Request request{options.characters, {}};
  std::error_code failure;
  if (options.second) check_first_of_two(*options.first, *options.second);
  const bool has_file = options.second || (options.first && std::filesystem::exists(*options.first, failure));
  if (has_file && !options.characters.empty()) throw UsageError("--characters: cannot be combined with FILE");
  if (has_file) request.paths.insert(request.paths.begin(), *options.first);
  const std::optional<std::string>& text = has_file ? options.second : options.first;
  if (text) request.text = characters_of(*text);
  request.may_mean_file = text && !has_file;
  if (request.paths.empty() && request.text.empty()) throw UsageError("FILE or TEXT is required");
  if (!options.order.empty() && request.text.empty()) throw UsageError("--order: applies only to TEXT");
  return request;
}

/// A mistyped name of a file is read as TEXT: the message says both.
ChosenCharacters chosen(const Request& request, const InfoArguments& options) {
  if (request.may_mean_file && has_file_name_characters(*options.first)) {
    throw FileError(*options.first + ": no such file");
  }
  try {
    ChosenCharacters chosen = open_characters(request.paths, request.text);
    chosen.text = each_once(chosen.text);
    return chosen;
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    if (!request.may_mean_file) throw;
    throw Error(fmt::format("{}: no such file, and as TEXT {}", *options.first, error.what()));
  }
}

void run_paper_example(const InfoArguments& options) {
  if (!options.characters.empty()) throw UsageError("--paper-example: cannot be combined with --characters");
  if (options.second) throw UsageError("--paper-example: cannot be combined with FILE");
  if (!options.order.empty()) throw UsageError("--paper-example: cannot be combined with --order");
  const Character& example = paper_example();
  if (options.first && codes_of(characters_of(*options.first)) != std::u32string(1, example.code)) {
    throw UsageError(
        fmt::format("--paper-example: the example is {}, not \"{}\"", character_label(example.code), *options.first));
  }
  Provenance provenance = built_in_characters().provenance;
  provenance.source += ", after Wang 2006, Table 3";
  if (options.json) {
    fmt::print("{}\n", Json{{"text", Json::array({json_of(example, provenance, {})})}}.dump(2));
    return;
  }
  print(example, "");
  print(provenance);
}

void run(const InfoArguments& options) {
  if (options.paper_example) return run_paper_example(options);
  const Request request = request_of(options);
  const ChosenCharacters characters = chosen(request, options);
  require_order(characters, options.order, request.paths);
  const auto& [set, text] = characters;
  const Summary summary = summary_of(set, request.paths);
  if (options.json) {
    Json json = json_of(summary);
    if (options.licence_text) json["licence_text"] = summary.provenance.licence_text;
    if (!text.empty()) json["text"] = Json::array();
    for (const char32_t code : text) {
      const StoredCharacter found = *set.find(code, options.order);
      json["text"].push_back(json_of(found.character(), found.provenance(), set.orders(code)));
    }
    fmt::print("{}\n", json.dump(2));
    return;
  }
  if (text.empty()) print(summary);
  for (const Character& character : characters_of(set, text, options.order)) {
    print(character, set.orders(character.code).size() > 1 ? order_names(set, character.code) : "");
  }
  print(summary.provenance);
  if (options.licence_text) fmt::print("\n{}\n", summary.provenance.licence_text);
}

}  // namespace

void add_info(CLI::App& program) {
  CLI::App* const command = program.add_subcommand(
      "info",
      "Print what a character file or a character consists of. Of a file: contents, source and licence; with TEXT, the "
      "data structure of its characters (Wang 2006, Table 3). FILE is a set file or a file in the text format; a first argument "
      "that names no file is TEXT.");
  command->footer(
      "calligraphy info 永\n"
      "calligraphy info hanzi.set    # from `calligraphy import`\n"
      "calligraphy info hanzi.set 永和 --json");
  const auto options = std::make_shared<InfoArguments>();
  command->add_option("FILE", options->first, "Set file, or file in the text format")->type_name("FILE");
  command->add_option("TEXT", options->second, "Characters, each shown once");
  add_characters_option(*command, options->characters);
  command->add_option("--order", options->order, "Alternate stroke order (default: the standard one)")
      ->type_name("NAME");
  command->add_flag("--paper-example", options->paper_example, "Print the character of Table 3, verbatim");
  command->add_flag("--licence-text", options->licence_text, "Also print the text of the licence");
  command->add_flag("--json", options->json,
                    "Print JSON: an object, with one object per character in the list \"text\"");
  command->callback([options] { run(*options); });
}

}  // namespace calligraphy::tools
