// Where characters come from: set files, files in the text format, the sources of `import`, or the built-in set.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/character_text.hpp>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace calligraphy::tools {

/// Opens the files and directories in `paths`, layered with the first on top; without any, the built-in set. From a
/// source of `import`, only the characters of `text` are read. The typical strokes are below if `text` has any.
/// @throws Error naming the file
CharacterSet open_sources(const std::vector<std::string>& paths, const std::u32string& text);

/// As import_characters(). @throws UsageError naming an option that does not apply to this kind of source
ImportResult import_source(const std::string& source, const ImportOptions& asked);

/// Warns of the unusable files that an import skipped, with the first few.
void warn_of_unusable(const ImportReport& report, const std::string& source);

/// The characters of `text` that are there, as written or as meant, which is told. Punctuation that is not there is
/// skipped, and a warning says so.
/// @throws Error naming all other characters that are not in `place`, and then `advice`, or the punctuation if there is
/// nothing else
std::u32string present(const std::vector<TextCharacter>& text, const std::function<bool(char32_t)>& is_there,
                       const std::string& place, const std::string& advice = {});

/// Tells each reading_note() once.
class ReadingNotes {
 public:
  void tell(const TextCharacter& character, char32_t code);

 private:
  std::vector<std::string> told_;
};

/// Each code point once, in order.
std::u32string each_once(const std::u32string& text);

/// Tells how the characters that were asked for by --only were read, and warns of those that are not in the list.
void tell_of_only(const std::string& only, const CharacterList& list, const std::string& source);

/// Characters, and the set that has them.
struct ChosenCharacters {
  CharacterSet set;
  std::u32string text;
};

/// As open_sources(), and what of `text` is present() in the set, in the stroke order `order`, or in any order if that is
/// empty. @throws Error naming the characters or the file
ChosenCharacters open_characters(const std::vector<std::string>& paths, const std::vector<TextCharacter>& text,
                                 const std::string& order = {});

/// The characters of `text` in the stroke order `order`; if that is empty, in the standard or else the first order.
std::vector<Character> characters_of(const CharacterSet& set, const std::u32string& text,
                                     const std::string& order = {});

/// @throws Error naming the first of the characters that has no stroke order of this name, and the orders that it has
void require_order(const ChosenCharacters& chosen, const std::string& order, const std::vector<std::string>& paths);

/// Of a character, as in: the standard one, "Kaisho".
std::string order_names(const CharacterSet& set, char32_t code);

/// Adds --no-corrections, which leaves stroke orders as the source has them.
void add_no_corrections_flag(CLI::App& command, bool& as_drawn);

/// Adds --characters PATH, which may be repeated.
CLI::Option* add_characters_option(CLI::App& command, std::vector<std::string>& paths);

}  // namespace calligraphy::tools
