// Text read line by line: every error names its source and line.
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

/// How a line goes on after its first word.
enum class LineKind {
  words,     ///< words; '#' begins a comment
  text,      ///< text to the end of the line, '#' and all, but without trailing blanks
  verbatim,  ///< text, trailing blanks and all
};

/// The text as a message shows it, printable and shortened: a file that is no text may be a single line of any length.
std::string in_quotes(std::string_view text);

/// Reads the next bytes of a text, at most so many, to an address, and returns how many; 0: there are no more.
using ReadBytes = std::function<std::size_t(char* to, std::size_t most)>;
/// The bytes of a text in memory, and of a stream; both must outlive the result. `name` begins the message.
/// @throws FileError from a call, if the stream fails
ReadBytes bytes_of(std::string_view text);
ReadBytes bytes_of(std::istream& in, std::string_view name);

/// Base of the parsers of text formats: reads lines that end with "\n" or "\r\n"; a byte order mark is skipped.
class LineReader {
 public:
  /// `name` begins every message. No more than `max_bytes` are read, and of a line no more than `max_line_bytes`.
  LineReader(ReadBytes read, std::string_view name, std::size_t max_bytes = std::numeric_limits<std::size_t>::max(),
             std::size_t max_line_bytes = std::numeric_limits<std::size_t>::max())
      : read_bytes_(std::move(read)), name_(name), max_bytes_(max_bytes), max_line_bytes_(max_line_bytes) {}

  /// The next line. False: there are no more, and line() is empty.
  /// @throws FileError as ReadBytes; FormatError when the text or the line is longer than it may be
  bool next();

  /// The next line, which must have its end: without it, its last number may have been cut in two.
  bool next_whole();

  /// The next line that is more than blanks and a comment. `kind_of(first_word)` is its LineKind.
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

  /// All words that follow, as they stand.
  std::string_view rest() noexcept;

  /// What follows the last word, still to be read.
  std::string_view left() const noexcept { return left_; }
  void set_left(std::string_view left) noexcept { left_ = left; }

  /// A word as a message shows it: "the end of the line", where it is empty for want of more.
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
