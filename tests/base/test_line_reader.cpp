// Claims about LineReader: lines, their words, and errors that name source and line.
#include "../catch.hpp"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>

#include "base/line_reader.hpp"

using namespace calligraphy;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  LineReader reader(bytes_of(in, "name"), "name"), in_memory(bytes_of(text), "name");
  std::vector<std::string> lines;
  while (reader.next()) {
    lines.push_back(reader.line());
    CHECK((in_memory.next() && in_memory.line() == reader.line()));
  }
  CHECK(!in_memory.next());
  return lines;
}

template <typename Act>
std::string message(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("lines end with either kind of end, and the last one with the text", "[base]") {
  using Lines = std::vector<std::string>;
  CHECK(lines_of("").empty());
  CHECK(lines_of("\n") == Lines{""});
  CHECK(lines_of("a\r\n\nb") == Lines{"a", "", "b"});
  CHECK(lines_of("a\n") == Lines{"a"});
  CHECK(lines_of("\xEF\xBB\xBF"
                 "a\n\xEF\xBB\xBF"
                 "b\n") == Lines{"a",
                                 "\xEF\xBB\xBF"
                                 "b"});
  CHECK(lines_of(std::string("a\0b\n", 4)) == Lines{std::string("a\0b", 3)});
}

TEST_CASE("a line of any length is read whole", "[base]") {
  for (const std::size_t size : {4094u, 4095u, 4096u, 8190u, 8191u, 100000u}) {
    CAPTURE(size);
    const std::string line(size, 'x');
    CHECK(lines_of(line + "\nend\n") == std::vector<std::string>{line, "end"});
    CHECK(lines_of(line) == std::vector<std::string>{line});
  }
}

TEST_CASE("a stream that fails is an error that names it", "[base]") {
  std::ifstream directory("/");  // opens, but cannot be read
  LineReader reader(bytes_of(directory, "here"), "here");
  CHECK(message([&] { reader.next(); }) == "here: cannot be read");
}

TEST_CASE("an error names the source and the line", "[base]") {
  std::istringstream in("a\nb\nc\n");
  LineReader reader(bytes_of(in, "list.txt"), "list.txt");
  reader.next();
  reader.next();
  CHECK(message([&] { reader.fail("no such word"); }) == "list.txt:2: no such word");
  CHECK(message([&] { reader.fail_at(1, "no such word"); }) == "list.txt:1: no such word");
}

TEST_CASE("a text longer than it may be is refused before it is in memory", "[base]") {
  std::istringstream fits("12\n45\n"), longer("12\n456\n");
  LineReader whole(bytes_of(fits, "a.txt"), "a.txt", 6), cut(bytes_of(longer, "a.txt"), "a.txt", 6);
  CHECK((whole.next() && whole.next() && !whole.next()));
  CHECK(cut.next());
  CHECK(message([&] { cut.next(); }) == "a.txt:2: longer than the 6 bytes that are read");
}

TEST_CASE("a line longer than it may be is refused, and its beginning quoted", "[base]") {
  const std::string long_line(100'000, 'x');
  std::istringstream in("1234\n" + long_line + "\n");
  LineReader reader(bytes_of(in, "a.txt"), "a.txt", 1 << 20, 4);
  CHECK(reader.next());
  CHECK(message([&] { reader.next(); }) ==
        "a.txt:2: the line is longer than 4 bytes: it begins with '" + std::string(60, 'x') + "...'");
}

TEST_CASE("a last line that was cut off is refused where a line must have its end", "[base]") {
  std::istringstream in("a\n1.2");
  LineReader reader(bytes_of(in, "a.csv"), "a.csv");
  CHECK(reader.next_whole());
  CHECK(message([&] { reader.next_whole(); }) == "a.csv:2: the file is truncated after '1.2'");
}

TEST_CASE("a statement is what is left without comments and blanks, as its first word has it", "[base]") {
  std::istringstream in("# nothing\n\n  one two # three\nname  four # five \t\nraw  six # \r\nend\t\r\n");
  LineReader reader(bytes_of(in, "name"), "name");
  const auto kind_of = [](std::string_view key) {
    return key == "raw" ? LineKind::verbatim : key == "name" ? LineKind::text : LineKind::words;
  };
  REQUIRE(reader.next_statement(kind_of));
  CHECK(reader.number() == 3);
  CHECK(reader.word() == "one");
  CHECK(reader.word() == "two");
  CHECK(reader.word().empty());
  CHECK(reader.in_quotes("") == "the end of the line");
  REQUIRE(reader.next_statement(kind_of));
  CHECK(reader.word() == "name");
  CHECK(reader.in_quotes("") == "''");
  CHECK(reader.rest() == "four # five");
  REQUIRE(reader.next_statement(kind_of));
  CHECK(reader.word() == "raw");
  CHECK(reader.left() == "  six # ");
  REQUIRE(reader.next_statement(kind_of));
  CHECK(reader.line() == "end");
  CHECK_FALSE(reader.next_statement(kind_of));
}

TEST_CASE("what is quoted in a message is short", "[base]") {
  CHECK(in_quotes("a") == "'a'");
  CHECK(in_quotes(std::string(1000, 'x')) == "'" + std::string(60, 'x') + "...'");
}
