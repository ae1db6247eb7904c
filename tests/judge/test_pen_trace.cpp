#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstddef>
#include <limits>
#include <locale>
#include <sstream>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/judge/pen_trace.hpp>

#include "../catch.hpp"
#include "../endless_text.hpp"
#include "../temporary_directory.hpp"
#include "pen_traces.hpp"

using namespace calligraphy;

namespace {

const std::string good =
    "# made up for this test\n"
    "C 二 4E8C made-up 200 2\n"
    "S 3 20 60 0 100.5 58 125 180 60 250\n"
    "\n"
    "S 2 10 160 700 190 160 700.25\r\n"
    "C 一 4E00 made-up 1000 1\n"
    "S 1 500 500 1\n";

/// Every kind of line of version 2, and a character without any.
const std::string with_senses =
    "# made up for this test\n"
    "V 2\n"
    "C 十 5341 made-up 1000 2 2\n"
    "F pressure force altitude azimuth twist height buttons\n"
    "A 1 90 500 0 0 - 1.25 -2.5 0.5 0.0125 0\n"
    "S 2 100 500 10 0.12890625 0.6 1.25 -2.5 0.5 - 33 900 480 330 - - - - - - -\n"
    "S 1 500 80 900 1 0 0 0 0 0 1\n"
    "A 2 500 80 901 - - - - - 0.005 0 490 90 950 - - - - - 0.008 0\n"
    "C 一 4E00 made-up 1000 1\n"
    "S 1 500 500 1\n";

std::vector<PenTrace> read(const std::string& text) {
  std::istringstream in(text);
  return read_pen_traces(in, "pens.txt");
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "accepted";
}

std::string written(const std::vector<PenTrace>& traces, std::string_view notice = {}) {
  std::ostringstream out;
  write_pen_traces(out, traces, notice);
  return out.str();
}

struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("a pen trace is read in em, y up, and in seconds", "[judge]") {
  const auto traces = read(good);
  REQUIRE(traces.size() == 2);
  CHECK(traces[0].character == U'二');
  CHECK(traces[0].set == "made-up");
  CHECK(traces[0].em == 200.0);
  REQUIRE(traces[0].strokes.size() == 2);
  REQUIRE(traces[0].strokes[0].size() == 3);
  CHECK(traces[0].strokes[0][1].point.x() == Approx(0.5025));
  CHECK(traces[0].strokes[0][1].point.y() == Approx(0.71));
  CHECK(traces[0].strokes[0][1].time == Approx(0.125));
  CHECK(traces[0].strokes[1][1].time == Approx(0.70025));
  CHECK(traces[1].strokes[0].size() == 1);
}

TEST_CASE("reading and writing a pen trace reproduces the text", "[judge]") {
  const std::string text = written(read(good), "made up\nby hand");
  CHECK(text ==
        "# made up\n# by hand\n"
        "C 二 4E8C made-up 200 2\nS 3 20 60 0 100.5 58 125 180 60 250\nS 2 10 160 700 190 160 700.25\n"
        "C 一 4E00 made-up 1000 1\nS 1 500 500 1\n");
  CHECK(written(read(text)) == text.substr(text.find("C ")));
}

TEST_CASE("what a pen senses besides its place comes back to the last bit", "[judge]") {
  const std::vector<PenTrace> traces = read(with_senses);
  const TimedPoint& first = traces[0].strokes[0][0];
  CHECK(first.stylus == StylusState{0.12890625, 0.6, 1.25, -2.5, 0.5, std::nan("")});
  CHECK(first.buttons == static_cast<int>(tip_button | eraser_button));
  CHECK(traces[0].strokes[0][1].stylus == StylusState());
  CHECK(traces[0].strokes[0][1].buttons == -1);
  REQUIRE(traces[0].air.size() == 3);
  CHECK(traces[0].air[1].empty());
  CHECK(traces[0].air[2][1].stylus.height == 0.008);
  CHECK(written(traces, "made up for this test") == with_senses);
  CHECK(traces[1].air.empty());
}

TEST_CASE("a variation selector stays with its character", "[judge]") {
  const std::string text = "C 葛\U000E0101 845B t 1000 1\nS 1 100 500 0\n";
  const std::vector<PenTrace> traces = parse_pen_traces(text, "traces");
  CHECK((traces[0].character == U'葛' && traces[0].selector == U'\U000E0101'));
  CHECK(pen_traces_text(traces) == text);
}

TEST_CASE("what the eraser did is no writing", "[judge]") {
  const PenTrace trace = read(with_senses)[0];
  CHECK(is_erasing(trace.strokes[0]));
  CHECK_FALSE(is_erasing(trace.strokes[1]));
  CHECK(pen_paths(trace) == std::vector<PenPath>{{Point(0.5, 0.92)}});
}

TEST_CASE("tilts in degrees, as browsers have them, become altitude and azimuth", "[judge]") {
  // W3C Pointer Events Level 3, sec. 10.3: azimuthAngle 0 is to the right, pi / 2 towards the user, who is below.
  const auto sensed = [](const std::string& tilts) {
    const std::string head = "V 2\nC 一 4E00 made-up 1000 1\nF tilt_x tilt_y\n";
    return read(head + "S 1 500 500 1 " + tilts + "\n")[0].strokes[0][0].stylus;
  };
  constexpr double right = 1.5707963267948966;
  CHECK(sensed("0 0").altitude == Approx(right));
  CHECK(sensed("30 0").altitude == Approx(right * 60.0 / 90.0));
  CHECK(sensed("30 0").azimuth == 0.0);
  CHECK(sensed("-30 0").azimuth == Approx(2.0 * right));
  CHECK(sensed("0 30").azimuth == Approx(-right));
  CHECK(sensed("45 45").azimuth == Approx(-0.5 * right));
  CHECK(sensed("45 45").altitude == Approx(std::atan(1.0 / std::sqrt(2.0))));
  CHECK(sensed("90 0").altitude == Approx(0.0).margin(1e-12));
  CHECK(std::isnan(sensed("- 0").altitude));
  CHECK(std::isnan(sensed("- 0").azimuth));
}

TEST_CASE("nobody is at the next stroke so soon", "[judge][corpus]") {
  double shortest = std::numeric_limits<double>::infinity();
  int lifts = 0;
  for (const PenTrace& trace : calligraphy_test::traces_of_people()) {
    for (std::size_t i = 1; i < trace.strokes.size(); ++i, ++lifts) {
      shortest = std::min(shortest, trace.strokes[i].front().time - trace.strokes[i - 1].back().time);
    }
  }
  CHECK(shortest > 0.1);  // the longest run of lost samples that a pen-down survives
  WARN(lifts << " lifts between strokes of people, the shortest " << shortest << " s");
}

TEST_CASE("reading and writing people's pen traces reproduces the text", "[judge][corpus]") {
  const auto traces = calligraphy_test::traces_of_people();
  const std::string text = written(traces);
  CHECK(written(read(text)) == text);
}

TEST_CASE("pen traces do not depend on the locale", "[judge]") {
  const std::string expected = written(read(good));
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaNumbers));
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  std::istringstream in(good);
  std::ostringstream out;
  write_pen_traces(out, read_pen_traces(in, "pens.txt"));
  std::setlocale(LC_ALL, c_before.c_str());
  std::locale::global(before);
  CHECK(out.str() == expected);
}

TEST_CASE("an invalid pen trace is rejected naming the line and the value", "[judge]") {
  const auto line = [](const std::string& text) { return "C 一 4E00 made-up 1000 1\n" + text + "\n"; };
  struct Case {
    std::string text, where, value;
  };
  const Case cases[] = {
      {"X\n", "pens.txt:1:", "'X'"},
      {" C 一 4E00 made-up 1000 1\n", "pens.txt:1:", "extra space"},
      {"S 1 0 0 0\n", "pens.txt:1:", "before the first character"},
      {"C 一 4E01 made-up 1000 1\n", "pens.txt:1:", "4E01"},
      {"C \xff 4E00 made-up 1000 1\n", "pens.txt:1:", "UTF-8"},
      {"C 一 4E00 \xff 1000 1\n", "pens.txt:1:", "UTF-8"},
      {"C 一 4E00 a\rb 1000 1\n", "pens.txt:1:", "carriage return"},  // which could not be written again
      {"\xFF\xFE" "C\n", "pens.txt:1:", "UTF-16"},
      {"C 一 D800 made-up 1000 1\n", "pens.txt:1:", "D800"},
      {"C 一 110000 made-up 1000 1\n", "pens.txt:1:", "110000"},
      {"C 一 x4E00 made-up 1000 1\n", "pens.txt:1:", "x4E00"},
      {"C 一 4E00 made-up 0 1\n", "pens.txt:1:", "'0'"},
      {"C 一 4E00 made-up nan 1\n", "pens.txt:1:", "'nan'"},
      {"C 一 4E00 made-up 1e300 1\n", "pens.txt:1:", "'1e300'"},
      {"C 一 4E00 made-up 1000 0\n", "pens.txt:1:", "'0'"},
      {"C 一 4E00 made-up 1000 1000000000\n", "pens.txt:1:", "1000000000"},
      {"C 一 4E00 made-up 1000 1 more\n", "pens.txt:1:", "more"},
      {"C 一 4E00 made-up 1000\n", "pens.txt:1:", "number of strokes"},
      {line("S 2 0 0 0"), "pens.txt:2:", "expected x"},
      {line("S 999999 0 0 0"), "pens.txt:2:", "too short for 999999"},
      {line("S 18446744073709551616 0 0 0"), "pens.txt:2:", "18446744073709551616"},
      {line("S 0"), "pens.txt:2:", "'0'"},
      {line("S -1 0 0 0"), "pens.txt:2:", "'-1'"},
      {line("S 1 0 0 0 5"), "pens.txt:2:", "'5'"},
      {line("S 1 0 inf 0"), "pens.txt:2:", "'inf'"},
      {line("S 1 0,5 0 0"), "pens.txt:2:", "'0,5'"},
      {line("S 1 100001 0 0"), "pens.txt:2:", "'100001'"},
      {line("S 1 0 0 -1"), "pens.txt:2:", "'-1'"},
      {line("S 1 0 0 1e12"), "pens.txt:2:", "'1e12'"},
      {line("S 2 0 0 9 10 0 8.5"), "pens.txt:2:", "9 to 8.5"},
      {line("S 1 0 0 0\nS 1 0 0 0"), "pens.txt:3:", "too many"},
      {"C 一 4E00 made-up 1000 2\nS 1 0 0 5\nC 一 4E00 made-up 1000 1\nS 1 0 0 0\n", "pens.txt:3:", "1 of 2 strokes"},
      {"C 一 4E00 made-up 1000 2\nS 1 0 0 5\nS 1 0 0 4\n", "pens.txt:3:", "5 to 4"},
      {"C 一 4E00 made-up 1000 2\nS 1 0 0 5\n", "pens.txt:3:", "1 of 2 strokes"},
      {"V 3\n", "pens.txt:1:", "unknown version 'V 3'"},
      {line("A 1 0 0 0"), "pens.txt:2:", "'A'"},
      {line("F pressure"), "pens.txt:2:", "'F'"},
      {"V 2\n" + line("F pressur"), "pens.txt:3:", "'pressur'"},
      {"V 2\n" + line("F twist twist"), "pens.txt:3:", "twice"},
      {"V 2\n" + line("F tilt_x"), "pens.txt:3:", "together"},
      {"V 2\n" + line("F tilt_x tilt_y azimuth"), "pens.txt:3:", "altitude and azimuth"},
      {"V 2\n" + line("S 1 0 0 0\nF twist"), "pens.txt:4:", "once"},
      {"V 2\n" + line("F pressure\nS 1 0 0 0"), "pens.txt:4:", "pressure"},
      {"V 2\n" + line("F pressure\nS 1 0 0 0 1.5"), "pens.txt:4:", "'1.5'"},
      {"V 2\n" + line("F buttons\nS 1 0 0 0 0.5"), "pens.txt:4:", "integer"},
      {"V 2\n" + line("F pressure\nS 9 0 0 0 1"), "pens.txt:4:", "too short"},
      {"V 2\n" + line("A 1 0 0 0"), "pens.txt:3:", "too many"},
      {"V 2\nC 一 4E00 made-up 1000 1 3\n", "pens.txt:2:", "'3'"},
      {"V 2\nC 一 4E00 made-up 1000 1 2\nA 1 0 0 0\nA 1 0 0 0\n", "pens.txt:4:", "twice in a row"},
      {"V 2\nC 一 4E00 made-up 1000 1 1\nS 1 0 0 0\n", "pens.txt:4:", "0 of 1 times"},
  };
  for (const Case& each : cases) {
    CAPTURE(each.text);
    const std::string message = refusal(each.text);
    CHECK(message.find(each.where) == 0);
    CHECK(message.find(each.value) != std::string::npos);
  }
}

TEST_CASE("a pen trace truncated anywhere but at the end of a character is rejected", "[judge]") {
  const std::size_t first = good.find("C 一");
  for (std::size_t length = 0; length < good.size(); ++length) {
    CAPTURE(length);
    const bool whole = length == 0 || length == first || length == good.find("C 二");
    CHECK((refusal(good.substr(0, length)) == "accepted") == whole);
  }
}

TEST_CASE("a file with a random byte is either read or rejected with FormatError", "[judge]") {
  std::uint32_t state = 1;
  for (int i = 0; i < 6000; ++i) {
    state = state * 1664525u + 1013904223u;
    std::string broken = i % 2 == 0 ? good : with_senses;
    broken[(state >> 8) % broken.size()] = static_cast<char>(state >> 24);
    try {
      for (const PenTrace& trace : read(broken)) {
        for (const PenStroke& stroke : trace.strokes) {
          for (const TimedPoint& timed : stroke) CHECK(timed.point.allFinite());
        }
      }
    } catch (const FormatError&) {
    }
  }
}

TEST_CASE("a pen trace file beyond its limit is refused by its size, unread", "[judge]") {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "large.txt").string();
  calligraphy_test::make_sparse_file(path, (256ull << 20) + 1);
  const std::size_t before = calligraphy_test::bytes_read_so_far();
  CHECK_THROWS_WITH(read_pen_traces(path), path + ": larger than the limit of 268435456 bytes");
  CHECK(calligraphy_test::bytes_read_so_far() - before < 100'000);
}

TEST_CASE("a stroke without an end is refused before it fills the memory", "[judge]") {
  calligraphy_test::EndlessText text("C 一 4E00 made-up 1000 1\nS 9", '9');
  CHECK_THROWS_WITH(read_pen_traces(text.in, "pens.txt"),
                    Catch::Contains("pens.txt:2: the line is longer than 67108864 bytes"));
  CHECK(text.bytes_read < 68'000'000);
}

TEST_CASE("the longest stroke that may be written is not beyond the limit of a line", "[judge]") {
  constexpr std::size_t max_points = 1'000'000, max_line = 67'108'864;
  PenTrace trace;
  trace.character = U'一';
  trace.set = "made-up";
  trace.em = 1e9;
  trace.strokes.emplace_back(10, TimedPoint{{-10.0 + 1e-16, 11.0 - 1e-16}, 86399.123456789});
  const std::string text = written({trace});
  CHECK((text.size() - text.find("\nS")) * (max_points / 10) < max_line);
}

TEST_CASE("a pen trace that could not be read back is not written", "[judge]") {
  const PenTrace fine = read(good).back();
  PenTrace trace = fine;
  std::string named;
  SECTION("no stroke") { trace.strokes.clear(), named = "0 strokes"; }
  SECTION("no point") { trace.strokes[0].clear(), named = "0 points"; }
  SECTION("decreasing time") { trace.strokes[0].push_back({Point(0, 0), 0.0}), named = "0 s after 0.001 s"; }
  SECTION("not finite") { trace.strokes[0][0].point.x() = std::nan(""), named = "nan"; }
  SECTION("space in the set") { trace.set = "a b", named = "'a b'"; }
  SECTION("no character") { trace.character = 0xD800, named = "D800"; }
  SECTION("pressure") { trace.strokes[0][0].stylus.pressure = 1.5, named = "pressure of 1.5"; }
  SECTION("infinite tilt") { trace.strokes[0][0].stylus.azimuth = INFINITY, named = "azimuth of inf"; }
  SECTION("buttons") { trace.strokes[0][0].buttons = -2, named = "buttons -2"; }
  SECTION("air") { trace.air.resize(1), named = "in the air 1 times"; }
  SECTION("no em") { trace.em = 0.0, named = "em"; }
  try {
    written({fine, trace});
    FAIL("written");
  } catch (const ValueError& error) {
    CHECK(std::string(error.what()).find("pen trace 2: ") == 0);
    CHECK(std::string(error.what()).find(named) != std::string::npos);
  }
}

TEST_CASE("a missing pen trace file is a FileError", "[judge]") {
  CHECK_THROWS_AS(read_pen_traces(std::string("none.txt")), FileError);
  CHECK_THROWS_AS(read_pen_traces(std::string("/")), FileError);
}
