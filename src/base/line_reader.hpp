// Reads text line by line; every error names its source and line.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace calligraphy {

/// How the rest of a line is read, after its first word.
enum class LineKind {
  words,     ///< words; '#' begins a comment
  text,      ///< text to the end of the line, including '#', without trailing blanks
  verbatim,  ///< text to the end of the line, including trailing blanks
};

/// The text as shown in messages, printable and shortened: a binary file may be a single line of any length.
std::string in_quotes(std::string_view text);

/// Reads at most `most` bytes of a text to an address and returns their number; 0 at the end.
using ReadBytes = std::function<std::size_t(char* to, std::size_t most)>;
/// Reads a text in memory, or a stream; both must outlive the result. `name` begins the message.
/// @throws FileError from the returned function if the stream fails
ReadBytes bytes_of(std::string_view text);
ReadBytes bytes_of(std::istream& in, std::string_view name);

/// Base of the parsers of text formats: reads lines that end with "\n" or "\r\n"; a byte order mark is skipped.
class LineReader {
 public:
  /// `name` begins every message. Reads at most `max_bytes`, and at most `max_line_bytes` per line.
  LineReader(ReadBytes read, std::string_view name, std::size_t max_bytes = std::numeric_limits<std::size_t>::max(),
             std::size_t max_line_bytes = std::numeric_limits<std::size_t>::max())
      : read_bytes_(std::move(read)), name_(name), max_bytes_(max_bytes), max_line_bytes_(max_line_bytes) {}

  /// Reads the next line. Returns false at the end; line() is then empty.
  /// @throws FileError as ReadBytes; FormatError when the text or the line is too long
  bool next();

  /// Reads the next line, which must end with a line break: otherwise its last number may have been cut in two.
  bool next_whole();

  /// Whether the line ends with a line break: only the last one of a text may not.
  bool is_whole() const noexcept { return !at_end_; }

  /// Reads the next line that has more than blanks and a comment. `kind_of(first_word)` is its LineKind.
  template <typename KindOf>
  bool next_statement(const KindOf& kind_of) {
    while (next()) {
      const LineKind kind = kind_of(word());
      if (kind == LineKind::words) line_.erase(std::min(line_.find('#'), line_.size()));
      if (kind != LineKind::verbatim) line_.erase(line_.find_last_not_of(" \t\r") + 1);
      left_ = line_;
      if (!line_.empty()) return true;
    }
    return false;
  }

  const std::string& line() const noexcept { return line_; }
  int number() const noexcept { return number_; }
  const std::string& name() const noexcept { return name_; }

  /// The next word of the line, up to a blank or a tab; empty at the end of the line.
  std::string_view word() noexcept;

  /// All following words, unchanged.
  std::string_view rest() noexcept;

  /// The unread text after the last word.
  std::string_view left() const noexcept { return left_; }
  void set_left(std::string_view left) noexcept { left_ = left; }

  /// A word as shown in messages; "the end of the line" if there was no word left.
  std::string in_quotes(std::string_view word) const;

  /// @throws FormatError "NAME:LINE: what"
  [[noreturn]] void fail(const std::string& what) const { fail_at(number_, what); }
  [[noreturn]] void fail_at(int line, const std::string& what) const;

 private:
  ReadBytes read_bytes_;
  std::array<char, 1 << 12> chunk_;
  std::string_view unread_;  ///< of the chunk
  bool at_end_ = false;      ///< the last line had no end
  std::string name_;
  std::size_t max_bytes_;
  std::size_t max_line_bytes_;
  std::size_t read_ = 0;  ///< [bytes]
  std::string line_;
  std::string_view left_;  ///< of line_
  int number_ = 0;
};

}  // namespace calligraphy
