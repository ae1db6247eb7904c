#include <cstdlib>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/pictures/error_plot.hpp>
#include <calligraphy/pictures/plot.hpp>

#include "../catch.hpp"

using namespace calligraphy;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A mean [m] over this many draws.
MeanInterval mean_of(double mean, std::size_t draws = 12) {
  return {draws == 0 ? unknown : mean, draws < 2 ? unknown : 1e-4, draws, draws, 0};
}

/// 1 mm and 2 mm without force, 0.5 mm less with it; a third character was written in one pair, and a fourth in none.
ErrorsByCharacter errors() {
  ErrorsByCharacter result;
  result.characters = {{U'永', mean_of(1e-3), mean_of(0.5e-3), mean_of(0.5e-3)},
                       {U'\'', mean_of(2e-3), mean_of(1.5e-3), mean_of(0.5e-3)},
                       {U'一', mean_of(1e-3, 1), mean_of(0.5e-3, 1), mean_of(0.5e-3, 1)},
                       {U'二', mean_of(0.0, 0), mean_of(0.0, 0), mean_of(0.0, 0)}};
  result.all = {0, mean_of(1.5e-3), mean_of(1e-3), mean_of(0.5e-3)};
  return result;
}

pugi::xml_document drawn(const ErrorsByCharacter& some, const Language& language = {}) {
  const std::string svg = error_plot(some, "title", language);
  pugi::xml_document document;
  REQUIRE(document.load_buffer(svg.data(), svg.size()));
  return document;
}

/// The words from x on [px].
std::vector<std::string> words_from(const pugi::xml_document& document, double x) {
  std::vector<std::string> words;
  for (const auto& found : document.select_nodes("/svg/text")) {
    if (found.node().attribute("x").as_double() >= x) words.push_back(found.node().text().get());
  }
  return words;
}

bool can_draw() {
  if (gnuplot_available()) return true;
  if (std::getenv("CALLIGRAPHY_REQUIRE_DATA") != nullptr) FAIL("gnuplot cannot be started");
  WARN("skipped: gnuplot cannot be started");
  return false;
}

}  // namespace

TEST_CASE("an error plot names every character and its pairs, and all of several", "[pictures]") {
  if (!can_draw()) return;
  const pugi::xml_document document = drawn(errors());
  CHECK(words_from(document, 850.0) == std::vector<std::string>{"n", "12", "12", "1", "0", "12"});
  const std::vector<std::string> words = words_from(document, 0.0);
  const std::set<std::string> there(words.begin(), words.end());
  for (const char* expected : {"title", "永", "'", "一", "二", "all", "vision only", "vision and force",
                               "RMS distance of the pen from the strokes that it wrote: mean and 95 % interval over n "
                               "pairs of runs, 12 in all"}) {
    CAPTURE(expected);
    CHECK(there.contains(expected));
  }
  ErrorsByCharacter one = errors();
  one.characters.resize(1);
  CHECK(words_from(drawn(one), 850.0) == std::vector<std::string>{"n", "12"});
  const std::vector<std::string> chinese = words_from(drawn(errors(), Language("zh")), 0.0);
  CHECK(std::set(chinese.begin(), chinese.end()).contains("全部"));
}

TEST_CASE("an error plot has a point where its axis says, and none and no interval where there is none",
          "[pictures]") {
  if (!can_draw()) return;
  const pugi::xml_document document = drawn(errors());
  std::vector<double> open;  // from the left end of the axis, which is zero [px]
  for (const auto& found : document.select_nodes("//use[@xlink:href='#gpPt5'][@color]")) {
    const std::string place = found.node().attribute("transform").value();  // translate(x,y) scale(...)
    open.push_back(std::stod(place.substr(place.find('(') + 1)) - 88.0);
  }
  REQUIRE(open.size() == 4);  // of three characters and of all
  CHECK(open[1] == Approx(2.0 * open[0]).margin(0.1));
  CHECK(open[2] == Approx(open[0]).margin(0.1));
  CHECK(open[3] == Approx(1.5 * open[0]).margin(0.1));
  const auto intervals = document.select_nodes("//use[@xlink:href='#gpDot']").size();  // gnuplot dots each one's middle
  CHECK(intervals == 3 * 3);  // three values of two characters and of all
}

TEST_CASE("without a pair there is no error plot", "[pictures]") {
  CHECK_THROWS_AS(error_plot({}, "title"), ValueError);
  CHECK_THROWS_AS(error_plot(errors(), "\xff"), FormatError);
}
