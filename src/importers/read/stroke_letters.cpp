#include "stroke_letters.hpp"

#include <vector>

#include <nlohmann/json.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>

#include "source_files.hpp"

namespace calligraphy {
namespace {

using Json = nlohmann::json;

constexpr std::string_view file_name = "cnchar.order.min.js";
constexpr std::string_view before_literal = "JSON.parse('";
constexpr std::size_t max_script = 4 << 20;  // [byte]; the package's has 125 thousand
constexpr std::size_t max_lettered_strokes = 256;

/// The text of a single-quoted JavaScript string that begins at `at`; advances `at` past its end.
std::string unquoted(std::string_view text, std::size_t& at, const std::string& name) {
  const std::size_t begin = at;
  std::string result;
  for (; at < text.size() && text[at] != '\''; ++at) {
    if (text[at] == '\\') {
      ++at;
      if (at == text.size() || std::string_view("\\'\"").find(text[at]) == std::string_view::npos) {
        throw FormatError(name + ": byte " + std::to_string(at) + ": an escape other than \\\\, \\' and \\\"");
      }
    }
    result += text[at];
  }
  if (at == text.size()) throw FormatError(name + ": byte " + std::to_string(begin) + ": unterminated string");
  return result;
}

bool is_letters(const Json& value) {
  if (!value.is_string()) return false;
  const auto& text = value.get_ref<const std::string&>();
  return !text.empty() && text.size() <= max_lettered_strokes &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == text.npos;
}

/// The entries of a table of letters; empty if the table has other content.
StrokeLetters letters_of(const Json& table) {
  StrokeLetters letters;
  if (!table.is_object()) return letters;
  for (const auto& [key, value] : table.items()) {
    const std::u32string code = decode_utf8(key);
    if (code.size() != 1 || !is_letters(value)) return {};
    letters.emplace(code[0], value.get<std::string>());
  }
  return letters;
}

}  // namespace

StrokeLetters parse_stroke_letters(std::string_view javascript, const std::string& name) {
  for (std::size_t at = javascript.find(before_literal); at != std::string_view::npos;
       at = javascript.find(before_literal, at)) {
    at += before_literal.size();
    const std::size_t begin = at;
    const std::string literal = unquoted(javascript, at, name);
    try {
      if (StrokeLetters letters = letters_of(Json::parse(literal)); !letters.empty()) return letters;
    } catch (const Json::exception& error) {
      throw FormatError(name + ": byte " + std::to_string(begin) + ": not JSON: " + error.what());
    }
  }
  throw FormatError(name + ": no table of stroke letters found, such as JSON.parse('{\"一\":\"j\",...}')");
}

StrokeLetters read_stroke_letters(const std::filesystem::path& source) {
  std::error_code failure;
  if (std::filesystem::is_regular_file(source, failure) && source.extension() == ".js") {
    return parse_stroke_letters(read_file(source, max_script), source.string());
  }
  const auto plan = [](std::string_view path) {
    return FilePlan{std::filesystem::path(path).filename() == file_name ? "" : "not the letters"};
  };
  const SourceFiles found = read_source(source, plan);
  if (found.files.empty()) throw FileError(source.string() + ": contains no " + std::string(file_name));
  const SourceFile& file = found.files.front();
  return parse_stroke_letters(file.text, source.string() + ": " + file.path);
}

}  // namespace calligraphy
