// The recorded pen of a person writing a character, and its text format (docs/pen-traces.md).
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/base/stylus_state.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// A sample of a recorded pen.
struct TimedPoint {
  Point point = Point::Zero();  ///< in the square that the person wrote in: unit square, y up [em]
  double time = 0.0;            ///< never decreases within a trace [s]
  StylusState stylus = {};      ///< what the pen sensed besides; the x-y plane is the paper
  std::int32_t buttons = -1;    ///< bits such as eraser_button; -1: unknown
};

using PenStroke = std::vector<TimedPoint>;  ///< one pen-down, at least one point

/// Whether a pen-down is of the eraser (eraser_button), by its first sample: it writes nothing.
bool is_erasing(const PenStroke& stroke) noexcept;

/// The recorded pen of a person writing one character.
struct PenTrace {
  char32_t character = 0;          ///< the character to be written
  std::string set;                 ///< one word that names the source: a writer, a session, a corpus
  double em = 1000.0;              ///< edge length of the square in the file's units [1]
  std::vector<PenStroke> strokes;  ///< pen-downs in the order of writing, which need not match strokes of the character
  /// The pen in the air before each pen-down, and after the last: one more than there are strokes, each of which may be
  /// empty. Empty: not recorded.
  std::vector<PenStroke> air = {};
  char32_t selector = 0;  ///< variation selector after the character, which asks for one of its forms; 0: none
};

/// Reads the text format, of this version or an older one. `name` is used in messages.
/// @throws FormatError naming the line and the value, also when the file is truncated; FileError when the stream fails.
/// Never returns part of a file
std::vector<PenTrace> read_pen_traces(std::istream& in, std::string_view name);
/// Reads the text of a file in this format. @throws FormatError as above
std::vector<PenTrace> parse_pen_traces(std::string_view text, std::string_view name);
/// Reads a file in this format. @throws FileError when it cannot be opened, FormatError as above
std::vector<PenTrace> read_pen_traces(const std::string& path);

/// Writes the text format: coordinates to 1e-6 of its unit, times to 1e-6 ms, the rest exactly. Each line of `notice`
/// becomes a comment. Traces without anything that version 1 lacks are written in version 1.
/// @throws ValueError naming the trace and the value when read_pen_traces would reject it
void write_pen_traces(std::ostream& out, const std::vector<PenTrace>& traces, std::string_view notice = {});
/// What write_pen_traces() writes. @throws ValueError likewise
std::string pen_traces_text(const std::vector<PenTrace>& traces, std::string_view notice = {});

}  // namespace calligraphy
