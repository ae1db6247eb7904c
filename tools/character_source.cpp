#include "character_source.hpp"

#include <filesystem>

#include <CLI/CLI.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/character_import.hpp>

#include "commands.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

CharacterSet open_one(const std::string& path, const std::u32string& text) {
  if (path.empty()) throw UsageError("--characters: the name is empty");
  std::error_code failure;
  if (!text.empty() && std::filesystem::is_directory(path, failure)) {
    ImportOptions asked;
    asked.only = text;
    return CharacterSet(import_characters(path, asked).list);
  }
  return CharacterSet::open(path);
}

std::string names_of(const std::vector<std::string>& paths) {
  if (paths.empty()) return "the built-in set; use --characters to name another one";
  std::string names;
  for (const std::string& path : paths) names += (names.empty() ? "" : ", ") + path;
  return names;
}

}  // namespace

CharacterSet open_sources(const std::vector<std::string>& paths, const std::u32string& text) {
  std::vector<CharacterSet> sets;
  for (const std::string& path : paths) sets.push_back(open_one(path, text));
  if (paths.empty()) sets.emplace_back(built_in_characters());
  return CharacterSet::layered(sets);
}

CharacterSet open_characters(const std::vector<std::string>& paths, const std::u32string& text,
                             const std::string& order) {
  CharacterSet set = open_sources(paths, text);
  for (const char32_t code : text) {
    if (set.find(code, order)) continue;
    const bool has_others = set.find(code).has_value();
    throw Error("character " + character_label(code) +
                (has_others ? " has no stroke order \"" + order + "\" in " : " is not in ") + names_of(paths));
  }
  return set;
}

std::vector<Character> characters_of(const CharacterSet& set, const std::u32string& text, const std::string& order) {
  std::vector<Character> characters;
  for (const char32_t code : text) characters.push_back(set.find(code, order)->character());
  return characters;
}

CLI::Option* add_characters_option(CLI::App& command, std::vector<std::string>& paths) {
  return command
      .add_option("--characters", paths,
                  "Set file, file in the text format or hanzi-writer-data directory (default: the built-in set); "
                  "repeat to layer several, the first on top")
      ->allow_extra_args(false)
      ->type_name("PATH");
}

}  // namespace calligraphy::tools
