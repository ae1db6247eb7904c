#include <string>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/pictures/replay_picture.hpp>

#include "../catch.hpp"
#include "../practice/pages.hpp"
#include "../judge/pen_traces.hpp"

using namespace calligraphy;
using calligraphy_test::copy_of;

namespace {

pugi::xml_document replay_xml(const std::string& text) {
  pugi::xml_document document;
  REQUIRE(document.load_string(text.c_str()));
  return document;
}

std::size_t count(const pugi::xml_document& document, const char* query) { return document.select_nodes(query).size(); }

}  // namespace

TEST_CASE("a replay picture numbers pen-downs and strokes and shows the path of the device", "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    const auto paths = copy_of(character);
    const auto document = replay_xml(replay_picture(character, paths, match_strokes(character, paths), paths, "title"));
    CAPTURE(encode_utf8(character.code));
    CHECK(count(document, "//g[@class='drawn-number']/text") == paths.size());
    CHECK(count(document, "//g[@class='standard-number']/text") == paths.size());
    CHECK(count(document, "//g[@class='written']/path[@stroke='#333333']") == paths.size());
    CHECK(count(document, "//g[@class='guided']/path") == paths.size());
    CHECK(count(document, "//*[@stroke='#e02020' or @fill='#e02020']") == 0);
  }
}

TEST_CASE("a replay picture shows mistakes in red, lists them, and omits bounces", "[practice]") {
  const Character ten = calligraphy_test::characters("十").front();
  std::vector<PenPath> paths = copy_of(ten);
  std::swap(paths[0], paths[1]);
  paths.push_back({{2.0, 2.0}});
  const MatchResult match = match_strokes(ten, paths);
  const std::string text = replay_picture(ten, paths, match, {}, "<十>");
  const auto document = replay_xml(text);
  CHECK(count(document, "//g[@class='drawn-number']/text") == 2);
  CHECK(count(document, "//g[@class='written']/path[@stroke='#e02020']") == 1);
  const StrokeRemark& remark = match.remarks.at(0);
  CHECK(text.find(remark_text(remark, ten)) != std::string::npos);
  CHECK(text.find(">as written, laid on the character<") != std::string::npos);
  const Language language("zh");
  const std::string chinese = replay_picture(ten, paths, match, {}, "<十>", StrokeStyle::ink, language);
  CHECK(chinese.find(remark_text(remark, ten, language)) != std::string::npos);
  CHECK(chinese.find(">所写的字，叠在范字上<") != std::string::npos);
  CHECK(chinese.find(remark_text(remark, ten)) == std::string::npos);
}

TEST_CASE("a replay picture shows the template as ink, or as lines, and pen paths as lines", "[practice]") {
  const Character ten = calligraphy_test::characters("十").front();
  const auto paths = copy_of(ten);
  const MatchResult match = match_strokes(ten, paths);
  const auto ink = replay_xml(replay_picture(ten, paths, match, paths, "title"));
  CHECK(count(ink, "//g[@class='template' and @fill='#c5d6f7' and not(@stroke)]/path") == 4);
  const auto lines = replay_xml(replay_picture(ten, paths, match, paths, "title", StrokeStyle::lines));
  CHECK(count(lines, "//g[@class='template' and @fill='none' and @stroke='#c5d6f7']/path") == 4);
  for (const auto* document : {&ink, &lines}) {
    CHECK(count(*document, "//g[@class='written' and @fill='none']/path[@stroke='#333333']") == 2);
  }
}

TEST_CASE("a replay picture rejects a match of other pen-downs", "[practice]") {
  const Character ten = calligraphy_test::characters("十").front();
  const auto paths = copy_of(ten);
  CHECK_THROWS_AS(replay_picture(ten, paths, match_strokes(ten, {}), {}, "title"), ValueError);
  CHECK_THROWS_AS(replay_picture(ten, paths, match_strokes(ten, paths), {}, "\xff"), FormatError);
}

TEST_CASE("a replay picture has strokes of another form in orange, and rings round what is pointed at", "[practice]") {
  const Character ten = calligraphy_test::characters("十").front();
  const auto paths = copy_of(ten);
  MatchResult match = match_strokes(ten, paths);
  match.remarks = {{.kind = StrokeRemarkKind::no_crossing, .path = 1, .path_count = 1, .stroke = 1, .stroke_count = 1,
                    .other_stroke = 0, .place = paths[1].front(), .end = StrokeEnd::start},
                   {.kind = StrokeRemarkKind::straight, .stroke = 0, .stroke_count = 2, .place = {0.5, 0.5}},
                   {.kind = StrokeRemarkKind::parts, .stroke = 0, .stroke_count = 1, .other_stroke = 1}};
  match.fit.offset += Point(0.1, 0.0);
  const auto document = replay_xml(replay_picture(ten, paths, match, {}, "title"));
  CHECK(count(document, "//g[@class='written']/path[@stroke='#e08a00']") == 1);
  const auto rings = document.select_nodes("//circle[@class='place' and @stroke='#e08a00']");
  REQUIRE(rings.size() == 1);
  const std::string start = document.select_node("//path[@stroke='#e08a00']/@d").attribute().value();
  const std::string centre = std::string(rings[0].node().attribute("cx").value()) + "," +
                             rings[0].node().attribute("cy").value();
  CHECK(start.substr(0, centre.size() + 1) == "M" + centre);
}
