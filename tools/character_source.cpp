#include "character_source.hpp"

#include <filesystem>

#include <calligraphy/error.hpp>
#include <calligraphy/practice/hanzi_writer.hpp>

#include "options.hpp"

namespace calligraphy::tools {
namespace {

CharacterList select(const std::u32string& text, const CharacterList& from, const std::string& name) {
  CharacterList found{from.provenance, {}};
  for (const char32_t code : text) {
    if (found.find(code) != nullptr) continue;
    const Character* const character = from.find(code);
    if (character == nullptr) throw Error("character " + name_of(code) + " is not in " + name);
    found.characters.push_back(*character);
  }
  return found;
}

CharacterList read_package(const std::u32string& text, const std::string& directory) {
  CharacterList found{{"Make Me a Hanzi, as hanzi-writer-data",
                       "Arphic Public License",
                       "Arphic Technology, Make Me a Hanzi, Hanzi Writer",
                       {}},
                      {}};
  for (const char32_t code : text) {
    if (found.find(code) == nullptr) found.characters.push_back(read_hanzi_writer(directory, code));
  }
  return found;
}

}  // namespace

CharacterList find_characters(const std::u32string& text, const std::string& path) {
  if (path.empty()) return select(text, built_in_characters(), "the built-in set; --characters names another");
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) return read_package(text, path);
  return select(text, read_characters(path), path);
}

}  // namespace calligraphy::tools
