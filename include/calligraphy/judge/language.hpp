// Languages in which the library addresses people: one file of words each, in data/languages.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calligraphy {

namespace detail {
struct LanguageWords;
}

/// A language, and its words. Cheap to copy; any number of threads may use it.
class Language {
 public:
  /// The name of a word in braces, and the text that replaces it.
  using Filling = std::pair<std::string_view, std::string_view>;

  /// English.
  Language();
  /// By its code, such as "en" or "zh". @throws ValueError listing the codes if there is no such language
  explicit Language(std::string_view code);

  /// Its code: "en", "zh". In static storage and null-terminated.
  std::string_view code() const noexcept;
  /// Its name in the language itself: "English", "中文".
  std::string_view name() const noexcept;

  /// The text of a key, such as "Stroke {strokes} is missing", with its words filled in; empty if there is none.
  std::string text(std::string_view key, std::initializer_list<Filling> fillings = {}) const;
  /// The same for a number of things: above 1, the text of "key.several" if there is one.
  std::string text_for(long long count, std::string_view key, std::initializer_list<Filling> fillings = {}) const;
  /// Every key, sorted.
  std::vector<std::string_view> keys() const;

  /// Whether both are the same language.
  bool operator==(const Language&) const = default;

 private:
  friend std::vector<Language> languages();
  explicit Language(const detail::LanguageWords& words) : words_(&words) {}

  const detail::LanguageWords* words_;
};

/// All languages, by code.
std::vector<Language> languages();

}  // namespace calligraphy
