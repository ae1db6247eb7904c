#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/pictures/plot.hpp>

#include "../catch.hpp"

using namespace calligraphy;
namespace fs = std::filesystem;

namespace {

/// Whether gnuplot is available; without it a test is skipped, or fails where all tests must run.
bool gnuplot_is_there() {
  if (gnuplot_available()) return true;
  if (std::getenv("CALLIGRAPHY_REQUIRE_DATA") != nullptr) {
    FAIL("gnuplot cannot be started, and CALLIGRAPHY_REQUIRE_DATA is set");
  }
  WARN("skipped: gnuplot cannot be started");
  return false;
}

/// A directory that is the current one and, if asked for, alone on the search path while it lives.
class ShimDirectory {
 public:
  ShimDirectory() : before_(fs::current_path()), search_path_(std::getenv("PATH")) {
    std::string name = (fs::temp_directory_path() / "calligraphy-XXXXXX").string();
    path_ = mkdtemp(name.data());
    fs::current_path(path_);
  }
  ShimDirectory(const ShimDirectory&) = delete;
  ShimDirectory& operator=(const ShimDirectory&) = delete;
  ~ShimDirectory() {
    setenv("PATH", search_path_.c_str(), 1);
    fs::current_path(before_);
    fs::remove_all(path_);
  }

  /// Provides the test's own gnuplot, a shell script.
  void provide_gnuplot(const std::string& body) const {
    write_file(path_ / "gnuplot", "#!/bin/sh\nPATH=" + search_path_ + "\n" + body + "\n");
    fs::permissions(path_ / "gnuplot", fs::perms::owner_all);
    hide_others();
  }
  void hide_others() const { setenv("PATH", path_.c_str(), 1); }

  std::string content(const std::string& name) const {
    std::ifstream in(path_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  auto entries() const { return std::distance(fs::directory_iterator(path_), fs::directory_iterator()); }

 private:
  fs::path path_;
  fs::path before_;
  std::string search_path_;
};

/// Ten seconds: strokes 0 and 1 of character 0, an attempt between them that counts as abandoned in this tick, then
/// character 1.
Recording recording(int abandoned = 4000) {
  Recording result;
  for (int i = 0; i < 10000; ++i) {
    RecordedSample sample;
    sample.time = i / 1000.0;
    const auto within = [&sample](double begin, double end) { return sample.time >= begin && sample.time < end; };
    sample.character = sample.time < 8.0 ? 0 : 1;
    sample.stroke = sample.time < 2.0 || sample.character == 1 ? 0 : 1;
    if (within(1, 2) || within(3, 4) || within(5, 7) || within(8.5, 9)) sample.state = InteractionState::writing;
    if (i == 2000 || i == 7000) sample.events = TickEvent::stroke_finished;
    if (i == abandoned) sample.events = TickEvent::stroke_abandoned;
    sample.force = {std::sin(sample.time), std::cos(sample.time), 0.5};
    result.samples.push_back(sample);
  }
  return result;
}

std::string error_of(const Recording& some, int character, const std::string& title = "title") {
  try {
    force_plot(some, character, title);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

const std::string hostile = "a'; system(\"touch x\"); #{1} `touch y` $(touch z) \\\n!touch w\n<&>";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Number of lines of a data block in a gnuplot script.
std::ptrdiff_t lines_of_block(const std::string& script, const std::string& name) {
  const auto begin = script.find("$" + name + " << END\n");
  REQUIRE(begin != std::string::npos);
  const auto end = script.find("\nEND\n", begin);
  const std::string block = script.substr(begin, end - begin);
  return std::count(block.begin(), block.end(), '\n');
}

}  // namespace

TEST_CASE("a force plot is valid SVG with axes, units, stroke numbers and title", "[practice]") {
  if (!gnuplot_is_there()) return;
  const std::string svg = force_plot(recording(), 0, "北 & <force>");
  pugi::xml_document document;
  REQUIRE(document.load_buffer(svg.data(), svg.size()));
  const pugi::xml_node root = document.child("svg");
  REQUIRE(root);
  CHECK(std::string(root.child("title").text().get()) == "北 & <force>");
  std::string texts;
  for (const auto& found : document.select_nodes("//text")) {
    std::string text;
    for (const auto& part : found.node().select_nodes(".//text()")) text += part.node().value();
    texts += "[" + text + "]";
  }
  for (const char* expected : {"[北 & <force>]", "[in-plane force [N]]", "[normal force [N]]", "[time [s]]", "[|F|]",
                               "[Fx]", "[Fy]", "[1]", "[2]", "grey: abandoned"}) {
    CAPTURE(texts, expected);
    CHECK(contains(texts, expected));
  }
}

TEST_CASE("a force plot has its words in the language asked for", "[practice]") {
  if (!gnuplot_is_there()) return;
  const std::string svg = force_plot(recording(), 0, "title", Language("zh"));
  for (const char* expected : {"纸面内的力 [N]", "垂直纸面的力 [N]", "时间 [s]", "灰：中途放弃"}) {
    CAPTURE(expected);
    CHECK(contains(svg, expected));
  }
  CHECK_FALSE(contains(svg, "force [N]"));
}

TEST_CASE("a hostile title is drawn, not run", "[practice]") {
  if (!gnuplot_is_there()) return;
  const ShimDirectory directory;
  const std::string svg = force_plot(recording(), 0, hostile);
  CHECK(directory.entries() == 0);
  pugi::xml_document document;
  REQUIRE(document.load_buffer(svg.data(), svg.size()));
  std::string expected = hostile;
  std::replace(expected.begin(), expected.end(), '\n', ' ');
  CHECK(document.child("svg").child("title").text().get() == expected);
}

TEST_CASE("an attempt is grey even if it counts as abandoned only in the air or with the next start", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("cat > script; echo '<svg><title/></svg>'");
  force_plot(recording(), 0, "title");
  const std::string script = directory.content("script");
  for (const int tick : {4015, 5000}) {
    force_plot(recording(tick), 0, "title");
    CHECK(directory.content("script") == script);
  }
}

TEST_CASE("no part of the title reaches gnuplot", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("cat > script; echo '<svg><title/></svg>'");
  force_plot(recording(), 0, hostile);
  const std::string script = directory.content("script");
  CHECK(contains(script, "plot $size"));
  CHECK_FALSE(contains(script, "touch"));
  CHECK_FALSE(contains(script, "system"));
}

TEST_CASE("a plot shows bands for the writing state of the character that was asked for", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("cat > script; echo '<svg><title/></svg>'");
  force_plot(recording(), 0, "title");
  std::string script = directory.content("script");
  CHECK(contains(script, "set xrange [0:7.999]"));
  const std::string style = " behind fillstyle solid noborder fillcolor rgb ";
  for (const std::string& expected :
       {"from first 1, graph 0 to first 2, graph 1" + style + "'#e3ecfb'",
        "from first 3, graph 0 to first 4, graph 1" + style + "'#e4e4e4'",
        "from first 5, graph 0 to first 7, graph 1" + style + "'#e3ecfb'", std::string("set label '1' at first 1.5,"),
        std::string("set label '2' at first 3.5,"), std::string("set label '2' at first 6,")}) {
    CAPTURE(expected);
    CHECK(contains(script, expected));
  }
  CHECK_FALSE(contains(script, "first 8.5"));
  force_plot(recording(), 1, "title");
  script = directory.content("script");
  CHECK(contains(script, "set xrange [8:9.999]"));
  CHECK(contains(script, "from first 8.5, graph 0 to first 9,"));
  CHECK_FALSE(contains(script, "from first 5"));
}

TEST_CASE("time is since the first tick, whatever the clock of the device said then", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("cat > script; echo '<svg><title/></svg>'");
  Recording late = recording();
  for (RecordedSample& sample : late.samples) sample.time += 4096.0;
  force_plot(late, 0, "title");
  CHECK(contains(directory.content("script"), "set xrange [0:"));
}

TEST_CASE("a long recording is drawn with few points and every peak", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("cat > script; echo '<svg><title/></svg>'");
  Recording long_one = recording();
  for (int i = 0; i < 200000; ++i) {
    RecordedSample sample;
    sample.time = 10.0 + i / 1000.0;
    sample.force.z() = i == 123500 ? 7.125 : i == 150050 ? -3.25 : 0.5;
    long_one.samples.push_back(sample);
  }
  force_plot(long_one, 0, "title");
  const std::string script = directory.content("script");
  for (const char* curve : {"fx", "fy", "size", "normal"}) CHECK(lines_of_block(script, curve) <= 4000);
  CHECK(contains(script, " 7.125\n"));
  CHECK(contains(script, " -3.25\n"));
}

TEST_CASE("forces that are not numbers do not reach gnuplot", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("cat > script; echo '<svg><title/></svg>'");
  Recording some = recording();
  some.samples[500].force.setConstant(std::numeric_limits<double>::quiet_NaN());
  some.samples[501].force.setConstant(-std::numeric_limits<double>::infinity());
  force_plot(some, 0, "title");
  const std::string script = directory.content("script");
  CHECK(contains(script, "$normal << END"));
  CHECK_FALSE(contains(script, "nan"));
  CHECK_FALSE(contains(script, "inf"));
}

TEST_CASE("a recording with few finite forces, or none, is plotted", "[practice]") {
  if (!gnuplot_is_there()) return;
  Recording some = recording();
  for (std::size_t i = 0; i < some.samples.size(); ++i) {
    if (i % 3 != 0) some.samples[i].force.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  const std::string svg = force_plot(some, 0, "title");
  CHECK_FALSE(contains(svg, "nan"));
  for (RecordedSample& sample : some.samples) sample.force.setConstant(std::numeric_limits<double>::infinity());
  CHECK(error_of(some, 0) == "");
  some.samples.resize(1);
  CHECK(error_of(some, 0) == "");
}

TEST_CASE("a plot of a character without samples is an error naming it", "[practice]") {
  CHECK(error_of(recording(), 2) == "character 2 is not active in any sample of the recording");
  CHECK(error_of({}, 0) == "character 0 is not active in any sample of the recording");
  CHECK_THROWS_AS(force_plot(recording(), 0, "\xff"), FormatError);
}

TEST_CASE("without gnuplot there is no plot, and the error says so", "[practice]") {
  const ShimDirectory directory;
  directory.hide_others();
  CHECK_FALSE(gnuplot_available());
  CHECK(error_of(recording(), 0) == "gnuplot cannot be run: No such file or directory");
}

TEST_CASE("a gnuplot that fails is an error with its message", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("echo 'line 7: no such terminal' >&2; exit 3");
  CHECK_FALSE(gnuplot_available());
  CHECK(contains(error_of(recording(), 0), "gnuplot failed with exit code 3: line 7: no such terminal"));
}

TEST_CASE("a gnuplot that gives no SVG, reads nothing or is killed is an error, not the end", "[practice]") {
  const ShimDirectory directory;
  directory.provide_gnuplot("echo 'a warning' >&2");
  CHECK(contains(error_of(recording(), 0), "gnuplot returned no SVG: "));
  CHECK(contains(error_of(recording(), 0), "a warning"));
  directory.provide_gnuplot("exec <&-; echo '<svg'");
  CHECK(contains(error_of(recording(), 0), "gnuplot returned no SVG: "));
  directory.provide_gnuplot("kill -9 $$");
  CHECK(contains(error_of(recording(), 0), "exit code 137"));
}
