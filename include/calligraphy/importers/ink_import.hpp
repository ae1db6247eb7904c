// Pen recordings in other formats, read as pen traces (docs/pen-traces.md, "From other formats").
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/judge/y_axis.hpp>
#include <calligraphy/model/character_text.hpp>

namespace calligraphy {

/// Format of a pen recording.
enum class InkFormat {
  inkml,          ///< W3C Ink Markup Language
  signature_pad,  ///< JSON of signature_pad's toData(), by its newer or older versions
  tegaki,         ///< XML of a character, or of a collection of characters
  svc,            ///< of tablets in research on handwriting, as in SVC2004
  csv,            ///< a table with a header that names its columns
  pen_traces      ///< the library's own text format
};

/// "InkML", "signature_pad", "Tegaki", "SVC", "CSV", "pen traces".
const char* to_string(InkFormat format) noexcept;

/// What import_ink() cannot know from the file.
struct InkOptions {
  /// The characters that were written, in order, of those that the file does not name; see text_characters().
  std::vector<TextCharacter> text;
  /// Where y of the file points. Empty: as the file declares, else as the writing shows (recognise_y_axis()), else as is
  /// usual of the format.
  std::optional<YAxis> y_axis;
  /// PenTrace::set of every trace; empty: the name of the file without its endings, as one word.
  std::string set;
};

/// What import_ink() read.
struct InkImport {
  InkFormat format = InkFormat::pen_traces;  ///< recognised by the content
  std::vector<PenTrace> traces;              ///< with every sample of the file
  std::vector<std::string> notes;            ///< what was assumed, in words
  std::size_t text_used = 0;                 ///< number of characters taken from InkOptions::text
};

/// Reads the content of a file of at most 64 MiB; its format is recognised by the content. `name` begins messages; a
/// character in it names what was written if nothing else does, as in 永-1.svc or U+6C38.csv.
///
/// Times begin at 0. A trace fills 0.8 em of its square, unless the file says how large the square is. Pressure is
/// scaled to 0 to 1. What the file does not tell is NaN.
/// @throws FormatError naming the file, the place and the value if it is malformed, of no known format, in UTF-16 or
///         without the characters that were written; ValueError if `set` is not one word
InkImport import_ink(std::string_view bytes, std::string_view name, const InkOptions& options = {});

}  // namespace calligraphy
