#include <calligraphy/judge/pen_trace.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <system_error>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>

#include "base/charconv.hpp"
#include "base/line_reader.hpp"
#include "base/require.hpp"

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

constexpr double milliseconds = 1e3;

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
  TraceParser(std::istream& in, std::string_view name)
      : LineReader(bytes_of(in, name), name, max_traces_bytes, max_stroke_bytes) {}

  std::vector<PenTrace> parse() {
    std::vector<PenTrace> traces;
    while (next_line()) {
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
      } else {
        fail("the line begins with '" + std::string(kind) + "': expected C, S or #");
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
      if (!rest_.empty() && rest_.front() != '#') return true;
    }
    return false;
  }

  std::string_view next_word(const char* expected) {
    const std::size_t blank = rest_.find(' ');
    const std::string_view word = rest_.substr(0, blank);
    rest_.remove_prefix(blank == std::string_view::npos ? rest_.size() : blank + 1);
    if (word.empty()) fail(std::string("expected ") + expected + ", found the end of the line or an extra space");
    return word;
  }

  double next_number(const char* what, double least, double most) {
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
    if (encode_utf8(trace.character) != text) {
      fail("the character does not match the code " + std::string(hex) + ", or is not UTF-8");
    }
    trace.set = utf8(next_word("the name of a set"));
    trace.em = next_number("the em", finest, max_em);
    announced_ = next_count("the number of strokes", max_trace_strokes);
    last_time_ = 0.0;
    return trace;
  }

  std::string utf8(std::string_view word) const {
    try {
      decode_utf8(word);
    } catch (const FormatError& error) {
      fail(std::string("the name of the set: ") + error.what());
    }
    return std::string(word);
  }

  PenStroke stroke(const PenTrace& trace) {
    const std::size_t count = next_count("the number of points", max_stroke_points);
    // Each point is a word of three numbers: a count beyond them must not be believed.
    if (count > rest_.size() / 5 + 1) fail("the line is too short for " + std::to_string(count) + " points");
    PenStroke stroke;
    stroke.reserve(count);
    const double bound = farthest * trace.em;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = next_number("x", -bound, bound);
      const double y = next_number("y", -bound, bound);
      const double time = next_number("the time", 0.0, max_time * milliseconds);
      if (time < last_time_) fail("the time decreases from " + shown(last_time_) + " to " + shown(time) + " ms");
      last_time_ = time;
      stroke.push_back({{x / trace.em, 1.0 - y / trace.em}, time / milliseconds});
    }
    return stroke;
  }

  void require_complete(const std::vector<PenTrace>& traces) const {
    if (traces.empty() || traces.back().strokes.size() == announced_) return;
    fail("the previous character has " + std::to_string(traces.back().strokes.size()) + " of " +
         std::to_string(announced_) + " strokes");
  }

  std::string_view rest_;      ///< of the line
  std::size_t announced_ = 0;  ///< strokes of the last character
  double last_time_ = 0.0;     ///< [ms]
};

void append_rounded(std::string& text, double value) {
  char buffer[64];
  const double rounded = std::round(value / finest) * finest;
  char* end = to_chars_fixed(buffer, buffer + sizeof buffer, rounded, 6).ptr;
  while (end[-1] == '0') --end;
  if (end[-1] == '.') --end;
  const std::string_view digits(buffer, static_cast<std::size_t>(end - buffer));
  text += ' ';
  text += digits == "-0" ? "0" : digits;
}

void require_writable(const PenTrace& trace, std::size_t index) {
  const auto require = [index](bool good, const std::string& what) {
    if (!good) throw ValueError("pen trace " + std::to_string(index + 1) + ": " + what);
  };
  require(is_character(trace.character), "its character's code is " + code_in_hex(trace.character));
  require(!trace.set.empty() && trace.set.find_first_of(" \r\n") == std::string::npos,
          "its set is '" + trace.set + "': expected a word");
  decode_utf8(trace.set);
  require(trace.em >= finest && trace.em <= max_em, "its em is " + number_text(trace.em));
  require(!trace.strokes.empty() && trace.strokes.size() <= max_trace_strokes,
          "it has " + std::to_string(trace.strokes.size()) + " strokes");
  double last = 0.0;
  for (std::size_t i = 0; i < trace.strokes.size(); ++i) {
    const std::string place = "stroke " + std::to_string(i + 1);
    const PenStroke& stroke = trace.strokes[i];
    require(!stroke.empty() && stroke.size() <= max_stroke_points,
            place + " has " + std::to_string(stroke.size()) + " points");
    for (const TimedPoint& point : stroke) {
      require(std::abs(point.point.x()) <= farthest && std::abs(1.0 - point.point.y()) <= farthest,
              place + " has a point at " + number_text(point.point.x()) + ", " + number_text(point.point.y()));
      require(point.time >= last && point.time <= max_time,
              place + " has a time of " + number_text(point.time) + " s after " + number_text(last) + " s");
      last = point.time;
    }
  }
}

void append_notice(std::string& text, std::string_view notice) {
  while (!notice.empty()) {
    const std::size_t end = notice.find('\n');
    text.append("# ").append(notice.substr(0, end)).append("\n");
    notice.remove_prefix(end == std::string_view::npos ? notice.size() : end + 1);
  }
}

}  // namespace

std::vector<PenTrace> read_pen_traces(std::istream& in, std::string_view name) { return TraceParser(in, name).parse(); }

std::vector<PenTrace> read_pen_traces(const std::string& path) {
  std::ifstream in = open_file(path, max_traces_bytes);
  return read_pen_traces(in, path);
}

void write_pen_traces(std::ostream& out, const std::vector<PenTrace>& traces, std::string_view notice) {
  std::string text;
  append_notice(text, notice);
  for (std::size_t i = 0; i < traces.size(); ++i) {
    const PenTrace& trace = traces[i];
    require_writable(trace, i);
    text.append("C ").append(encode_utf8(trace.character)).append(" ").append(code_in_hex(trace.character));
    text.append(" ").append(trace.set);
    append_rounded(text, trace.em);
    text.append(" ").append(std::to_string(trace.strokes.size())).append("\n");
    for (const PenStroke& stroke : trace.strokes) {
      text.append("S ").append(std::to_string(stroke.size()));
      for (const TimedPoint& point : stroke) {
        append_rounded(text, point.point.x() * trace.em);
        append_rounded(text, (1.0 - point.point.y()) * trace.em);
        append_rounded(text, point.time * milliseconds);
      }
      text += '\n';
    }
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace calligraphy
