#include <calligraphy/model/character_list.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <ostream>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>

#include "base/charconv.hpp"
#include "base/line_reader.hpp"
#include "built_in.hpp"
#include "order_name.hpp"

namespace calligraphy {
namespace {

constexpr std::array<std::string_view, 4> first_lines = {"calligraphy characters 1", "calligraphy characters 2",
                                                         "calligraphy characters 3", "calligraphy characters 4"};
constexpr int format_with_ink = 4;  // in 3, which no release wrote, ink had knots at other places
constexpr std::size_t max_file_bytes = 64 << 20;  // twice the size of all Make Me a Hanzi [bytes]
constexpr std::string_view licence_text_key = "licence-text";

LineKind kind_of(std::string_view key) {
  if (key == licence_text_key) return LineKind::verbatim;
  return key == "source" || key == "licence" || key == "attribution" ? LineKind::text : LineKind::words;
}

std::string character_label(char32_t code, std::string_view order) {
  return "character " + encode_utf8(code) + (order.empty() ? "" : " order " + std::string(order));
}

/// Reads the text format line by line; docs/character-format.md describes it.
class Parser : private LineReader {
 public:
  Parser(ReadBytes read, std::string_view name) : LineReader(std::move(read), name, max_file_bytes) {}

  CharacterList parse() {
    while (next_statement(kind_of)) {
      const std::string_view key = word();
      if (format_ == 0) {
        read_format();
      } else if (key == "source") {
        set_.provenance.source = checked_rest();
      } else if (key == "licence") {
        set_.provenance.licence = checked_rest();
      } else if (key == "attribution") {
        set_.provenance.attribution = checked_rest();
      } else if (key == licence_text_key) {
        add_licence_line();
      } else if (key == "character") {
        begin_character();
      } else if (key == "stroke") {
        add_stroke();
      } else if (key == "ink") {
        add_ink();
      } else {
        fail("unknown keyword " + in_quotes(key));
      }
    }
    if (format_ == 0) throw FormatError(name() + ": empty; expected '" + std::string(first_lines[1]) + "'");
    end_character();
    return std::move(set_);
  }

 private:
  void read_format() {
    if (is_utf16(line())) fail("the file is UTF-16, not UTF-8: save it as UTF-8");
    const auto found = std::find(first_lines.begin(), first_lines.end(), line());
    if (found == first_lines.end()) {
      fail("expected " + in_quotes(first_lines[1]) + " (or 1, or 4 with ink), found " + in_quotes(line()));
    }
    format_ = static_cast<int>(found - first_lines.begin()) + 1;
  }

  /// The text after the keyword and one space.
  void add_licence_line() {
    const std::string_view line = left().empty() ? left() : left().substr(1);
    decode(line);
    std::string& text = set_.provenance.licence_text;
    if (has_licence_text_) text += '\n';
    text += line;
    has_licence_text_ = true;
  }

  std::string checked_rest() {
    const std::string_view text = rest();
    decode(text);
    return std::string(text);
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
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
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
    character_line_ = number();
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
      fail("expected 'degree', 'order' or the end of the line, found " + in_quotes(key));
    }
    if (!seen_.emplace(code_, order_).second) fail(character_label(code_, order_) + " is defined a second time");
    in_character_ = true;
  }

  /// A name that extends to the end of the line.
  void read_order() {
    order_ = checked_rest();
    try {
      check_order_name(order_);
    } catch (const ValueError& error) {
      fail(error.what());
    }
  }

  void add_stroke() {
    if (!in_character_) fail("a stroke before any character");
    check_ink_is_like_that_of_first_stroke();
    StrokeInput stroke{parse_number<int>(word(), "typical stroke id"), {}};
    std::string_view text = word();
    const bool is_letter = !text.empty() && ((text[0] >= 'A' && text[0] <= 'Z') || (text[0] >= 'a' && text[0] <= 'z'));
    if (is_letter && text.find(',') == std::string_view::npos) {
      stroke.elements = elements_of(text);
      text = word();
    } else if (format_ == 1 && stroke.id >= 1 && stroke.id <= typical_stroke_count) {
      stroke.elements = typical_stroke(stroke.id).as_printed();
    }
    for (; !text.empty(); text = word()) {
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
    stroke_line_ = number();
  }

  void add_ink() {
    if (format_ < format_with_ink) {
      fail("ink, which takes " + in_quotes(first_lines[format_with_ink - 1]) + " as the first statement, not " +
           std::to_string(format_));
    }
    if (strokes_.empty()) fail("ink before any stroke of a character");
    StrokeInput& stroke = strokes_.back();
    if (stroke.ink) fail("a second line of ink for one stroke");
    std::vector<double> values;
    for (std::string_view text = word(); !text.empty(); text = word()) {
      values.push_back(parse_number<double>(text, "number"));
    }
    const auto [knots, corners] = ink_size(typical_stroke(stroke.id), stroke.composition().elements());
    const std::size_t least = 2 + knots, most = 2 + 2 * knots + corners;
    if (values.size() != least && values.size() != most) {
      fail("the ink of this stroke takes " + std::to_string(least) + " or " + std::to_string(most) +
           " numbers, not " + std::to_string(values.size()));
    }
    StrokeInk& ink = stroke.ink.emplace();
    ink.start = values[0];
    ink.end = values[1];
    auto from = values.begin() + 2;
    std::copy_n(from, knots, ink.half_widths.begin());
    from += static_cast<std::ptrdiff_t>(knots);
    if (values.size() == most) {
      std::copy_n(from, knots, ink.offsets.begin());
      std::copy_n(from + static_cast<std::ptrdiff_t>(knots), corners, ink.shifts.begin());
    }
    check_stroke(stroke);
    stroke_line_ = number();
    check_ink_is_like_that_of_first_stroke();
  }

  /// A character has ink on all strokes or on none; the last stroke so far is complete.
  void check_ink_is_like_that_of_first_stroke() const {
    if (strokes_.empty() || strokes_.back().ink.has_value() == strokes_.front().ink.has_value()) return;
    fail_at(stroke_line_, "stroke " + std::to_string(strokes_.size()) +
                              (strokes_.back().ink ? " has ink" : " has no ink") + ", unlike stroke 1");
  }

  ElementList elements_of(std::string_view text) const {
    try {
      return text;
    } catch (const ValueError& error) {
      fail(error.what());
    }
  }

  /// An invalid stroke is reported with its own line, not that of its character.
  void check_stroke(const StrokeInput& stroke) const {
    try {
      make_character(code_, std::span(&stroke, 1), degree_);
    } catch (const ValueError& error) {
      fail(error.what());
    }
  }

  void end_character() {
    if (!in_character_) return;
    if (strokes_.empty()) fail_at(character_line_, character_label(code_, order_) + " has no stroke");
    check_ink_is_like_that_of_first_stroke();
    set_.characters.push_back(make_character(code_, strokes_, degree_));
    set_.characters.back().order = order_;
    strokes_.clear();
    in_character_ = false;
  }

  int format_ = 0;  // 0: not yet known
  bool has_licence_text_ = false;
  bool in_character_ = false;
  int character_line_ = 0;
  int stroke_line_ = 0;  // of the last stroke or its ink
  char32_t code_ = 0;
  int degree_ = 3;
  std::string order_;
  std::set<std::pair<char32_t, std::string>> seen_;
  std::vector<StrokeInput> strokes_;
  CharacterList set_;
};

CharacterList parse_embedded(const char* text, std::string_view name) { return Parser(bytes_of(text), name).parse(); }

std::string format_number(double value) {
  char buffer[32];
  const auto [end, error] = to_chars(buffer, buffer + sizeof buffer, value);
  return error == std::errc() ? std::string(buffer, end) : std::string("0");
}

void write_numbers(std::ostream& out, std::span<const double> numbers) {
  for (const double number : numbers) out << ' ' << format_number(number);
}

void write_ink(std::ostream& out, const Stroke& stroke) {
  const StrokeInk& ink = *stroke.ink;
  const auto [knots, corners] = ink_size(*stroke.type, stroke.elements);
  out << "ink " << format_number(ink.start) << ' ' << format_number(ink.end);
  write_numbers(out, std::span(ink.half_widths).first(knots));
  if (ink.offsets != StrokeInk{}.offsets || ink.shifts != StrokeInk{}.shifts) {
    write_numbers(out, std::span(ink.offsets).first(knots));
    write_numbers(out, std::span(ink.shifts).first(corners));
  }
  out << '\n';
}

/// One statement per line; "a\n" has two lines, the second of them empty.
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

const Character& CharacterList::at(char32_t code, std::string_view order) const {
  if (const Character* const found = find(code, order)) return *found;
  throw ValueError(character_label(code, order) + " is not in the list of " + std::to_string(characters.size()) +
                   " characters");
}

const CharacterList& built_in_characters() {
  static const CharacterList set = parse_embedded(built_in::characters, "built-in characters");
  return set;
}

const Character& paper_example() {
  static const CharacterList set = parse_embedded(built_in::paper_example, "paper example");
  return set.characters.front();
}

CharacterList read_characters(std::istream& in, std::string_view name) {
  return Parser(bytes_of(in, name), name).parse();
}

CharacterList read_characters(const std::string& path) {
  const std::string text = read_file(path, max_file_bytes);
  return Parser(bytes_of(text), path).parse();
}

void write_characters(std::ostream& out, const CharacterList& set) {
  const Provenance& provenance = set.provenance;
  if (provenance.licence_text.find('\r') != std::string::npos) {
    throw ValueError("the licence text contains a carriage return; its lines must end with '\\n'");
  }
  for (const std::string& text : {provenance.source, provenance.licence, provenance.attribution}) {
    if (text.find_first_of("\r\n") != std::string::npos)
      throw ValueError("source, licence and attribution must be one line each: " + in_quotes(text));
  }
  const bool has_ink = std::any_of(set.characters.begin(), set.characters.end(),
                                   [](const Character& character) { return !character.physics.ink.empty(); });
  out << first_lines[has_ink ? format_with_ink - 1 : 1] << '\n';
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
      out << "stroke " << std::to_string(stroke.type->id);  // independent of the stream's base and locale
      if (stroke.elements != stroke.type->elements) out << ' ' << stroke.elements;
      for (const Point& point : stroke.control_points) {
        out << ' ' << format_number(point.x()) << ',' << format_number(point.y());
      }
      const auto& factors = stroke.attraction_factors;
      if (std::any_of(factors.begin(), factors.end(), [](double factor) { return factor != 1.0; })) {
        out << " |";
        write_numbers(out, factors);
      }
      out << '\n';
      if (stroke.ink != nullptr) write_ink(out, stroke);
    }
  }
}

}  // namespace calligraphy
