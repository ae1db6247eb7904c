#include "line_reader.hpp"

#include <istream>
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
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not inside a character
  return "'" + printable(text.substr(0, end)) + "...'";
}

ReadBytes bytes_of(std::string_view text) {
  return [text](char* to, std::size_t most) mutable {
    const std::size_t count = text.copy(to, most);
    text.remove_prefix(count);
    return count;
  };
}

ReadBytes bytes_of(std::istream& in, std::string_view name) {
  return [&in, name = std::string(name)](char* to, std::size_t most) {
    in.read(to, static_cast<std::streamsize>(most));
    if (in.bad()) throw FileError(name + ": cannot be read");
    return static_cast<std::size_t>(in.gcount());
  };
}

bool LineReader::next() {
  ++number_;
  line_.clear();
  bool found = false;
  for (bool has_end = false; !has_end;) {  // bounds the line in memory by the limit on the text
    if (unread_.empty()) {
      unread_ = {chunk_.data(), read_bytes_(chunk_.data(), chunk_.size())};
      at_end_ = unread_.empty();
      if (at_end_) break;
    }
    found = true;
    const std::size_t end = unread_.find('\n');
    has_end = end != std::string_view::npos;
    const std::size_t count = has_end ? end + 1 : unread_.size();
    read_ += count;
    if (read_ > max_bytes_) fail("longer than the " + std::to_string(max_bytes_) + " bytes that are read");
    line_ += unread_.substr(0, end);
    unread_.remove_prefix(count);
    if (line_.size() > max_line_bytes_) {
      fail("the line is longer than " + std::to_string(max_line_bytes_) + " bytes: it begins with " +
           calligraphy::in_quotes(line_));
    }
  }
  if (number_ == 1 && line_.starts_with(byte_order_mark)) line_.erase(0, byte_order_mark.size());
  if (line_.ends_with('\r')) line_.pop_back();
  left_ = line_;
  return found;
}

bool LineReader::next_whole() {
  const bool found = next();
  if (found && at_end_) {
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
