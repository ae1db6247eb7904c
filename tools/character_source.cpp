#include "character_source.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "commands.hpp"
#include "counted.hpp"
#include "options.hpp"

namespace calligraphy::tools {
namespace {

CharacterSet open_one(const std::string& path, const std::u32string& text) {
  if (path.empty()) throw UsageError("--characters: the name is empty");
  std::error_code failure;
  if (!text.empty() && (std::filesystem::is_directory(path, failure) || !is_own_format(path))) {
    ImportOptions asked;
    asked.only = text;
    ImportResult import = import_characters(path, asked);
    warn_of_unusable(import.report, path);
    return CharacterSet(std::move(import.list));
  }
  return CharacterSet::open(path);
}

/// Of Latin and Chinese texts, as Unicode has it in its blocks of punctuation.
bool is_punctuation(char32_t code) {
  constexpr std::array<std::pair<char32_t, char32_t>, 15> ranges = {{{U'!', U'/'},
                                                                     {U':', U'@'},
                                                                     {U'[', U'`'},
                                                                     {U'{', U'~'},
                                                                     {0xA1, 0xBF},
                                                                     {0x2010, 0x205E},
                                                                     {0x3001, 0x3003},
                                                                     {0x3008, 0x3020},
                                                                     {0x3030, 0x3030},
                                                                     {0x30FB, 0x30FB},
                                                                     {0xFE10, 0xFE6B},
                                                                     {0xFF01, 0xFF0F},
                                                                     {0xFF1A, 0xFF20},
                                                                     {0xFF3B, 0xFF40},
                                                                     {0xFF5B, 0xFF65}}};
  return std::any_of(ranges.begin(), ranges.end(),
                     [code](const auto& range) { return code >= range.first && code <= range.second; });
}

/// "龘 (U+9F98), 犇 (U+7287)", of many the first.
std::string labels(const std::u32string& codes) {
  constexpr std::size_t most = 20;
  std::string text;
  for (const char32_t code : codes.substr(0, most)) text += (text.empty() ? "" : ", ") + character_label(code);
  return codes.size() > most ? text + fmt::format(" and {} more", codes.size() - most) : text;
}

/// What a missing character leads to.
std::string advice(const std::vector<std::string>& paths) {
  if (!paths.empty()) return {};
  std::string all;
  for (const Character& each : built_in_characters().characters) all += encode_utf8(each.code);
  return fmt::format("; it has {}, and `calligraphy import` makes a set of thousands for --characters (docs/import.md)",
                     all);
}

std::string place_of(const std::vector<std::string>& paths) {
  return paths.empty() ? "the built-in set (see --characters)" : fmt::format("{}", fmt::join(paths, ", "));
}

/// Says which typical stroke a number stands for.
void tell_of_stroke(char32_t code) {
  for (const TypicalStroke& stroke : typical_strokes()) {
    if (typical_stroke_code(stroke.id) != code) continue;
    spdlog::info("{} is the typical stroke {} {} {}", encode_utf8(code), stroke.id, stroke.name, stroke.pinyin);
  }
}

}  // namespace

CharacterSet open_sources(const std::vector<std::string>& paths, const std::u32string& text) {
  const CharacterList& strokes = typical_stroke_characters();
  std::u32string characters = text;
  std::erase_if(characters, [&strokes](char32_t code) { return strokes.find(code) != nullptr; });
  std::vector<CharacterSet> sets;
  for (const std::string& path : paths) sets.push_back(open_one(path, characters));
  if (paths.empty()) sets.emplace_back(built_in_characters());
  if (characters.size() < text.size()) sets.emplace_back(strokes);
  return CharacterSet::layered(sets);
}

ImportResult import_source(const std::string& source, const ImportOptions& asked) {
  try {
    return import_characters(source, asked);
  } catch (const ValueError& error) {  // begins with the name of the field, which is that of the option but for two
    const std::string what = error.what(), opposite = "ideographs_only";
    if (what.starts_with("corrections")) throw UsageError("--no-" + what);
    throw UsageError("--" + (what.starts_with(opposite) ? "all" + what.substr(opposite.size()) : what));
  }
}

void ReadingNotes::tell(const TextCharacter& character, char32_t code) {
  const std::string note = reading_note(character, code);
  if (note.empty() || std::find(told_.begin(), told_.end(), note) != told_.end()) return;
  told_.push_back(note);
  spdlog::info("{}", note);
}

std::u32string each_once(const std::u32string& text) {
  std::u32string codes;
  for (const char32_t code : text) {
    if (codes.find(code) == codes.npos) codes += code;
  }
  return codes;
}

void warn_of_unusable(const ImportReport& report, const std::string& source) {
  constexpr std::size_t most = 3;
  std::size_t count = 0;
  std::string first;
  for (const SkippedFile& file : report.skipped) {
    if (!file.unusable || ++count > most) continue;
    first += fmt::format("{}{}: {}", first.empty() ? "" : "; ", printable(file.path), file.reason);
  }
  if (count == 0) return;
  spdlog::warn("{}: skipped {}: {}{}", source, counted(count, "unusable file"), first,
               count > most ? fmt::format("; and {} more", count - most) : "");
}

std::u32string present(const std::vector<TextCharacter>& text, const std::function<bool(char32_t)>& is_there,
                       const std::string& place, const std::string& advice) {
  std::u32string found, skipped, missing;
  ReadingNotes notes;
  for (const TextCharacter& character : text) {
    const char32_t code = is_there(character.written) ? character.written : character.meant;
    if (is_there(code)) {
      notes.tell(character, code);
      if (found.find(code) == found.npos) tell_of_stroke(code);
      found += code;
    } else {
      (is_punctuation(code) ? skipped : missing) += character.written;
    }
  }
  if (!missing.empty()) throw Error(fmt::format("not in {}: {}{}", place, labels(each_once(missing)), advice));
  if (!skipped.empty() && found.empty()) throw Error(fmt::format("not in {}: {}", place, labels(each_once(skipped))));
  if (!skipped.empty()) spdlog::warn("skipped: {}", labels(each_once(skipped)));
  return found;
}

void tell_of_only(const std::string& only, const CharacterList& list, const std::string& source) {
  std::u32string missing;
  ReadingNotes notes;
  for (const TextCharacter& character : characters_of(only)) {
    const auto has = [&list](char32_t code) {
      return std::any_of(list.characters.begin(), list.characters.end(), [code](const auto& each) { return each.code == code; });
    };
    const char32_t code = has(character.written) ? character.written : character.meant;
    if (has(code)) {
      notes.tell(character, code);
    } else {
      missing += character.written;
    }
  }
  if (!missing.empty()) spdlog::warn("not in {}: {}", source, labels(each_once(missing)));
}

ChosenCharacters open_characters(const std::vector<std::string>& paths, const std::vector<TextCharacter>& text,
                                 const std::string& order) {
  CharacterSet set = open_sources(paths, codes_of(text));
  const auto is_there = [&set](char32_t code) { return set.find(code).has_value(); };
  std::u32string found = present(text, is_there, place_of(paths), advice(paths));
  ChosenCharacters chosen{std::move(set), std::move(found)};
  require_order(chosen, order, paths);
  return chosen;
}

void require_order(const ChosenCharacters& chosen, const std::string& order, const std::vector<std::string>& paths) {
  for (const char32_t code : chosen.text) {
    if (chosen.set.find(code, order)) continue;
    throw Error(fmt::format("{} has no stroke order \"{}\" in {}; it has: {}", character_label(code), order,
                            place_of(paths), order_names(chosen.set, code)));
  }
}

std::string order_names(const CharacterSet& set, char32_t code) {
  std::string names;
  for (const std::string& order : set.orders(code)) {
    names += (names.empty() ? "" : ", ") + (order.empty() ? "the standard one" : '"' + order + '"');
  }
  return names;
}

std::vector<Character> characters_of(const CharacterSet& set, const std::u32string& text, const std::string& order) {
  std::vector<Character> characters;
  for (const char32_t code : text) characters.push_back(set.find(code, order)->character());
  return characters;
}

void add_no_corrections_flag(CLI::App& command, bool& as_drawn) {
  command
      .add_flag("--no-corrections", as_drawn,
                "Make Me a Hanzi in any form: leave stroke orders that are known to be wrong; docs/import.md")
      ->disable_flag_override();
}

CLI::Option* add_characters_option(CLI::App& command, std::vector<std::string>& paths) {
  return command
      .add_option("--characters", paths,
                  "Set file, file in the text format, or any source of `import` (default: the built-in set); repeat to "
                  "layer several, the first on top")
      ->allow_extra_args(false)
      ->type_name("PATH");
}

}  // namespace calligraphy::tools
