#include <calligraphy/judge/language.hpp>

#include <algorithm>
#include <deque>
#include <map>

#include <calligraphy/base/error.hpp>

#include "built_in.hpp"

namespace calligraphy {

/// The code and the texts of a language, all in static storage.
struct detail::LanguageWords {
  std::string_view code;
  std::map<std::string_view, std::string_view> texts;
};

namespace {

/// Reads a file whose lines the build has checked (cmake/component.cmake).
detail::LanguageWords read_words(const built_in::LanguageFile& file) {
  detail::LanguageWords words{file.code, {}};
  std::string_view rest = file.text;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    if (line.empty() || line.front() == '#') continue;
    constexpr std::string_view mark = " = ";
    const std::size_t end = line.find(mark);
    if (end != line.npos) words.texts.emplace(line.substr(0, end), line.substr(end + mark.size()));
  }
  return words;
}

const std::deque<detail::LanguageWords>& all_words() {
  static const std::deque<detail::LanguageWords> all = [] {
    std::deque<detail::LanguageWords> read;
    for (const auto* file = built_in::languages; file->code; ++file) read.push_back(read_words(*file));
    return read;
  }();
  return all;
}

}  // namespace

Language::Language() : Language("en") {}

Language::Language(std::string_view code) {
  std::string codes;
  for (const detail::LanguageWords& words : all_words()) {
    if (words.code == code) {
      words_ = &words;
      return;
    }
    codes += (codes.empty() ? "" : ", ") + std::string(words.code);
  }
  throw ValueError("language \"" + std::string(code) + "\": expected one of " + codes);
}

std::string_view Language::code() const noexcept { return words_->code; }

std::string_view Language::name() const noexcept { return words_->texts.find("language")->second; }

std::string Language::text(std::string_view key, std::initializer_list<Filling> fillings) const {
  const auto found = words_->texts.find(key);
  if (found == words_->texts.end()) return {};
  std::string text;
  for (std::string_view rest = found->second; !rest.empty();) {
    const std::size_t brace = rest.find('{'), end = rest.find('}');
    text += rest.substr(0, brace);
    if (brace == rest.npos || end == rest.npos) break;
    const std::string_view name = rest.substr(brace + 1, end - brace - 1);
    const auto has_name = [name](const Filling& filling) { return filling.first == name; };
    const auto filling = std::find_if(fillings.begin(), fillings.end(), has_name);
    text += filling != fillings.end() ? filling->second : rest.substr(brace, end + 1 - brace);
    rest.remove_prefix(end + 1);
  }
  return text;
}

std::string Language::text_for(long long count, std::string_view key, std::initializer_list<Filling> fillings) const {
  const std::string several = std::string(key) + ".several";
  return text(count > 1 && words_->texts.contains(several) ? std::string_view(several) : key, fillings);
}

std::vector<std::string_view> Language::keys() const {
  std::vector<std::string_view> keys;
  for (const auto& [key, text] : words_->texts) keys.push_back(key);
  return keys;
}

std::vector<Language> languages() {
  std::vector<Language> all;
  for (const detail::LanguageWords& words : all_words()) all.push_back(Language(words));
  return all;
}

}  // namespace calligraphy
