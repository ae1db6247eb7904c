#include <calligraphy/model/character_list.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "built_in.hpp"
#include "order_name.hpp"

namespace calligraphy {
namespace {

constexpr std::string_view first_line = "calligraphy characters 1";
constexpr std::uintmax_t largest_file = 64 << 20;  // twice all of Make Me a Hanzi [bytes]
constexpr std::string_view licence_text_key = "licence-text";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// What was found, as a message shows it: a file that is no such text may be one line of any length.
std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 60;
  return "'" + std::string(text.substr(0, most)) + (text.size() > most ? "..." : "") + "'";
}

/// Statements whose text goes to the end of the line, '#' and all.
bool is_free_text(std::string_view key) { return key == "source" || key == "licence" || key == "attribution"; }

std::string name_of(char32_t code, std::string_view order) {
  return "character " + encode_utf8(code) + (order.empty() ? "" : " order " + std::string(order));
}

/// Reads the text format line by line; docs/character-format.md describes it.
class Parser {
 public:
  Parser(std::istream& in, std::string_view name) : in_(in), name_(name) {}

  CharacterList parse() {
    while (next_line()) {
      const std::string_view key = word();
      if (number_ == 1 || !seen_first_line_) {
        if (line_ != first_line) fail("expected " + in_quotes(first_line) + ", found " + in_quotes(line_));
        seen_first_line_ = true;
      } else if (key == "source") {
        set_.provenance.source = rest();
      } else if (key == "licence") {
        set_.provenance.licence = rest();
      } else if (key == "attribution") {
        set_.provenance.attribution = rest();
      } else if (key == licence_text_key) {
        add_licence_line();
      } else if (key == "character") {
        begin_character();
      } else if (key == "stroke") {
        add_stroke();
      } else {
        fail("unknown keyword " + in_quotes(key));
      }
    }
    if (in_.bad()) throw FileError(name_ + ": cannot be read");
    if (!seen_first_line_) throw FormatError(name_ + ": empty; expected '" + std::string(first_line) + "'");
    end_character();
    return std::move(set_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_at(number_, what); }
  [[noreturn]] void fail_at(int line, const std::string& what) const {
    throw FormatError(name_ + ":" + std::to_string(line) + ": " + what);
  }

  /// The next line that says something, without comment and trailing blanks.
  bool next_line() {
    while (std::getline(in_, line_)) {
      ++number_;
      if (number_ == 1 && line_.starts_with(byte_order_mark)) line_.erase(0, byte_order_mark.size());
      left_ = line_;
      const std::string_view key = word();
      if (key == licence_text_key) {  // kept to the last blank
        if (line_.ends_with('\r')) line_.pop_back();
        left_ = line_;
        return true;
      }
      if (!is_free_text(key)) line_.erase(std::min(line_.find('#'), line_.size()));
      line_.erase(line_.find_last_not_of(" \t\r") + 1);
      left_ = line_;
      if (!line_.empty()) return true;
    }
    return false;
  }

  std::string_view word() {
    left_.remove_prefix(std::min(left_.find_first_not_of(" \t"), left_.size()));
    const auto end = std::min(left_.find_first_of(" \t"), left_.size());
    const std::string_view found = left_.substr(0, end);
    left_.remove_prefix(end);
    return found;
  }

  /// What stands after the keyword and one blank.
  void add_licence_line() {
    if (!left_.empty()) left_.remove_prefix(1);
    decode(left_);
    std::string& text = set_.provenance.licence_text;
    if (has_licence_text_) text += '\n';
    text += left_;
    has_licence_text_ = true;
  }

  std::string rest() {
    left_.remove_prefix(std::min(left_.find_first_not_of(" \t"), left_.size()));
    decode(left_);
    return std::string(left_);
  }

  std::u32string decode(std::string_view text) const {
    try {
      return decode_utf8(text);
    } catch (const FormatError& error) {
      fail(error.what());
    }
  }

  template <class Number>
  Number parse_number(std::string_view text, std::string_view what) const {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      fail(in_quotes(text) + " is not a " + std::string(what));
    }
    return value;
  }

  void begin_character() {
    end_character();
    const std::u32string codes = decode(word());
    if (codes.size() != 1) fail("expected one character, found " + std::to_string(codes.size()));
    code_ = codes[0];
    character_line_ = number_;
    degree_ = 3;
    order_.clear();
    std::string_view key = word();
    if (key == "degree") {
      degree_ = parse_number<int>(word(), "curve degree");
      key = word();
    }
    if (key == "order") {
      read_order();
    } else if (!key.empty()) {
      fail("expected 'degree', 'order' or nothing more, found " + in_quotes(key));
    }
    if (!seen_.emplace(code_, order_).second) fail(name_of(code_, order_) + " stands here a second time");
    in_character_ = true;
  }

  /// A name to the end of the line.
  void read_order() {
    order_ = rest();
    try {
      check_order_name(order_);
    } catch (const ValueError& error) {
      fail(error.what());
    }
  }

  void add_stroke() {
    if (!in_character_) fail("a stroke before any character");
    StrokeInput stroke{parse_number<int>(word(), "typical stroke id"), {}, {}};
    for (std::string_view text = word(); !text.empty(); text = word()) {
      if (text == "|") {
        for (text = word(); !text.empty(); text = word()) {
          stroke.attraction_factors.push_back(parse_number<double>(text, "attraction factor"));
        }
        if (stroke.attraction_factors.empty()) fail("no attraction factor after '|'");
        break;
      }
      const auto comma = text.find(',');
      if (comma == std::string_view::npos) fail(in_quotes(text) + " is not a point x,y");
      stroke.control_points.emplace_back(parse_number<double>(text.substr(0, comma), "number"),
                                         parse_number<double>(text.substr(comma + 1), "number"));
    }
    check_stroke(stroke);
    strokes_.push_back(std::move(stroke));
  }

  /// A wrong stroke is named by its own line, not by its character's.
  void check_stroke(const StrokeInput& stroke) const {
    try {
      make_character(code_, std::span(&stroke, 1), degree_);
    } catch (const ValueError& error) {
      fail(error.what());
    }
  }

  void end_character() {
    if (!in_character_) return;
    if (strokes_.empty()) fail_at(character_line_, name_of(code_, order_) + " has no stroke");
    set_.characters.push_back(make_character(code_, strokes_, degree_));
    set_.characters.back().order = order_;
    strokes_.clear();
    in_character_ = false;
  }

  std::istream& in_;
  std::string name_;
  std::string line_;
  std::string_view left_;
  int number_ = 0;
  bool seen_first_line_ = false;
  bool has_licence_text_ = false;
  bool in_character_ = false;
  int character_line_ = 0;
  char32_t code_ = 0;
  int degree_ = 3;
  std::string order_;
  std::set<std::pair<char32_t, std::string>> seen_;
  std::vector<StrokeInput> strokes_;
  CharacterList set_;
};

CharacterList parse_embedded(const char* text, std::string_view name) {
  std::istringstream in(text);
  return read_characters(in, name);
}

std::string format_number(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return error == std::errc() ? std::string(buffer, end) : std::string("0");
}

/// A statement for each line; "a\n" has two lines, and the second is empty.
void write_licence_text(std::ostream& out, std::string_view text) {
  if (text.empty()) return;
  for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
    end = text.find('\n', begin);
    const std::string_view line = text.substr(begin, end == std::string_view::npos ? end : end - begin);
    out << licence_text_key << (line.empty() ? "" : " ") << line << '\n';
  }
}

}  // namespace

const Character* CharacterList::find(char32_t code, std::string_view order) const noexcept {
  const auto found = std::find_if(characters.begin(), characters.end(), [&](const Character& character) {
    return character.code == code && character.order == order;
  });
  return found == characters.end() ? nullptr : &*found;
}

const CharacterList& built_in_characters() {
  static const CharacterList set = parse_embedded(built_in::characters, "built-in characters");
  return set;
}

const Character& paper_example() {
  static const CharacterList set = parse_embedded(built_in::paper_example, "paper example");
  return set.characters.front();
}

CharacterList read_characters(std::istream& in, std::string_view name) { return Parser(in, name).parse(); }

CharacterList read_characters(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
    throw FileError(path + ": is not a regular file");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > largest_file) {
    throw FileError(path + ": " + std::to_string(size) + " bytes, more than the " + std::to_string(largest_file) +
                    " that are read");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) throw FileError(path + ": cannot be opened");
  return read_characters(in, path);
}

void write_characters(std::ostream& out, const CharacterList& set) {
  const Provenance& provenance = set.provenance;
  if (provenance.licence_text.find('\r') != std::string::npos) {
    throw ValueError("the licence text has a carriage return; its lines must end with '\\n' alone");
  }
  for (const std::string& text : {provenance.source, provenance.licence, provenance.attribution}) {
    if (text.find_first_of("\r\n") != std::string::npos) throw ValueError("more than one line: " + in_quotes(text));
  }
  out << first_line << '\n';
  if (!provenance.source.empty()) out << "source " << provenance.source << '\n';
  if (!provenance.licence.empty()) out << "licence " << provenance.licence << '\n';
  if (!provenance.attribution.empty()) out << "attribution " << provenance.attribution << '\n';
  write_licence_text(out, provenance.licence_text);
  for (const Character& character : set.characters) {
    out << "\ncharacter " << encode_utf8(character.code);
    if (character.curve_degree != 3) out << " degree " << std::to_string(character.curve_degree);
    if (!character.order.empty()) {
      check_order_name(character.order);
      out << " order " << character.order;
    }
    out << '\n';
    for (const Stroke& stroke : strokes(character)) {
      out << "stroke " << std::to_string(stroke.type->id);  // neither the stream's base nor its locale
      for (const Point& point : stroke.control_points) {
        out << ' ' << format_number(point.x()) << ',' << format_number(point.y());
      }
      const auto& factors = stroke.attraction_factors;
      if (std::any_of(factors.begin(), factors.end(), [](double factor) { return factor != 1.0; })) {
        out << " |";
        for (const double factor : factors) out << ' ' << format_number(factor);
      }
      out << '\n';
    }
  }
}

}  // namespace calligraphy
