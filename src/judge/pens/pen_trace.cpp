#include <calligraphy/judge/pen_trace.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_text.hpp>

#include "base/charconv.hpp"
#include "base/line_reader.hpp"
#include "base/require.hpp"
#include "base/stylus_fields.hpp"
#include "sample_fault.hpp"

namespace calligraphy {
namespace {

// Limits that no person's pen exceeds: a file beyond them is rejected.
constexpr std::size_t max_traces_bytes = 256 << 20;  // some fifty thousand characters
constexpr std::size_t max_stroke_bytes = 64 << 20;   // more than a stroke of `max_stroke_points`
constexpr std::size_t max_traces = 1000000;
constexpr std::size_t max_trace_strokes = 1000;
constexpr std::size_t max_stroke_points = 1000000;  // of a stroke: a quarter of an hour at 1 kHz
constexpr double farthest = 10.0;                   // coordinate [em]
constexpr double max_em = 1e9;                      // [file's units]
constexpr double max_time = 86400.0;                // [s]
constexpr double finest = 1e-6;                     // that is written [unit, ms]
constexpr int decimal_places = 6;                   ///< the same, in decimal places

constexpr double milliseconds = 1e3;
constexpr double per_degree = std::numbers::pi / 180.0;

constexpr std::string_view version_2 = "V 2", absent = "-";
constexpr std::string_view tilt_x_name = "tilt_x", tilt_y_name = "tilt_y", buttons_name = "buttons";
constexpr std::int32_t max_buttons = 0xFFFF;

/// What is given of each point after its place and time.
struct PointFields {
  enum class Kind { sensed, tilt_x, tilt_y, buttons };
  struct Field {
    std::string_view name;
    Kind kind;
    double least, most;
    double StylusState::*member;  ///< of Kind::sensed
  };
  std::vector<Field> all;

  bool has(std::string_view name) const {
    return std::any_of(all.begin(), all.end(), [name](const Field& field) { return field.name == name; });
  }
};

/// Every field that can be given; tilts are only read [deg].
const std::vector<PointFields::Field>& known_fields() {
  using Kind = PointFields::Kind;
  static const std::vector<PointFields::Field> known = [] {
    std::vector<PointFields::Field> fields;
    for (const StylusField& field : stylus_fields) {
      fields.push_back({field.name, Kind::sensed, field.least, field.most, field.member});
    }
    fields.push_back({buttons_name, Kind::buttons, 0.0, max_buttons, nullptr});
    fields.push_back({tilt_x_name, Kind::tilt_x, -90.0, 90.0, nullptr});
    fields.push_back({tilt_y_name, Kind::tilt_y, -90.0, 90.0, nullptr});
    return fields;
  }();
  return known;
}

std::string code_in_hex(char32_t code) {
  char buffer[16];
  char* const end = to_chars(buffer, buffer + sizeof buffer, static_cast<std::uint32_t>(code), 16).ptr;
  std::transform(buffer, end, buffer, [](char c) { return c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c; });
  const std::string digits(buffer, end);
  return std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

template <typename Number, typename... Base>
std::optional<Number> number_in(std::string_view word, Base... base) {
  Number value{};
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = from_chars(word.data(), end, value, base...);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

bool is_character(char32_t code) {
  return code > 0x20 && code != 0x7F && code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF);
}

class TraceParser : private LineReader {
 public:
  TraceParser(ReadBytes bytes, std::string_view name)
      : LineReader(std::move(bytes), name, max_traces_bytes, max_stroke_bytes) {}

  std::vector<PenTrace> parse() {
    std::vector<PenTrace> traces;
    while (next_line()) {
      if (number_of_statements_++ == 0 && line().starts_with("V ")) {
        if (line() != version_2) fail("unknown version " + in_quotes(line()) + ": expected '" + std::string(version_2) + "'");
        is_version_2_ = true;
        continue;
      }
      const std::string_view kind = next_word("C, S or a comment");
      if (kind == "C") {
        require_complete(traces);
        if (traces.size() >= max_traces) fail("more than " + std::to_string(max_traces) + " characters");
        traces.push_back(trace());
      } else if (kind == "S") {
        if (traces.empty()) fail("a stroke before the first character");
        if (traces.back().strokes.size() >= announced_) {
          fail("one stroke too many: the number of strokes given for the character is " + std::to_string(announced_));
        }
        traces.back().strokes.push_back(stroke(traces.back()));
        if (announced_air_ > 0) traces.back().air.emplace_back();
      } else if (kind == "A" && is_version_2_) {
        if (traces.empty()) fail("a pen in the air before the first character");
        if (read_air_++ >= announced_air_) {
          fail("one time in the air too many: their number given for the character is " +
               std::to_string(announced_air_));
        }
        if (!traces.back().air.back().empty()) fail("the pen is in the air twice in a row");
        traces.back().air.back() = stroke(traces.back());
      } else if (kind == "F" && is_version_2_) {
        if (traces.empty()) fail("fields before the first character");
        if (!fields_.all.empty() || !traces.back().strokes.empty() || read_air_ > 0) {
          fail("the fields of a character are given once, before its points");
        }
        read_fields();
      } else {
        fail("the line begins with '" + std::string(kind) + "': expected C, S" + (is_version_2_ ? ", A, F" : "") +
             " or #");
      }
      if (!rest_.empty()) fail("unexpected '" + std::string(rest_.substr(0, 40)) + "' at the end of the line");
    }
    require_complete(traces);
    return traces;
  }

 private:
  /// The next line that holds something.
  bool next_line() {
    while (next_whole()) {
      rest_ = line();
      if (number() == 1 && is_utf16(rest_)) fail("the file is UTF-16, not UTF-8: save it as UTF-8");
      if (!rest_.empty() && rest_.front() != '#') return true;
    }
    return false;
  }

  std::string_view next_word(std::string_view expected) {
    const std::size_t blank = rest_.find(' ');
    const std::string_view word = rest_.substr(0, blank);
    rest_.remove_prefix(blank == std::string_view::npos ? rest_.size() : blank + 1);
    if (word.empty()) fail("expected " + std::string(expected) + ", found the end of the line or an extra space");
    return word;
  }

  double next_number(std::string_view what, double least, double most) {
    const std::string_view word = next_word(what);
    const std::optional<double> value = number_in<double>(word);
    if (value && *value >= least && *value <= most) return *value;
    fail(std::string(what) + " is '" + std::string(word) + "': expected a number from " + shown(least) + " to " +
         shown(most));
  }

  std::size_t next_count(const char* what, std::size_t most) {
    const std::string_view word = next_word(what);
    const auto value = number_in<std::size_t>(word);
    if (value && *value >= 1 && *value <= most) return *value;
    fail(std::string(what) + " is '" + std::string(word) + "': expected 1 to " + std::to_string(most));
  }

  static std::string shown(double value) {
    char buffer[32];
    return {buffer, to_chars(buffer, buffer + sizeof buffer, value).ptr};
  }

  PenTrace trace() {
    PenTrace trace;
    const std::string_view text = next_word("a character");
    const std::string_view hex = next_word("its code");
    const auto code = number_in<std::uint32_t>(hex, 16);
    if (!code || !is_character(*code)) fail("the code is '" + std::string(hex) + "': expected a Unicode character");
    trace.character = *code;
    const std::u32string codes = utf8(text, "the character");
    const std::u32string expected = codes.size() == 2 && is_variation_selector(codes[1]) ? codes.substr(0, 1) : codes;
    if (expected != std::u32string(1, *code)) {
      fail("the character '" + std::string(text) + "' does not match the code " + std::string(hex));
    }
    if (codes.size() == 2) trace.selector = codes[1];
    const std::string_view set = next_word("the name of a set");
    utf8(set, "the name of the set");
    trace.set = set;
    if (trace.set.find('\r') != std::string::npos) fail("the name of the set has a carriage return");
    trace.em = next_number("the em", finest, max_em);
    announced_ = next_count("the number of strokes", max_trace_strokes);
    announced_air_ = 0;
    if (is_version_2_ && !rest_.empty()) {
      announced_air_ = next_count("the number of times in the air", announced_ + 1);
      trace.air.emplace_back();
    }
    read_air_ = 0;
    fields_.all.clear();
    last_time_ = 0.0;
    return trace;
  }

  void read_fields() {
    while (!rest_.empty()) {
      const std::string_view word = next_word("a field");
      const auto& known = known_fields();
      const auto field = std::find_if(known.begin(), known.end(), [word](const auto& each) { return each.name == word; });
      if (field == known.end()) fail("unknown field " + in_quotes(word));
      if (fields_.has(word)) fail("the field '" + std::string(word) + "' is given twice");
      fields_.all.push_back(*field);
    }
    const bool has_tilt = fields_.has(tilt_x_name);
    if (has_tilt != fields_.has(tilt_y_name)) fail("tilt_x and tilt_y are given together");
    if (has_tilt && (fields_.has("altitude") || fields_.has("azimuth"))) {
      fail("either tilts are given, or altitude and azimuth");
    }
  }

  /// What the pen sensed, by the fields of the trace.
  void read_sensed(TimedPoint& point) {
    double tilt_x = 0.0, tilt_y = 0.0;
    for (const PointFields::Field& field : fields_.all) {
      double value = std::numeric_limits<double>::quiet_NaN();
      if (rest_.substr(0, rest_.find(' ')) == absent) {
        next_word("a value");
      } else {
        value = next_number(field.name, field.least, field.most);
      }
      switch (field.kind) {
        case PointFields::Kind::sensed:
          point.stylus.*field.member = value;
          break;
        case PointFields::Kind::tilt_x:
          tilt_x = value * per_degree;
          break;
        case PointFields::Kind::tilt_y:  // of a screen, whose y points down
          tilt_y = -value * per_degree;
          break;
        case PointFields::Kind::buttons:
          if (std::trunc(value) != value && !std::isnan(value)) fail("buttons is not an integer");
          point.buttons = std::isnan(value) ? -1 : static_cast<std::int32_t>(value);
          break;
      }
    }
    if (fields_.has(tilt_x_name)) set_tilt(point.stylus, tilt_x, tilt_y);
  }

  std::u32string utf8(std::string_view word, const std::string& what) const {
    try {
      return decode_utf8(word);
    } catch (const FormatError& error) {
      fail(what + ": " + error.what());
    }
  }

  PenStroke stroke(const PenTrace& trace) {
    const std::size_t count = next_count("the number of points", max_stroke_points);
    // Each value takes a digit and a space: a count beyond them must not be believed.
    if (count > rest_.size() / (2 * (3 + fields_.all.size()) - 1) + 1) fail("the line is too short for " + std::to_string(count) + " points");
    PenStroke stroke;
    stroke.reserve(count);
    const double bound = farthest * trace.em;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = next_number("x", -bound, bound);
      const double y = next_number("y", -bound, bound);
      const double time = next_number("the time", 0.0, max_time * milliseconds);
      if (time < last_time_) fail("the time decreases from " + shown(last_time_) + " to " + shown(time) + " ms");
      last_time_ = time;
      stroke.push_back({{x / trace.em, 1.0 - y / trace.em}, time / milliseconds, {}, -1});
      read_sensed(stroke.back());
    }
    return stroke;
  }

  void require_complete(const std::vector<PenTrace>& traces) const {
    if (traces.empty()) return;
    if (traces.back().strokes.size() == announced_ && read_air_ != announced_air_) {
      fail("the previous character has " + std::to_string(read_air_) + " of " + std::to_string(announced_air_) +
           " times in the air");
    }
    if (traces.back().strokes.size() == announced_) return;
    fail("the previous character has " + std::to_string(traces.back().strokes.size()) + " of " +
         std::to_string(announced_) + " strokes");
  }

  std::string_view rest_;          ///< of the line
  std::size_t number_of_statements_ = 0;
  bool is_version_2_ = false;
  std::size_t announced_ = 0;      ///< strokes of the last character
  std::size_t announced_air_ = 0;  ///< times in the air of it
  std::size_t read_air_ = 0;
  PointFields fields_;             ///< of its points
  double last_time_ = 0.0;         ///< [ms]
};

/// Calls a function with every point of a trace, in the air too.
template <typename Use>
void each_point(const PenTrace& trace, const Use& use) {
  for (const std::vector<PenStroke>* strokes : {&trace.strokes, &trace.air}) {
    for (const PenStroke& stroke : *strokes) std::for_each(stroke.begin(), stroke.end(), use);
  }
}

/// What any point of a trace has.
PointFields fields_of(const PenTrace& trace) {
  PointFields fields;
  for (const PointFields::Field& field : known_fields()) {
    bool any = false;
    each_point(trace, [&](const TimedPoint& point) {
      any = any || (field.kind == PointFields::Kind::buttons && point.buttons >= 0) ||
            (field.kind == PointFields::Kind::sensed && !std::isnan(point.stylus.*field.member));
    });
    if (any) fields.all.push_back(field);
  }
  return fields;
}

std::size_t times_in_air(const PenTrace& trace) {
  const auto is_there = [](const PenStroke& air) { return !air.empty(); };
  return static_cast<std::size_t>(std::count_if(trace.air.begin(), trace.air.end(), is_there));
}

void require_writable(const PenTrace& trace, std::size_t index) {
  const auto require = [index](bool good, const std::string& what) {
    if (!good) throw ValueError("pen trace " + std::to_string(index + 1) + ": " + what);
  };
  require(is_character(trace.character), "its character's code is " + code_in_hex(trace.character));
  require(trace.selector == 0 || is_variation_selector(trace.selector),
          "its variation selector's code is " + code_in_hex(trace.selector));
  require(!trace.set.empty() && trace.set.find_first_of(" \r\n") == std::string::npos,
          "its set is '" + trace.set + "': expected a word");
  decode_utf8(trace.set);
  require(trace.em >= finest && trace.em <= max_em, "its em is " + number_text(trace.em));
  require(!trace.strokes.empty() && trace.strokes.size() <= max_trace_strokes,
          "it has " + std::to_string(trace.strokes.size()) + " strokes");
  require(trace.air.empty() || trace.air.size() == trace.strokes.size() + 1,
          "it is in the air " + std::to_string(trace.air.size()) + " times, with " +
              std::to_string(trace.strokes.size()) + " strokes");
  double last = 0.0;
  const auto check = [&](const PenStroke& stroke, const std::string& place) {
    require(stroke.size() <= max_stroke_points, place + " has " + std::to_string(stroke.size()) + " points");
    for (const TimedPoint& point : stroke) {
      const std::string fault = sample_fault(point, last);
      require(fault.empty(), place + " " + fault);
      last = point.time;
    }
  };
  for (std::size_t i = 0; i < trace.strokes.size(); ++i) {
    const std::string place = "stroke " + std::to_string(i + 1);
    if (!trace.air.empty()) check(trace.air[i], "the air before " + place);
    require(!trace.strokes[i].empty(), place + " has 0 points");
    check(trace.strokes[i], place);
  }
  if (!trace.air.empty()) check(trace.air.back(), "the air after the last stroke");
}

void append_points(std::string& text, char kind, const PenStroke& stroke, double em, const PointFields& fields) {
  text.append(1, kind).append(" ").append(std::to_string(stroke.size()));
  for (const TimedPoint& point : stroke) {
    for (const double value : {point.point.x() * em, (1.0 - point.point.y()) * em, point.time * milliseconds}) {
      append_rounded(text += ' ', value, decimal_places);
    }
    for (const PointFields::Field& field : fields.all) {
      const bool is_buttons = field.kind == PointFields::Kind::buttons;
      const double value = is_buttons ? static_cast<double>(point.buttons) : point.stylus.*field.member;
      text += ' ';
      text += std::isnan(value) || (is_buttons && value < 0.0) ? std::string(absent) : number_text(value);
    }
  }
  text += '\n';
}

void append_notice(std::string& text, std::string_view notice) {
  while (!notice.empty()) {
    const std::size_t end = notice.find('\n');
    text.append("# ").append(notice.substr(0, end)).append("\n");
    notice.remove_prefix(end == std::string_view::npos ? notice.size() : end + 1);
  }
}

}  // namespace

bool is_erasing(const PenStroke& stroke) noexcept {
  return !stroke.empty() && stroke.front().buttons >= 0 &&
         (static_cast<std::uint32_t>(stroke.front().buttons) & eraser_button) != 0;
}

std::string sample_fault(const TimedPoint& point, double last_time) {
  const auto of_range = [](double value, double least, double most, const char* unit) {
    return number_text(value) + unit + ": expected " + number_text(least) + " to " + number_text(most);
  };
  if (!(std::abs(point.point.x()) <= farthest && std::abs(1.0 - point.point.y()) <= farthest)) {
    return "has a point at " + number_text(point.point.x()) + ", " + number_text(point.point.y()) +
           " em: expected at most " + number_text(farthest) + " from the upper left corner of the square";
  }
  if (!(point.time >= last_time)) {
    return "has a time of " + number_text(point.time) + " s after " + number_text(last_time) + " s";
  }
  if (!(point.time <= max_time)) return "has a time of " + of_range(point.time, 0.0, max_time, " s");
  for (const StylusField& field : stylus_fields) {
    const double value = point.stylus.*field.member;
    if (is_valid(field, value)) continue;
    return "has a " + std::string(field.name) + " of " + of_range(value, field.least, field.most, "");
  }
  if (point.buttons < -1 || point.buttons > max_buttons) {
    return "has the buttons " + of_range(point.buttons, -1.0, max_buttons, "");
  }
  return {};
}

std::vector<PenTrace> read_pen_traces(std::istream& in, std::string_view name) {
  return TraceParser(bytes_of(in, name), name).parse();
}

std::vector<PenTrace> parse_pen_traces(std::string_view text, std::string_view name) {
  return TraceParser(bytes_of(text), name).parse();
}

std::vector<PenTrace> read_pen_traces(const std::string& path) {
  std::ifstream in = open_file(path, max_traces_bytes);
  return read_pen_traces(in, path);
}

void write_pen_traces(std::ostream& out, const std::vector<PenTrace>& traces, std::string_view notice) {
  const std::string text = pen_traces_text(traces, notice);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

std::string pen_traces_text(const std::vector<PenTrace>& traces, std::string_view notice) {
  const auto needs_version_2 = [](const PenTrace& trace) {
    return times_in_air(trace) > 0 || !fields_of(trace).all.empty();
  };
  std::string text;
  append_notice(text, notice);
  if (std::any_of(traces.begin(), traces.end(), needs_version_2)) text.append(version_2).append("\n");
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const PenTrace& trace = traces[i];
    require_writable(trace, i);
    const PointFields fields = fields_of(trace);
    text.append("C ").append(encode_utf8(trace.character));
    if (trace.selector != 0) text.append(encode_utf8(trace.selector));
    text.append(" ").append(code_in_hex(trace.character));
    text.append(" ").append(trace.set);
    append_rounded(text += ' ', trace.em, decimal_places);
    text.append(" ").append(std::to_string(trace.strokes.size()));
    const std::size_t in_air = times_in_air(trace);
    if (in_air > 0) text.append(" ").append(std::to_string(in_air));
    text += '\n';
    if (!fields.all.empty()) {
      text += 'F';
      for (const PointFields::Field& field : fields.all) text.append(" ").append(field.name);
      text += '\n';
    }
    for (std::size_t stroke = 0; stroke <= trace.strokes.size(); ++stroke) {
      const bool is_last = stroke == trace.strokes.size();
      if (in_air > 0 && !trace.air[stroke].empty()) append_points(text, 'A', trace.air[stroke], trace.em, fields);
      if (!is_last) append_points(text, 'S', trace.strokes[stroke], trace.em, fields);
    }
  }
  return text;
}

}  // namespace calligraphy
