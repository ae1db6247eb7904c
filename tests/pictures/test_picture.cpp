#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_ink.hpp>
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

/// Whether a point is within a filled path, by the nonzero rule.
bool is_filled(const pugi::xml_node& path, const Point& at) {
  const std::vector<Point> polygon = points(path);
  double turn = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point from = polygon[i] - at, to = polygon[(i + 1) % polygon.size()] - at;
    turn += std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  }
  return std::abs(turn) > 3.0;
}

double distance(const std::vector<Point>& line, const Point& from) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point chord = line[i + 1] - line[i];
    const double t = std::clamp((from - line[i]).dot(chord) / std::max(chord.squaredNorm(), 1e-300), 0.0, 1.0);
    nearest = std::min(nearest, (from - line[i] - t * chord).norm());
  }
  return nearest;
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
      CHECK(std::string(group.attribute("fill").value()) == (i == active ? "#f2b705" : "#5b8ff0"));
    }
  }
}

TEST_CASE("a template is filled from the middle of every stroke to its edge, and no further", "[practice]") {
  const PracticePage page = page_of("永北京航空");
  const std::string svg = page_picture(page, {}, 0, "title");
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
  const auto document = xml(svg);
  const auto groups = templates(document);
  REQUIRE(groups.size() == page.characters.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Character character = with_typical_ink(page.characters[i].character);
    const Placement& placement = page.characters[i].placement;
    const std::vector<Stroke> expected = strokes(character);
    std::size_t at = 0;
    for (const auto& path : groups[i].children("path")) {
      CAPTURE(encode_utf8(character.code), at);
      REQUIRE(at < expected.size());
      const std::vector<InkDisc> discs = ink_discs(stroke_polyline(expected[at]), *expected[at].ink);
      ++at;
      const auto place = [&](const Point& em) { return in_picture(document, placement.to_page(em)); };
      std::size_t bare = 0;
      for (const InkDisc& disc : discs) bare += !is_filled(path, place(disc.centre));
      CHECK(bare == 0);
      for (const Point& vertex : points(path)) {
        double outside = std::numeric_limits<double>::infinity();
        for (const InkDisc& disc : discs) {
          outside = std::min(outside, (vertex - place(disc.centre)).norm() - 1e3 * placement.em * disc.radius);
        }
        CHECK(std::abs(outside) < 0.1);  // [mm], at a corner
      }
    }
  }
}

TEST_CASE("the ink of a character takes the place of the typical one", "[practice]") {
  PracticePage page = page_of("一");
  StrokeInk ink;
  ink.half_widths.fill(0.1);
  page.characters[0].character.physics.ink = {ink};
  const auto document = xml(page_picture(page, {}, 0, "title"));
  const auto path = all(document, "//g[@class='template active']/path").at(0);
  const Stroke stroke = strokes(page.characters[0].character)[0];
  const Point middle = 0.5 * (stroke.control_points.front() + stroke.control_points.back());
  const auto place = [&](double above) {
    return in_picture(document, page.characters[0].placement.to_page(middle + Point(0.0, above)));
  };
  CHECK(is_filled(path, place(0.095)));
  CHECK(is_filled(path, place(-0.095)));
  CHECK_FALSE(is_filled(path, place(0.11)));
}

TEST_CASE("as lines, strokes are lines of one width and nothing is filled", "[practice]") {
  const PracticePage page = page_of("永北");
  Recording recording;
  append_run(recording, 0, 0, corner, TickEvent::stroke_finished);
  const auto document = xml(page_picture(page, recording, 1, "title", StrokeStyle::lines));
  const auto groups = templates(document);
  REQUIRE(groups.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const double em = 1e3 * page.characters[i].placement.em;
    CHECK(std::string(groups[i].attribute("fill").value()) == "none");
    CHECK(std::string(groups[i].attribute("stroke").value()) == (i == 1 ? "#f2b705" : "#5b8ff0"));
    CHECK(groups[i].attribute("stroke-width").as_double() == Approx(0.07 * em).epsilon(1e-3));
  }
  const auto trace = all(document, "//g[@class='trace']/path").at(0);
  CHECK(std::string(trace.attribute("fill").value()) == "none");
  CHECK(std::string(trace.attribute("stroke").value()) == "#5fce5f");
}

TEST_CASE("as lines, templates are the strokes' control points on the page, in millimetres and upright", "[practice]") {
  const PracticePage page = page_of("永北");
  const auto document = xml(page_picture(page, {}, 0, "title", StrokeStyle::lines));
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

TEST_CASE("as lines, quartic curves are drawn like the equal cubic curves", "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    PracticePage page = lay_out({&character, 1}).front();
    const auto cubic = xml(page_picture(page, {}, 0, "title", StrokeStyle::lines));
    page.characters[0].character = with_quartic_curves(character);
    const auto quartic = xml(page_picture(page, {}, 0, "title", StrokeStyle::lines));
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
  const auto document = xml(page_picture(page, recording, 0, "title", StrokeStyle::lines));
  const auto traces = all(document, "//g[@class='trace']");
  REQUIRE(traces.size() == 1);
  REQUIRE(paths(traces[0]) == 1);
  CHECK(std::string(traces[0].child("path").attribute("stroke").value()) == "#5fce5f");
  const auto drawn = points(traces[0].child("path"));
  REQUIRE(drawn.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK((drawn[i] - in_picture(document, corner[i])).norm() < 0.001);
}

TEST_CASE("the trace of a finished stroke is light green ink along the path of the pen", "[practice]") {
  PracticePage page = page_of("一");
  StrokeInk ink;
  ink.half_widths.fill(0.05);
  page.characters[0].character.physics.ink = {ink};
  Recording recording;
  append_run(recording, 0, 0, corner, TickEvent::stroke_finished);
  const auto document = xml(page_picture(page, recording, 0, "title"));
  const auto traces = all(document, "//g[@class='trace']/path");
  REQUIRE(traces.size() == 1);
  CHECK(std::string(traces[0].attribute("fill").value()) == "#5fce5f");
  std::vector<Point> path;
  for (const Point& tip : corner) path.push_back(in_picture(document, tip));
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    for (double t = 0.0; t <= 1.0; t += 0.05) CHECK(is_filled(traces[0], path[i] + t * (path[i + 1] - path[i])));
  }
  const double half_width = 0.6 * 0.05 * 1e3 * page.characters[0].placement.em;
  for (const Point& vertex : points(traces[0])) CHECK(std::abs(distance(path, vertex) - half_width) < 0.05);
}

TEST_CASE("the trace of a stroke in progress, or of none that is known, is a line", "[practice]") {
  const PracticePage page = page_of("永");
  const auto is_line = [&page](const Recording& recording) {
    const auto traces = all(xml(page_picture(page, recording, 0, "title")), "//g[@class='trace']/path");
    REQUIRE(traces.size() == 1);
    return traces[0].attribute("fill").value() == std::string("none") && points(traces[0]).size() == 3;
  };
  Recording unknown;
  append_run(unknown, 0, 99, corner, TickEvent::stroke_finished);
  CHECK(is_line(unknown));
  for (RecordedSample& each : unknown.samples) each.stroke = -1;
  CHECK(is_line(unknown));
  Recording open;
  for (const Point& tip : corner) open.samples.push_back(sample(ws, 0, 0, tip));
  CHECK(is_line(open));
}

TEST_CASE("a pen that stood still leaves a dot in either style", "[practice]") {
  const PracticePage page = page_of("永");
  Recording recording;
  append_run(recording, 0, 0, {corner[0], corner[0], corner[0]}, TickEvent::stroke_finished);
  for (const StrokeStyle style : {StrokeStyle::ink, StrokeStyle::lines}) {
    const std::string svg = page_picture(page, recording, 0, "title", style);
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(all(xml(svg), "//g[@class='trace']/path").size() == 1);
  }
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
  const std::string svg = page_picture(page, recording, 0, "title", StrokeStyle::lines);
  CHECK(points(all(xml(svg), "//g[@class='trace']/path").at(0)).size() == 3);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("a drawn trace is within 0.03 mm of the recorded one", "[practice]") {
  Recording recording;
  std::vector<Point> wave;
  for (int i = 0; i < 5000; ++i) wave.emplace_back(0.04 + 8e-6 * i, 0.06 + 0.002 * std::sin(0.01 * i));
  append_run(recording, 0, 0, wave, TickEvent::stroke_finished);
  const auto document = xml(page_picture(page_of("永"), recording, 0, "title", StrokeStyle::lines));
  const auto drawn = points(all(document, "//g[@class='trace']/path").at(0));
  CHECK(drawn.size() < 500);
  double largest = 0.0;
  for (const Point& tip : wave) {
    largest = std::max(largest, distance(drawn, in_picture(document, tip)));
  }
  CHECK(largest < 0.03);  // [mm]
}

TEST_CASE("the picture of long scribbles stays under 300 kB", "[practice]") {
  const PracticePage page = page_of("永北京航空天");
  for (const auto& [attempts, length] : {std::pair{1, 5000}, std::pair{5, 80}}) {
    Recording recording;
    calligraphy_test::Sequence random(1);
    for (int character = 0; character < 6; ++character) {
      for (int i = 0; i < 4 * attempts; ++i) {
        std::vector<Point> scribble;
        for (int k = 0; k < length; ++k) scribble.push_back(random.point(0.05, 0.055));
        append_run(recording, character, i % 4, scribble, TickEvent::stroke_finished);
      }
    }
    for (const StrokeStyle style : {StrokeStyle::ink, StrokeStyle::lines}) {
      const std::string svg = page_picture(page, recording, 5, "title", style);
      CAPTURE(attempts, static_cast<int>(style));
      CHECK(svg.size() < 300000);
      const std::size_t filled = all(xml(svg), "//g[@class='trace']/path[@fill!='none']").size();
      CHECK(all(xml(svg), "//g[@class='trace']/path").size() == static_cast<std::size_t>(24 * attempts));
      CHECK((filled > 0) == (style == StrokeStyle::ink && length == 80));
    }
  }
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

TEST_CASE("the legend of a page is in the language asked for", "[practice]") {
  const auto legend = [](const Language& language) {
    const auto document = xml(page_picture(page_of("永"), {}, 0, "永", StrokeStyle::ink, language));
    std::string words;
    for (const auto& node : all(document, "//g[@class='legend']/text")) words += std::string(node.text().get()) + "|";
    return words;
  };
  CHECK(legend(Language("en")) == "template|active character|trace|start of the active stroke|");
  CHECK(legend(Language("zh")) == "范字|正在写的字|笔迹|当前笔画的起点|");
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

TEST_CASE("a typical stroke is drawn as ink, or as a line of one width", "[practice]") {
  for (const StrokeStyle style : {StrokeStyle::ink, StrokeStyle::lines}) {
    const auto document = xml(typical_strokes_picture(style));
    const auto groups = all(document, "//g[@class='stroke']/g[@class='template']");
    REQUIRE(groups.size() == typical_stroke_count);
    for (const auto& group : groups) {
      CHECK(paths(group) == 1);
      CHECK((group.attribute("fill").value() == std::string("#a9c4f5")) == (style == StrokeStyle::ink));
      CHECK((group.attribute("stroke").value() == std::string("#a9c4f5")) == (style == StrokeStyle::lines));
    }
  }
}
