#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/pictures/picture.hpp>
#include <calligraphy/practice/session.hpp>

#include "../catch.hpp"
#include "../hard_cases.hpp"
#include "../practice/pages.hpp"

using namespace calligraphy;
using calligraphy_test::page_of;

namespace {

pugi::xml_document xml(const std::string& svg) {
  pugi::xml_document document;
  const auto result = document.load_buffer(svg.data(), svg.size());
  INFO(result.description());
  REQUIRE(result);
  REQUIRE(std::string(document.document_element().name()) == "svg");
  return document;
}

std::vector<pugi::xml_node> all(const pugi::xml_document& document, const std::string& path) {
  std::vector<pugi::xml_node> nodes;
  for (const auto& found : document.select_nodes(path.c_str())) nodes.push_back(found.node());
  return nodes;
}

std::vector<pugi::xml_node> templates(const pugi::xml_document& document) {
  return all(document, "//g[starts-with(@class, 'template')]");
}

std::size_t paths(const pugi::xml_node& node) {
  const auto children = node.children("path");
  return static_cast<std::size_t>(std::distance(children.begin(), children.end()));
}

/// The numbers of path data, in pairs.
std::vector<Point> points(const pugi::xml_node& path) {
  const std::string text = path.attribute("d").value();
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc()) {
      ++at;
      continue;
    }
    numbers.push_back(value);
    at = static_cast<std::size_t>(end - text.data());
  }
  std::vector<Point> result;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) result.emplace_back(numbers[i], numbers[i + 1]);
  return result;
}

/// Corner of the page in the picture [mm].
Point lower_left(const pugi::xml_document& document) {
  const pugi::xml_node frame = all(document, "//rect[@class='page']").at(0);
  return {frame.attribute("x").as_double(), frame.attribute("y").as_double() + frame.attribute("height").as_double()};
}

Point in_picture(const pugi::xml_document& document, const Point& page_point) {
  return lower_left(document) + 1e3 * Point(page_point.x(), -page_point.y());
}

Point ellipse_centre(const pugi::xml_document& document) {
  const auto ellipses = all(document, "//ellipse[@class='start']");
  REQUIRE(ellipses.size() == 1);
  CHECK(std::string(ellipses[0].attribute("stroke").value()) == "#e02020");
  CHECK(std::string(ellipses[0].attribute("fill").value()) == "none");
  return {ellipses[0].attribute("cx").as_double(), ellipses[0].attribute("cy").as_double()};
}

Point start_of(const PlacedCharacter& placed, std::size_t stroke) {
  return placed.placement.to_page(strokes(placed.character)[stroke].control_points[0]);
}

RecordedSample sample(InteractionState state, int character, int stroke, const Point& tip,
                      TickEvent events = TickEvent::none) {
  RecordedSample result;
  result.state = state;
  result.character = character;
  result.stroke = stroke;
  result.pen_tip = {tip.x(), tip.y(), 0.0};
  result.events = events;
  return result;
}

constexpr auto ws = InteractionState::writing;
constexpr auto cs = InteractionState::calibration;
constexpr auto ss = InteractionState::separation;

/// A polyline in the writing state, except for its last point, which leaves it.
void append_run(Recording& recording, int character, int stroke, const std::vector<Point>& tips, TickEvent end) {
  for (std::size_t i = 0; i + 1 < tips.size(); ++i) {
    recording.samples.push_back(sample(ws, character, stroke, tips[i]));
  }
  const bool finished = has_event(end, TickEvent::stroke_finished);
  recording.samples.push_back(sample(finished ? cs : ss, character, finished ? stroke + 1 : stroke, tips.back(), end));
}

const std::vector<Point> corner = {{0.05, 0.05}, {0.06, 0.05}, {0.06, 0.06}};

}  // namespace

TEST_CASE("a page picture has one path per stroke of every character", "[practice]") {
  const PracticePage page = page_of("永北京");
  const auto document = xml(page_picture(page, {}, 0, "title"));
  const auto groups = templates(document);
  REQUIRE(groups.size() == page.characters.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    CHECK(paths(groups[i]) == static_cast<std::size_t>(page.characters[i].character.stroke_count()));
  }
  CHECK(all(document, "//g[@class='trace']").empty());
}

TEST_CASE("only the active character is yellow, the others are blue", "[practice]") {
  const PracticePage page = page_of("永北京");
  for (int active = 0; active < 3; ++active) {
    const auto document = xml(page_picture(page, {}, active, "title"));
    const auto groups = templates(document);
    REQUIRE(groups.size() == 3);
    for (int i = 0; i < 3; ++i) {
      const auto& group = groups[static_cast<std::size_t>(i)];
      CHECK(std::string(group.attribute("stroke").value()) == (i == active ? "#f2b705" : "#5b8ff0"));
    }
  }
}

TEST_CASE("template paths are the strokes' control points on the page, in millimetres and upright", "[practice]") {
  const PracticePage page = page_of("永北");
  const auto document = xml(page_picture(page, {}, 0, "title"));
  const auto groups = templates(document);
  REQUIRE(groups.size() == 2);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::vector<Point> drawn;
    for (const auto& path : groups[i].children("path")) {
      const auto some = points(path);
      drawn.insert(drawn.end(), some.begin(), some.end());
    }
    const auto& expected = page.characters[i].character.structure.control_points;
    REQUIRE(drawn.size() == expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const Point place = in_picture(document, page.characters[i].placement.to_page(expected[k]));
      CHECK((drawn[k] - place).norm() < 0.001);
    }
  }
  const pugi::xml_node root = document.child("svg");
  CHECK(std::string(root.attribute("width").value()).ends_with("mm"));
  CHECK(root.attribute("viewBox").value() == "0 0 " + std::to_string(root.attribute("width").as_int()) + " " +
                                                 std::to_string(root.attribute("height").as_int()));
}

TEST_CASE("quartic curves are drawn like the equal cubic curves", "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    PracticePage page = lay_out({&character, 1}).front();
    const auto cubic = xml(page_picture(page, {}, 0, "title"));
    page.characters[0].character = with_quartic_curves(character);
    const auto quartic = xml(page_picture(page, {}, 0, "title"));
    const auto cubic_paths = all(cubic, "//g[@class='template active']/path");
    const auto quartic_paths = all(quartic, "//g[@class='template active']/path");
    REQUIRE(cubic_paths.size() == quartic_paths.size());
    const std::vector<Stroke> strokes_of = strokes(character);
    for (std::size_t i = 0; i < cubic_paths.size(); ++i) {
      CAPTURE(encode_utf8(character.code), i);
      const auto c = points(cubic_paths[i]), q = points(quartic_paths[i]);
      std::size_t at = 0, drawn = 0;
      for (const char element : strokes_of[i].elements) {
        const bool curve = element == 'C';
        if (curve) {
          const Point middle = 0.125 * (c[at] + 3.0 * c[at + 1] + 3.0 * c[at + 2] + c[at + 3]);
          REQUIRE(drawn + 48 < q.size());
          CHECK((middle - q[drawn + 24]).norm() < 0.003);
        }
        at += curve ? 3 : 1;
        drawn += curve ? 48 : 1;
        REQUIRE(drawn < q.size());
        CHECK((c[at] - q[drawn]).norm() < 0.003);
      }
      CHECK(drawn + 1 == q.size());
    }
  }
}

TEST_CASE("the red ellipse is at the start of the last active stroke", "[practice]") {
  const PracticePage page = page_of("永北");
  const auto at = [&](const Recording& recording, int active, std::size_t stroke) {
    const auto document = xml(page_picture(page, recording, active, "title"));
    const Point expected = in_picture(document, start_of(page.characters[static_cast<std::size_t>(active)], stroke));
    return (ellipse_centre(document) - expected).norm() < 0.001;
  };
  Recording recording;
  CHECK(at(recording, 0, 0));
  CHECK(at(recording, 1, 0));
  append_run(recording, 0, 0, corner, TickEvent::stroke_finished);
  append_run(recording, 0, 1, corner, TickEvent::stroke_finished);
  CHECK(at(recording, 0, 2));
  CHECK(at(recording, 1, 0));
  recording.samples.push_back(sample(cs, 0, 5, corner[0]));  // complete, with the pen still down
  CHECK(at(recording, 0, 4));
  recording.samples.push_back(sample(ss, 1, 0, corner[0]));
  CHECK(at(recording, 0, 4));
  CHECK(at(recording, 1, 0));
  recording.samples.push_back(sample(ws, 1, 3, corner[0]));
  CHECK(at(recording, 0, 4));
  CHECK(at(recording, 1, 3));
}

TEST_CASE("traces show the path of the pen in light green, in page coordinates", "[practice]") {
  const PracticePage page = page_of("永北");
  Recording recording;
  recording.samples.push_back(sample(ss, 0, 0, {0.01, 0.01}));
  append_run(recording, 0, 0, corner, TickEvent::stroke_finished);
  const auto document = xml(page_picture(page, recording, 0, "title"));
  const auto traces = all(document, "//g[@class='trace']");
  REQUIRE(traces.size() == 1);
  CHECK(std::string(traces[0].attribute("stroke").value()) == "#5fce5f");
  REQUIRE(paths(traces[0]) == 1);
  const auto drawn = points(traces[0].child("path"));
  REQUIRE(drawn.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK((drawn[i] - in_picture(document, corner[i])).norm() < 0.001);
}

TEST_CASE("traces of abandoned attempts are omitted, an unfinished one is shown", "[practice]") {
  const PracticePage page = page_of("永北");
  const auto count = [&page](const Recording& recording) {
    const auto document = xml(page_picture(page, recording, 0, "title"));
    return all(document, "//g[@class='trace']/path").size();
  };
  Recording recording;
  append_run(recording, 0, 0, corner, TickEvent::stroke_abandoned);
  CHECK(count(recording) == 0);
  append_run(recording, 0, 0, corner, TickEvent::stroke_finished);
  append_run(recording, 0, 1, corner, TickEvent::stroke_abandoned);
  append_run(recording, 0, 1, corner, TickEvent::stroke_abandoned);
  CHECK(count(recording) == 1);
  recording.samples.push_back(sample(ws, 0, 1, corner[0]));
  recording.samples.push_back(sample(ws, 0, 1, corner[1]));
  CHECK(count(recording) == 2);
}

TEST_CASE("a stroke that ends as the next character begins belongs to its own character", "[practice]") {
  const PracticePage page = page_of("永北");
  Recording recording;
  append_run(recording, 0, 4, corner, TickEvent::stroke_finished);
  recording.samples.back().character = 1;
  append_run(recording, 1, 0, corner, TickEvent::stroke_finished);
  const auto count = [&](int active) {
    return all(xml(page_picture(page, recording, active, "title")), "//g[@class='trace']/path").size();
  };
  CHECK(count(0) == 1);
  CHECK(count(1) == 2);
}

TEST_CASE("rejected samples leave no mark", "[practice]") {
  const PracticePage page = page_of("永");
  Recording recording;
  append_run(recording, 0, 0, corner, TickEvent::stroke_finished);
  RecordedSample bad = sample(ws, 0, 0, {1.0, 1.0});
  bad.status = TickStatus::bad_sample;
  recording.samples.insert(recording.samples.begin() + 1, bad);
  bad.status = TickStatus::ok;
  bad.pen_tip.setConstant(std::numeric_limits<double>::quiet_NaN());
  recording.samples.insert(recording.samples.begin() + 1, bad);
  const std::string svg = page_picture(page, recording, 0, "title");
  CHECK(points(all(xml(svg), "//g[@class='trace']/path").at(0)).size() == 3);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("a drawn trace is within 0.03 mm of the recorded one", "[practice]") {
  Recording recording;
  std::vector<Point> wave;
  for (int i = 0; i < 5000; ++i) wave.emplace_back(0.04 + 8e-6 * i, 0.06 + 0.002 * std::sin(0.01 * i));
  append_run(recording, 0, 0, wave, TickEvent::stroke_finished);
  const auto document = xml(page_picture(page_of("永"), recording, 0, "title"));
  const auto drawn = points(all(document, "//g[@class='trace']/path").at(0));
  CHECK(drawn.size() < 500);
  double largest = 0.0;
  for (const Point& tip : wave) {
    const Point place = in_picture(document, tip);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < drawn.size(); ++i) {
      const Point chord = drawn[i + 1] - drawn[i];
      const double t = std::clamp((place - drawn[i]).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (place - drawn[i] - t * chord).norm());
    }
    largest = std::max(largest, nearest);
  }
  CHECK(largest < 0.03);  // [mm]
}

TEST_CASE("the picture of a long scribble stays under 300 kB", "[practice]") {
  const PracticePage page = page_of("永北京航空天");
  Recording recording;
  calligraphy_test::Sequence random(1);
  for (int character = 0; character < 6; ++character) {
    for (int stroke = 0; stroke < 4; ++stroke) {
      std::vector<Point> scribble;
      for (int i = 0; i < 5000; ++i) scribble.push_back(random.point(0.05, 0.055));
      append_run(recording, character, stroke, scribble, TickEvent::stroke_finished);
    }
  }
  const std::string svg = page_picture(page, recording, 5, "title");
  CHECK(svg.size() < 300000);
  CHECK(all(xml(svg), "//g[@class='trace']/path").size() == 24);
}

TEST_CASE("the picture of a real session shows one trace per finished stroke", "[practice]") {
  const PracticePage page = page_of("永北");
  const Recording recording = write_page(page, calligraphy_test::session(WriterSkill::novice(), FeedbackMode::force));
  std::size_t finished = 0;
  for (const RecordedSample& each : recording.samples) finished += has_event(each.events, TickEvent::stroke_finished);
  REQUIRE(finished > 0);
  const std::string svg = page_picture(page, recording, 1, "title");
  CHECK(all(xml(svg), "//g[@class='trace']/path").size() == finished);
  CHECK(page_picture(page, recording, 1, "title") == svg);
}

TEST_CASE("a title may contain anything but invalid UTF-8", "[practice]") {
  const PracticePage page = page_of("永");
  for (const std::string title : {"<&>\"'", "北京 ]]> <!--", "bell \x07 and tab\t", "",
                                  "a very long title, much longer than the page is wide, which must be set smaller"}) {
    CAPTURE(title);
    const auto document = xml(page_picture(page, {}, 0, title));
    std::string expected = title;
    for (char& c : expected) c = (c == '\x07' || c == '\t') ? ' ' : c;
    CHECK(document.child("svg").child("title").text().get() == expected);
  }
  CHECK_THROWS_AS(page_picture(page, {}, 0, "\xff"), FormatError);
}

TEST_CASE("an invalid page or active character is an error naming the value", "[practice]") {
  const PracticePage page = page_of("永");
  const auto error = [](const PracticePage& some, int active) -> std::string {
    try {
      page_picture(some, {}, active, "title");
    } catch (const ValueError& caught) {
      return caught.what();
    }
    return {};
  };
  CHECK(error(page, 1) == "active character 1: the page has 1");
  CHECK(error(page, -1) == "active character -1: the page has 1");
  CHECK(error({0.1, 0.1, {}}, 0) == "active character 0: the page has 0");
  CHECK(error({0.0, 0.1, page.characters}, 0).find("width of the page = 0 m") == 0);
  CHECK(error({0.1, 0.1, {PlacedCharacter{}}}, 0) == "character 0 of the page: there is no stroke");
}

TEST_CASE("the sheet of typical strokes has a group for each of the 39", "[practice]") {
  const auto document = xml(typical_strokes_picture());
  const auto groups = all(document, "//g[@class='stroke']");
  REQUIRE(groups.size() == typical_stroke_count);
  for (const TypicalStroke& type : typical_strokes()) {
    CAPTURE(type.id);
    const pugi::xml_node group = groups[static_cast<std::size_t>(type.id - 1)];
    std::string text;
    int features = 0, controls = 0, curves = 0;
    for (const auto& node : group.children("text")) text += std::string(node.text().get()) + "|";
    for (const auto& node : group.children("circle")) {
      features += node.attribute("class").value() == std::string("feature");
      controls += node.attribute("class").value() == std::string("control");
    }
    for (const auto& node : group.children("path")) curves += !node.attribute("stroke-dasharray").empty();
    CHECK(text.find(std::to_string(type.id) + "  " + std::string(type.name) + "|") == 0);
    CHECK(text.find(std::string(type.pinyin) + "|") != std::string::npos);
    CHECK(text.find(std::string(type.code)) != std::string::npos);
    CHECK(text.find(std::string(type.elements) + "|") != std::string::npos);
    CHECK(features == feature_point_count(type.elements));
    CHECK(features + controls == control_point_count(type.elements));
    CHECK(curves == std::count(type.elements.begin(), type.elements.end(), 'C'));
  }
}
