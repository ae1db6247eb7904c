// A pen recording as a file has it: in its own units, and what it says of them.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/ink_import.hpp>

#include "base/charconv.hpp"

namespace calligraphy {

/// A pen-down, or the pen in the air, in the file's units. NaN: not given.
struct InkRun {
  PenStroke samples;
  bool in_air = false;
};

/// What was written as one character.
struct InkGroup {
  std::string label;                                           ///< of the file, in UTF-8; empty: none
  double square = std::numeric_limits<double>::quiet_NaN();    ///< edge of its square, from 0, if it is known
  std::vector<InkRun> runs = {};
};

struct InkFile {
  InkFormat format = InkFormat::pen_traces;
  std::vector<InkGroup> groups = {};
  double time_unit = std::numeric_limits<double>::quiet_NaN();   ///< [s]; NaN: to be seen from the times
  double angle_unit = std::numeric_limits<double>::quiet_NaN();  ///< [rad]; NaN: to be seen from the angles
  bool azimuth_from_north = false;  ///< clockwise from above; else from x of the file towards its y
  bool pressure_is_scaled = false;  ///< to 0 to 1, by what the file declares
  std::optional<YAxis> declared = {};
  YAxis usual = YAxis::down;
  std::vector<std::string> notes = {};
};

inline constexpr std::size_t max_ink_bytes = 64 << 20;
inline constexpr std::size_t max_xml_bytes = 16 << 20;  ///< take 16 times that in memory; a page of writing has 0.1 MB
inline constexpr std::size_t max_ink_strokes = 1000;     ///< of a character
inline constexpr std::size_t max_ink_points = 1000000;   ///< of a stroke
inline constexpr std::size_t max_ink_groups = 1000000;

[[noreturn]] inline void fail_ink(std::string_view name, const std::string& what) {
  throw FormatError(std::string(name) + ": " + what);
}

/// The number that a text is, if it is one and finite.
inline std::optional<double> finite_number(std::string_view text) noexcept {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end || text.empty() || !std::isfinite(value)) return std::nullopt;
  return value;
}

inline std::string_view trimmed(std::string_view text) noexcept {
  constexpr std::string_view blanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// A new run; @throws FormatError if there are too many
InkRun& add_run(InkGroup& group, bool in_air, std::string_view name);
/// Adds a sample; @throws FormatError if there are too many
void add_sample(InkRun& run, const TimedPoint& sample, std::string_view name);

/// A sample at a place of the file, at no known time.
inline TimedPoint sample_at(double x, double y) {
  return {{x, y}, std::numeric_limits<double>::quiet_NaN(), {}, -1};
}

// The readers, by format. All of them: @throws FormatError naming the place and the value
InkFile read_inkml(std::string_view text, std::string_view name);
InkFile read_tegaki(std::string_view text, std::string_view name);
InkFile read_signature_pad(std::string_view text, std::string_view name);
InkFile read_svc(std::string_view text, std::string_view name);
InkFile read_ink_table(std::string_view text, std::string_view name);

/// Whether the text begins as a file of that format does.
bool is_svc(std::string_view text);
bool is_ink_table(std::string_view text);

/// Traces in em and seconds, with what had to be assumed. @throws FormatError as import_ink()
InkImport traces_of(InkFile file, std::string_view name, const InkOptions& options);

/// The character that the name of a file gives, or 0.
char32_t character_in_name(std::string_view name);
/// The name of a file without directories and endings, as one word.
std::string word_of_name(std::string_view name);

}  // namespace calligraphy
