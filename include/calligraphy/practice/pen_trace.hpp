// What a person's pen did while it wrote a character, and the text format for it (docs/pen-traces.md).
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

struct TimedPoint {
  Point point = Point::Zero();  ///< in the square that was written in: unit square, y up [em]
  double time = 0.0;            ///< never falls within a trace [s]
};

using PenStroke = std::vector<TimedPoint>;  ///< one pen-down, at least one point

struct PenTrace {
  char32_t character = 0;  ///< what was to be written
  std::string set;         ///< a word for where it comes from: a writer, a session, a corpus
  double em = 1000.0;      ///< edge of the square in the file's units [1]
  std::vector<PenStroke> strokes;
};

/// Reads the text format. `name` is used in messages.
/// @throws FormatError naming the line and the value, also when the file is cut off; FileError when the stream fails.
/// Nothing is returned in part
std::vector<PenTrace> read_pen_traces(std::istream& in, std::string_view name);
/// @throws FileError when the file cannot be opened, FormatError as above
std::vector<PenTrace> read_pen_traces(const std::string& path);

/// Writes the text format: coordinates to 1e-6 of its unit, times to 1e-6 ms. Each line of `notice` becomes a comment.
/// @throws ValueError naming the trace and the value when read_pen_traces would not take it
void write_pen_traces(std::ostream& out, const std::vector<PenTrace>& traces, std::string_view notice = {});

}  // namespace calligraphy
