#include "line_reader.hpp"

#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

namespace calligraphy {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 60;
  if (text.size() <= most) return "'" + printable(text) + "'";
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a character
  return "'" + printable(text.substr(0, end)) + "...'";
}

bool LineReader::next() {
  ++number_;
  line_.clear();
  bool found = false;
  for (char chunk[1 << 12];;) {  // a line is no longer in memory than the text may be
    in_.getline(chunk, sizeof chunk);
    if (in_.bad()) throw FileError(name_ + ": cannot be read");
    const auto count = static_cast<std::size_t>(in_.gcount());
    found = found || count > 0;
    read_ += count;
    if (read_ > max_bytes_) fail("longer than the " + std::to_string(max_bytes_) + " bytes that are read");
    const bool has_end = !in_.eof() && !in_.fail();
    line_.append(chunk, has_end ? count - 1 : count);
    if (line_.size() > max_line_bytes_) {
      fail("the line is longer than " + std::to_string(max_line_bytes_) + " bytes: it begins with " +
           calligraphy::in_quotes(line_));
    }
    if (has_end || in_.eof() || count + 1 < sizeof chunk) break;
    in_.clear();  // only the chunk was full
  }
  if (number_ == 1 && line_.starts_with(byte_order_mark)) line_.erase(0, byte_order_mark.size());
  if (line_.ends_with('\r')) line_.pop_back();
  left_ = line_;
  return found;
}

bool LineReader::next_whole() {
  const bool found = next();
  if (found && in_.eof()) {
    constexpr std::size_t most = 40;
    fail("the file is truncated after '" + printable(line_.substr(line_.size() - std::min(line_.size(), most))) + "'");
  }
  return found;
}

std::string_view LineReader::word() noexcept {
  left_.remove_prefix(std::min(left_.find_first_not_of(blanks), left_.size()));
  const std::string_view found = left_.substr(0, left_.find_first_of(blanks));
  left_.remove_prefix(found.size());
  return found;
}

std::string_view LineReader::rest() noexcept {
  left_.remove_prefix(std::min(left_.find_first_not_of(blanks), left_.size()));
  return std::exchange(left_, {});
}

std::string LineReader::in_quotes(std::string_view word) const {
  return word.empty() && left_.empty() ? "the end of the line" : calligraphy::in_quotes(word);
}

void LineReader::fail_at(int line, const std::string& what) const {
  throw FormatError(name_ + ":" + std::to_string(line) + ": " + what);
}

}  // namespace calligraphy
