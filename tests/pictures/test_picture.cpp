#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_ink.hpp>
#include <calligraphy/pictures/chinese_font.hpp>
#include <calligraphy/pictures/pdf.hpp>
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

/// Corner of the page in its picture [mm].
Point lower_left(const pugi::xml_document& document) {
  const pugi::xml_node frame = all(document, "//rect[@class='page']").at(0);
  return {frame.attribute("x").as_double(), frame.attribute("y").as_double() + frame.attribute("height").as_double()};
}

Point in_picture(const pugi::xml_document& document, const Point& page_point) {
  return lower_left(document) + 1e3 * Point(page_point.x(), -page_point.y());
}

std::string text_of(const std::vector<pugi::xml_node>& nodes, const char* between = "|") {
  std::string text;
  for (const auto& node : nodes) text += (text.empty() ? "" : between) + std::string(node.text().get());
  return text;
}

/// Relative luminance of "#rrggbb" as W3C defines it, 0 to 1, which is what is left of a colour in black and white.
double luminance(const std::string& colour) {
  REQUIRE(colour.size() == 7);
  const double weights[] = {0.2126, 0.7152, 0.0722};
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    sum += weights[i] * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  return sum;
}

double contrast(const std::string& light, const std::string& dark) {
  return (luminance(light) + 0.05) / (luminance(dark) + 0.05);
}

PenPath middle_of(const PlacedCharacter& placed, std::size_t stroke) {
  return stroke_polyline(strokes(placed.character)[stroke]);
}

PenPath backwards(PenPath path) {
  std::reverse(path.begin(), path.end());
  return path;
}

/// Writes on a page, pen-down by pen-down.
class Hand {
 public:
  explicit Hand(const PracticePage& page) : page_(page) {}

  /// A pen-down [em], which the session counts as the stroke that is due, or not.
  void draw(const PenPath& path, bool counts, bool lifts = true) {
    const Placement& placement = page_.characters[static_cast<std::size_t>(character_)].placement;
    for (const Point& point : path) add(InteractionState::writing, placement.to_page(point));
    if (counts) {
      const bool is_last = ++stroke_ == page_.characters[static_cast<std::size_t>(character_)].character.stroke_count();
      recording.samples.back().events = TickEvent::stroke_finished;
      recording.samples.back().stroke = stroke_;
      if (is_last && lifts) std::tie(character_, stroke_) = std::pair(character_ + 1, 0);
    }
    if (!lifts) return;
    time_ += 0.3;
    add(InteractionState::separation, placement.to_page(path.back()));
    time_ += 0.3;
  }
  void write(std::initializer_list<std::size_t> strokes) {
    for (const std::size_t stroke : strokes) {
      draw(middle_of(page_.characters[static_cast<std::size_t>(character_)], stroke), true);
    }
  }
  std::vector<CharacterScore> scores() const { return score_page(page_, recording); }
  pugi::xml_document picture(int index = 0, StrokeStyle style = StrokeStyle::ink, const Language& language = {}) const {
    return xml(character_picture(page_, recording, scores(), index, "title", style, language));
  }
  pugi::xml_document page_picture(StrokeStyle style = StrokeStyle::ink) const {
    return xml(calligraphy::page_picture(page_, recording, scores(), "title", style));
  }

  Recording recording;

 private:
  void add(InteractionState state, const Point& tip) {
    RecordedSample& sample = recording.samples.emplace_back();
    sample.time = time_ += 1e-3;
    sample.state = state;
    sample.character = character_;
    sample.stroke = stroke_;
    sample.pen_tip = {tip.x(), tip.y(), 0.0};
  }

  const PracticePage& page_;
  int character_ = 0, stroke_ = 0;
  double time_ = 0.0;
};

/// The lines of a group, without the heads of arrows.
std::vector<pugi::xml_node> lines_of(const pugi::xml_document& document, const std::string& group) {
  return all(document, "//g[@class='" + group + "']/path[@stroke!='none']");
}

/// Scores without remarks, of so many pen-downs of each character.
std::vector<CharacterScore> plain_scores(const PracticePage& page, std::size_t pen_downs) {
  std::vector<CharacterScore> scores(page.characters.size());
  for (CharacterScore& score : scores) score.match.drawn.resize(pen_downs);
  return scores;
}

const char* const red = "#e02020";

}  // namespace

TEST_CASE("the picture of a character shows it alone, and its square as large as the picture", "[practice]") {
  const PracticePage page = page_of("永北");
  const auto document = Hand(page).picture(1, StrokeStyle::lines);
  CHECK(std::string(document.child("svg").attribute("width").value()) == "112mm");
  const auto squares = all(document, "//g[@class='square']/rect");
  REQUIRE(squares.size() == 1);
  const double em = squares[0].attribute("width").as_double();
  CHECK(em > 88.0);
  const Point corner(squares[0].attribute("x").as_double(), squares[0].attribute("y").as_double() + em);
  std::vector<Point> drawn;
  for (const auto& path : all(document, "//g[@class='template']/path")) {
    const auto some = points(path);
    drawn.insert(drawn.end(), some.begin(), some.end());
  }
  const auto& expected = page.characters[1].character.structure.control_points;
  REQUIRE(drawn.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    CHECK((drawn[k] - corner - em * Point(expected[k].x(), -expected[k].y())).norm() < 0.002);
  }
}

TEST_CASE("the picture of a page is life-size and has every character", "[practice]") {
  const PracticePage page = page_of("永北京");
  Hand hand(page);
  hand.write({0, 1, 2, 3, 4});
  hand.write({0, 1});
  const auto document = hand.page_picture();
  const auto frame = all(document, "//rect[@class='page']").at(0);
  CHECK(frame.attribute("width").as_double() == Approx(1e3 * page.width));
  const auto groups = all(document, "//g[@class='template']");
  REQUIRE(groups.size() == 3);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    CHECK(paths(groups[i]) == static_cast<std::size_t>(page.characters[i].character.stroke_count()));
  }
  const auto traces = lines_of(document, "trace");
  REQUIRE(traces.size() == 7);
  const Point start = page.characters[1].placement.to_page(middle_of(page.characters[1], 1).front());
  CHECK((points(traces[6]).front() - in_picture(document, start)).norm() < 0.002);
}

TEST_CASE("template and trace are told apart without colour, and the template from the paper", "[practice]") {
  const PracticePage page = page_of("永");
  Hand hand(page);
  hand.write({0, 1, 2, 3, 4});
  for (const auto& [style, paint] : {std::pair{StrokeStyle::ink, "fill"}, {StrokeStyle::lines, "stroke"}}) {
    const auto document = hand.picture(0, style);
    const std::string pale = all(document, "//g[@class='template']").at(0).attribute(paint).value();
    CHECK(contrast("#ffffff", pale) > 1.3);
    const auto traces = lines_of(document, "trace");
    REQUIRE(traces.size() == 5);
    for (const auto& trace : traces) CHECK(contrast(pale, trace.attribute("stroke").value()) > 4.5);
  }
}

TEST_CASE("each pen-down has a number in writing order at its start, and an arrow along it", "[practice]") {
  const PracticePage page = page_of("永");
  Hand hand(page);
  hand.write({0, 1, 2, 3, 4});
  const auto document = hand.picture();
  const auto traces = lines_of(document, "trace");
  const auto heads = all(document, "//g[@class='trace']/path[@stroke='none']");
  const auto numbers = all(document, "//g[@class='drawn-number']/text");
  CHECK(text_of(numbers) == "1|2|3|4|5");
  REQUIRE(traces.size() == 5);
  REQUIRE(heads.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::vector<Point> line = points(traces[i]), head = points(heads[i]);
    const Point at(numbers[i].attribute("x").as_double(), numbers[i].attribute("y").as_double());
    CHECK((at - line.front()).norm() < 8.0);  // [mm]
    const Point tip = head[0], back = 0.5 * (head[1] + head[2]);
    CHECK(distance(line, tip) < 0.5);
    const auto share = [&line](const Point& point) {
      std::size_t nearest = 0;
      for (std::size_t k = 0; k < line.size(); ++k) {
        if ((line[k] - point).norm() < (line[nearest] - point).norm()) nearest = k;
      }
      return nearest;
    };
    CHECK(share(back - 10.0 * (tip - back)) <= share(tip + 2.0 * (tip - back)));
    CHECK((tip - back).norm() > 2.0);
  }
  CHECK(all(document, "//g[@class='standard-number']").empty());
}

TEST_CASE("an arrow goes the way of its jittery trace as a whole, and is left out where it has none", "[practice]") {
  const PracticePage page = page_of("一");
  const auto arrows = [&page](const PenPath& path) {
    Hand hand(page);
    hand.draw(path, false);
    return all(xml(character_picture(page, hand.recording, plain_scores(page, 1), 0, "title")),
               "//g[@class='attempt']/path[@stroke='none']");
  };
  calligraphy_test::Sequence random(3);
  std::size_t drawn = 0;
  for (int trace = 0; trace < 200; ++trace) {
    const double size = 0.2 + 0.001 * trace, from = 0.1 * trace;  // of a quarter circle about its middle
    PenPath path;
    for (double angle = from; angle < from + 1.57; angle += 0.008 / size) {
      const Point on = Point::Constant(0.5) + size * Point(std::cos(angle), std::sin(angle));
      path.push_back(on + random.point(-0.004, 0.004));
      const bool wavers = random.point(0.0, 1.0).x() < 0.15;
      for (int i = 0; wavers && i < 6; ++i) path.push_back(on + random.point(-0.02, 0.02));
    }
    for (const auto& arrow : arrows(path)) {
      const std::vector<Point> head = points(arrow);
      const Point back = 0.5 * (head[1] + head[2]), ahead = (head[0] - back).normalized();
      const Point out = (0.5 * (head[0] + back) - Point(56.0, 60.0)).normalized();  // from the middle [mm]
      CAPTURE(trace);
      CHECK(ahead.dot(Point(out.y(), -out.x())) > 0.7);  // downwards is positive, so counterclockwise
      ++drawn;
    }
  }
  CHECK(drawn > 150);
  PenPath shading;
  for (int i = 0; i < 150; ++i) shading.emplace_back(0.2 + 0.003 * i, i % 2 == 0 ? 0.47 : 0.53);
  CHECK(arrows(shading).empty());
}

TEST_CASE("an attempt that did not count is faint and dashed, and then strokes have numbers of their own", "[practice]") {
  const PracticePage page = page_of("十");
  Hand hand(page);
  hand.draw(middle_of(page.characters[0], 1), false);
  hand.write({0, 1});
  const auto document = hand.picture();
  CHECK(lines_of(document, "trace").size() == 2);
  CHECK(lines_of(document, "attempt").size() == 1);
  const auto group = all(document, "//g[@class='attempt']").at(0);
  CHECK_FALSE(group.attribute("stroke-dasharray").empty());
  CHECK(group.attribute("opacity").as_double() < 1.0);
  CHECK(text_of(all(document, "//g[@class='drawn-number']/text")) == "1|2|3");
  CHECK(text_of(all(document, "//g[@class='standard-number']/text")) == "1|2");
}

TEST_CASE("a trace begins where writing began, after a faint and thin slide to there", "[practice]") {
  const PracticePage page = page_of("一");
  const PlacedCharacter& placed = page.characters[0];
  const PenPath line = middle_of(placed, 0);
  const Point start = line.front(), along = (line.back() - start).normalized(), touch = start + Point(0.0, 0.1);
  PenPath path;
  for (int i = 0; i < 20; ++i) path.push_back(touch + 0.05 * i * (start - touch));
  for (double way = 0.0; way < (line.back() - start).norm(); way += 0.005) path.push_back(start + way * along);
  for (const bool counts : {true, false}) {
    Hand hand(page);
    hand.draw(path, counts);
    hand.recording.samples[28].events = TickEvent::stroke_started;  // after a first stretch of 0.04 em
    const auto document = hand.page_picture();
    const auto first = [&](const char* group) { return points(lines_of(document, group).at(0)).front(); };
    const auto place = [&](const Point& point) { return in_picture(document, placed.placement.to_page(point)); };
    if (!counts) {
      CHECK((first("attempt") - place(touch)).norm() < 0.002);
      CHECK(lines_of(document, "slide").empty());
      continue;
    }
    CHECK((first("trace") - place(start)).norm() < 0.0051 * 1e3 * placed.placement.em);
    CHECK((first("slide") - place(touch)).norm() < 0.002);
    CHECK(points(lines_of(document, "slide").at(0)).back() == first("trace"));
    const auto trace = all(document, "//g[@class='trace']").at(0), slide = all(document, "//g[@class='slide']").at(0);
    CHECK(slide.attribute("stroke-width").as_double() < 0.7 * trace.attribute("stroke-width").as_double());
    CHECK(slide.attribute("opacity").as_double() < 1.0);
  }
}

TEST_CASE("mistakes are red where they are", "[practice]") {
  const PracticePage page = page_of("三");
  const auto colour = [](const pugi::xml_document& document, const char* group, std::size_t line) {
    return std::string(lines_of(document, group).at(line).attribute("stroke").value());
  };
  Hand early(page);
  early.draw(middle_of(page.characters[0], 2), false);
  early.write({0, 1});
  CHECK(colour(early.picture(), "attempt", 0) == red);
  CHECK(colour(early.picture(), "trace", 0) == "#333333");

  Hand reversed(page);
  reversed.write({0, 1});
  reversed.draw(backwards(middle_of(page.characters[0], 2)), true);
  CHECK(colour(reversed.picture(), "trace", 2) == red);

  Hand missing(page);
  missing.write({0});
  missing.draw(middle_of(page.characters[0], 2), false);
  missing.draw({{0.2, 0.95}, {0.25, 0.8}, {0.2, 0.99}}, false);
  const auto gap = missing.picture();
  const auto strokes_of = all(gap, "//g[@class='template']/path");
  CHECK(strokes_of.at(0).attribute("fill").empty());
  CHECK(std::string(strokes_of.at(1).attribute("fill").value()) == "#f8cccc");
  CHECK(std::string(all(gap, "//g[@class='standard-number']/text").at(1).attribute("fill").value()) == red);
  CHECK(colour(gap, "attempt", 1) == red);
}

TEST_CASE("a ring is at the start of the stroke that is due until the character is complete", "[practice]") {
  const PracticePage page = page_of("十永");
  const auto due = [&page](const Hand& hand, int index) {
    const auto document = hand.page_picture();
    const auto rings = all(hand.picture(index), "//*[@class='start']");
    const auto on_page = all(document, "//*[@class='start']");
    if (rings.empty()) return -1;
    REQUIRE(on_page.size() == 1);
    const Point centre(on_page[0].attribute("cx").as_double(), on_page[0].attribute("cy").as_double());
    const PlacedCharacter& placed = page.characters[static_cast<std::size_t>(index)];
    for (int stroke = 0; stroke < placed.character.stroke_count(); ++stroke) {
      const Point start = middle_of(placed, static_cast<std::size_t>(stroke)).front();
      if ((centre - in_picture(document, placed.placement.to_page(start))).norm() < 0.002) return stroke;
    }
    return -2;
  };
  Hand hand(page);
  CHECK(due(hand, 0) == 0);
  CHECK(due(hand, 1) == -1);
  hand.write({0});
  CHECK(due(hand, 0) == 1);
  Hand resting = hand;  // complete, with the pen still down
  resting.draw(middle_of(page.characters[0], 1), true, false);
  CHECK(due(resting, 0) == -1);
  hand.write({1});
  hand.write({0, 1, 2});
  CHECK(due(hand, 0) == -1);
  CHECK(due(hand, 1) == 3);
  hand.write({3, 4});
  CHECK(all(hand.page_picture(), "//*[@class='start']").empty());
}

TEST_CASE("a stroke in progress is drawn like one that counts", "[practice]") {
  const PracticePage page = page_of("永");
  Hand hand(page);
  hand.write({0});
  hand.draw(middle_of(page.characters[0], 1), false, false);
  CHECK(lines_of(hand.picture(), "trace").size() == 2);
  CHECK(lines_of(hand.picture(), "attempt").empty());
}

TEST_CASE("where nothing was written, nothing is marked as missing", "[practice]") {
  const PracticePage page = page_of("永北");
  const auto document = Hand(page).picture(1);
  CHECK(all(document, "//*[@fill='#f8cccc' or @stroke='#f8cccc' or @fill='#e02020']").empty());
  CHECK(all(document, "//g[@class='remarks']/text").empty());
}

TEST_CASE("the legend names what is in the picture, in the language asked for", "[practice]") {
  const PracticePage page = page_of("十");
  const auto legend = [](const pugi::xml_document& document) {
    return text_of(all(document, "//g[@class='legend']/text"));
  };
  Hand hand(page);
  CHECK(legend(hand.picture()) == "template|start of the stroke that is due");
  Hand wrong = hand;
  hand.write({0, 1});
  CHECK(legend(hand.picture()) == "template|as written, numbered in order");
  CHECK(legend(hand.picture(0, StrokeStyle::ink, Language("zh"))) == "范字|所写的笔画，按先后编号");
  wrong.draw(backwards(middle_of(page.characters[0], 0)), false);
  wrong.write({0, 1});
  CHECK(legend(wrong.picture()) ==
        "template|as written, numbered in order|out of order, backwards or extra|attempt that did not count|"
        "correct order|1 2");
  std::vector<CharacterScore> scores = hand.scores();
  scores[0].match.remarks = {{.kind = StrokeRemarkKind::wavy, .path = 1, .path_count = 1, .stroke = 1,
                              .stroke_count = 1, .place = {0.5, 0.5}}};
  const auto wavy = xml(character_picture(page, hand.recording, scores, 0, "title"));
  CHECK(legend(wavy) ==
        "template|as written, numbered in order|joined, broken or of another form|what a remark points at");
  CHECK(all(wavy, "//circle[@class='place']").size() == 1);
}

TEST_CASE("all remarks are below, in lines that are no wider than the picture", "[practice]") {
  const PracticePage page = page_of("十");
  Hand hand(page);
  hand.draw(backwards(middle_of(page.characters[0], 0)), false);
  hand.write({0, 1});
  const MatchResult match = hand.scores().at(0).match;
  for (const Language& language : languages()) {
    std::string expected, written;
    for (const StrokeRemark& remark : match.remarks) expected += remark_text(remark, match.character, language);
    REQUIRE_FALSE(expected.empty());
    const auto document = hand.picture(0, StrokeStyle::ink, language);
    for (const auto& node : all(document, "//g[@class='remarks']/text")) {
      const std::string line = node.text().get();
      CHECK(decode_utf8(line).size() <= (language.code() == "zh" ? 31 : 53));
      written += line;
    }
    CHECK(written == expected);
  }
}

TEST_CASE("a template is filled from the middle of every stroke to its edge, and no further", "[practice]") {
  const PracticePage page = page_of("永北京航空");
  const std::string svg = page_picture(page, {}, plain_scores(page, 0), "title");
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
  const auto document = xml(svg);
  const auto groups = all(document, "//g[@class='template']");
  REQUIRE(groups.size() == page.characters.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Character character = with_typical_ink(page.characters[i].character);
    const Placement& placement = page.characters[i].placement;
    const std::vector<Stroke> expected = strokes(character);
    std::size_t at = 0;
    for (const auto& path : groups[i].children("path")) {
      CAPTURE(encode_utf8(character.code), at);
      REQUIRE(at < expected.size());
      const std::vector<InkDisc> discs = ink_discs(expected[at]);
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
  std::fill_n(ink.half_widths.begin(), 8, 0.1);
  page.characters[0].character.physics.ink = {ink};
  const auto document = xml(page_picture(page, {}, plain_scores(page, 0), "title"));
  const auto path = all(document, "//g[@class='template']/path").at(0);
  const Stroke stroke = strokes(page.characters[0].character)[0];
  const Point middle = 0.5 * (stroke.control_points.front() + stroke.control_points.back());
  const auto place = [&](double above) {
    return in_picture(document, page.characters[0].placement.to_page(middle + Point(0.0, above)));
  };
  CHECK(is_filled(path, place(0.095)));
  CHECK(is_filled(path, place(-0.095)));
  CHECK_FALSE(is_filled(path, place(0.11)));
}

TEST_CASE("as lines, quartic curves are drawn like the equal cubic curves", "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    PracticePage page = lay_out({&character, 1}).front();
    const auto cubic = xml(page_picture(page, {}, plain_scores(page, 0), "title", StrokeStyle::lines));
    page.characters[0].character = with_quartic_curves(character);
    const auto quartic = xml(page_picture(page, {}, plain_scores(page, 0), "title", StrokeStyle::lines));
    const auto cubic_paths = all(cubic, "//g[@class='template']/path");
    const auto quartic_paths = all(quartic, "//g[@class='template']/path");
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

TEST_CASE("a pen that stood still leaves a dot, and rejected samples leave no mark", "[practice]") {
  const PracticePage page = page_of("永");
  Hand still(page);
  still.draw({{0.5, 0.5}, {0.5, 0.5}}, false);
  CHECK(points(lines_of(still.picture(), "attempt").at(0)).size() == 2);
  Hand hand(page);
  hand.draw({{0.2, 0.5}, {0.5, 0.5}, {0.5, 0.7}}, false);
  const std::string expected = lines_of(hand.picture(), "attempt").at(0).attribute("d").value();
  RecordedSample bad = hand.recording.samples[1];
  bad.pen_tip.setConstant(1.0);
  bad.status = TickStatus::bad_sample;
  hand.recording.samples.insert(hand.recording.samples.begin() + 1, bad);
  bad.status = TickStatus::ok;
  bad.pen_tip.setConstant(std::numeric_limits<double>::quiet_NaN());
  hand.recording.samples.insert(hand.recording.samples.begin() + 1, bad);
  CHECK(lines_of(hand.picture(), "attempt").at(0).attribute("d").value() == expected);
}

TEST_CASE("a pen that leaves the square stays in the picture", "[practice]") {
  const PracticePage page = page_of("永");
  Hand hand(page);
  hand.draw({{0.5, 0.5}, {1.9, 0.4}, {0.4, -0.9}}, false);
  const auto document = hand.picture();
  for (const Point& point : points(lines_of(document, "attempt").at(0))) {
    CHECK(point.x() < 106.0);
    CHECK(point.y() < 110.0);
  }
}

TEST_CASE("a drawn pen-down is within 0.03 mm of the recorded one on a page", "[practice]") {
  const PracticePage page = page_of("永");
  const Placement& placement = page.characters[0].placement;
  std::vector<Point> wave;
  for (int i = 0; i < 5000; ++i) wave.emplace_back(0.1 + 1.6e-4 * i, 0.5 + 0.05 * std::sin(0.01 * i));
  Hand hand(page);
  hand.draw(wave, false);
  const auto document = hand.page_picture();
  const auto drawn = points(lines_of(document, "attempt").at(0));
  CHECK(drawn.size() < 500);
  double largest = 0.0;
  for (const Point& tip : wave) {
    largest = std::max(largest, distance(drawn, in_picture(document, placement.to_page(tip))));
  }
  CHECK(largest < 0.03);  // [mm]
}

TEST_CASE("the picture of long scribbles stays under 300 kB", "[practice]") {
  const PracticePage page = page_of("永北京航空天");
  calligraphy_test::Sequence random(1);
  Hand hand(page);
  for (const PlacedCharacter& placed : page.characters) {
    for (int i = 0; i < placed.character.stroke_count(); ++i) {
      PenPath scribble;
      for (int k = 0; k < 5000; ++k) scribble.push_back(random.point(0.1, 0.9));
      hand.draw(scribble, true);
    }
  }
  std::vector<CharacterScore> scores(page.characters.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    scores[i].match.drawn.resize(static_cast<std::size_t>(page.characters[i].character.stroke_count()));
    count += scores[i].match.drawn.size();
  }
  const std::string svg = page_picture(page, hand.recording, scores, "title");
  CHECK(svg.size() < 300000);
  CHECK(lines_of(xml(svg), "trace").size() == count);
  CHECK(character_picture(page, hand.recording, scores, 3, "title").size() < 300000);
}

TEST_CASE("the pictures of a real session show each of its pen-downs once", "[practice]") {
  const PracticePage page = page_of("永北");
  const Recording recording = write_page(page, calligraphy_test::session(WriterSkill::novice(), FeedbackMode::vision, 2));
  const std::vector<CharacterScore> scores = score_page(page, recording);
  const auto on_page = xml(page_picture(page, recording, scores, "title"));
  std::size_t pen_downs = 0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const auto document = xml(character_picture(page, recording, scores, static_cast<int>(i), "title"));
    CHECK(lines_of(document, "trace").size() == static_cast<std::size_t>(scores[i].strokes_completed));
    CHECK(lines_of(document, "trace").size() + lines_of(document, "attempt").size() == scores[i].match.drawn.size());
    pen_downs += scores[i].match.drawn.size();
  }
  CHECK(pen_downs > 10);  // some did not count
  CHECK(lines_of(on_page, "trace").size() + lines_of(on_page, "attempt").size() == pen_downs);
}

TEST_CASE("a title may contain anything but invalid UTF-8", "[practice]") {
  const PracticePage page = page_of("永");
  for (const std::string title : {"<&>\"'", "北京 ]]> <!--", "bell \x07 and tab\t", "",
                                  "a very long title, much longer than the page is wide, which must be set smaller"}) {
    CAPTURE(title);
    const auto document = xml(page_picture(page, {}, plain_scores(page, 0), title));
    std::string expected = title;
    for (char& c : expected) c = (c == '\x07' || c == '\t') ? ' ' : c;
    CHECK(document.child("svg").child("title").text().get() == expected);
  }
  CHECK_THROWS_AS(character_picture(page, {}, plain_scores(page, 0), 0, "\xff"), FormatError);
}

TEST_CASE("an invalid page, an index beyond it or scores of other writing are an error naming the value", "[practice]") {
  const PracticePage page = page_of("永");
  const auto error = [](const PracticePage& some, int index, std::size_t pen_downs = 0) -> std::string {
    try {
      character_picture(some, {}, plain_scores(some, pen_downs), index, "title");
    } catch (const ValueError& caught) {
      return caught.what();
    }
    return {};
  };
  CHECK(error(page, 1) == "character 1: the page has 1");
  CHECK(error(page, -1) == "character -1: the page has 1");
  CHECK(error(page, 0, 2) == "scores: character 0 has 2 pen-downs, in the recording 0");
  CHECK(error({0.0, 0.1, page.characters}, 0).find("width of the page") == 0);
  CHECK_FALSE(error({0.1, 0.1, {PlacedCharacter{}}}, 0).empty());
  CHECK_THROWS_AS(page_picture(page, {}, {}, "title"), ValueError);
}

TEST_CASE("the poster of typical strokes has a cell with names, marks and points for each of the 39", "[practice]") {
  const auto document = xml(typical_strokes_picture(StrokeStyle::ink, "A font"));
  const auto groups = all(document, "//g[@class='stroke']");
  REQUIRE(groups.size() == typical_stroke_count);
  for (const TypicalStroke& type : typical_strokes()) {
    CAPTURE(type.id);
    const pugi::xml_node group = groups[static_cast<std::size_t>(type.id - 1)];
    const auto text = [&](const char* of) {
      return std::string(group.find_child_by_attribute("text", "class", of).text().get());
    };
    CHECK(text("number") == std::to_string(type.id));
    CHECK(text("name") == type.name);
    CHECK(text("pinyin") == type.pinyin);
    CHECK(text("code") == std::string(type.code) + " · " + std::string(type.elements));

    // Every point where its coordinates say, in the square of this cell.
    const pugi::xml_node frame = group.find_child_by_attribute("rect", "class", "frame");
    const double em = frame.attribute("width").as_double();
    const auto place = [&](const auto& point) {
      return Point(frame.attribute("x").as_double() + em * point[0],
                   frame.attribute("y").as_double() + em * (1.0 - point[1]));
    };
    std::vector<Point> drawn;
    for (const auto& node : group.children("circle")) {
      const Point at(node.attribute("cx").as_double(), node.attribute("cy").as_double());
      const std::string mark = node.attribute("class").value();
      if (mark == "start") CHECK((at - place(type.shape.front())).norm() < 0.002);
      if (mark == "end") CHECK((at - place(type.shape.back())).norm() < 0.002);
      drawn.push_back(at);
    }
    CHECK(drawn.size() == static_cast<std::size_t>(control_point_count(type.elements)));
    for (const auto& point : type.shape) {
      const auto is_there = [&](const Point& at) { return (at - place(point)).norm() < 0.002; };
      CHECK(std::any_of(drawn.begin(), drawn.end(), is_there));
    }

    // An arrow head along every element but those so short that it would hide their ink.
    const auto path = group.find_child_by_attribute("path", "class", "path");
    std::vector<Point> heads, directions;
    for (const auto& node : group.children("path")) {
      if (node.attribute("class").value() != std::string("direction")) continue;
      const std::vector<Point> head = points(node);
      heads.push_back(0.5 * (head[0] + 0.5 * (head[1] + head[3])));
      directions.push_back(head[0] - head[2]);
    }
    const std::vector<int> features = feature_points(type.elements);
    std::size_t head = 0;
    for (std::size_t i = 0; i < type.elements.size(); ++i) {
      const Point from = place(type.shape[static_cast<std::size_t>(features[i])]);
      const Point to = place(type.shape[static_cast<std::size_t>(features[i + 1])]);
      const bool is_line = type.elements[i] == static_cast<char>(ElementKind::line);
      if ((to - from).norm() < (is_line ? 0.16 : 0.22) * em) continue;
      REQUIRE(head < heads.size());
      CHECK(directions[head].normalized().dot((to - from).normalized()) > 0.9);
      if (is_line) CHECK((heads[head] - 0.5 * (from + to)).norm() < 0.002);
      CHECK(is_filled(group.child("g").child("path"), heads[head]));
      ++head;
    }
    CHECK(head == heads.size());
    CHECK(points(path).size() == type.shape.size());
  }
}

TEST_CASE("the poster of typical strokes is an A3 page, with all text on it, large enough for a wall", "[practice]") {
  for (const std::string& font : {std::string(), std::string("A font")}) {
    const auto document = xml(typical_strokes_picture(StrokeStyle::ink, font));
    const pugi::xml_node root = document.child("svg");
    CHECK(std::string(root.attribute("width").value()) == "420mm");
    CHECK(std::string(root.attribute("height").value()) == "297mm");
    CHECK(std::string(root.attribute("viewBox").value()) == "0 0 420 297");
    for (const auto& node : all(document, "//text")) {
      const std::string text = std::string(node.text().get()) + node.child("tspan").text().get();
      CAPTURE(text);
      double ems = 0.0;  // in a wide font
      for (const char32_t code : decode_utf8(text)) ems += code < 0x2e80 ? 0.6 : 1.0;
      const double size = node.attribute("font-size").as_double(), x = node.attribute("x").as_double();
      CHECK(node.attribute("y").as_double() < 297.0 - 5.0);
      CHECK(x > 10.0);
      CHECK(x + size * ems < 420.0 - 10.0);
      CHECK(size > 3.5);
    }
  }
}

TEST_CASE("without a font, no typical stroke has its name in Chinese", "[practice]") {
  const std::string picture = typical_strokes_picture(StrokeStyle::ink, "");
  const std::u32string codes = decode_utf8(picture);
  CHECK(std::none_of(codes.begin(), codes.end(), [](char32_t code) { return code >= 0x2e80; }));
  const auto document = xml(picture);
  CHECK(all(document, "//text[@class='pinyin']").size() == typical_stroke_count);
}

TEST_CASE("names in Chinese ask for the font first, whatever its name", "[practice]") {
  const auto document = xml(typical_strokes_picture(StrokeStyle::ink, "Ann's <Kai> \\ 1"));
  for (const auto& node : all(document, "//text[@class='name']")) {
    CHECK(std::string(node.attribute("font-family").value()).rfind("'Ann\\'s <Kai> \\\\ 1', ", 0) == 0);
  }
  CHECK_THROWS_AS(typical_strokes_picture(StrokeStyle::ink, "\xff"), FormatError);
}

TEST_CASE("a typical stroke is drawn as ink, or as a line of one width", "[practice]") {
  for (const StrokeStyle style : {StrokeStyle::ink, StrokeStyle::lines}) {
    const auto document = xml(typical_strokes_picture(style));
    const auto groups = all(document, "//g[@class='stroke']/g[@class='template']");
    REQUIRE(groups.size() == typical_stroke_count);
    for (const auto& group : groups) {
      CHECK(paths(group) == 1);
      CHECK((group.attribute("fill").value() == std::string("none")) == (style == StrokeStyle::lines));
      CHECK((group.attribute("stroke-width").as_double() > 0.0) == (style == StrokeStyle::lines));
    }
  }
}

TEST_CASE("a font for Chinese has every character of the text", "[practice]") {
  CHECK(chinese_font("\u6c49\U0010fffd").empty());  // for private use: in no font
  CHECK(chinese_font("\u6c49").empty() == typical_strokes_font().empty());
  CHECK_THROWS_AS(chinese_font("\xff"), FormatError);
}

TEST_CASE("a picture becomes a PDF of one page, of its size and the same each time", "[practice]") {
  const std::string picture =
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="2in" height="1in"><rect width="9" height="9"/></svg>)";
  if (!pdf_available()) {
    CHECK_THROWS_AS(pdf_of_svg(picture), Error);
    return;
  }
  const std::string pdf = pdf_of_svg(picture);
  CHECK(pdf.rfind("%PDF-", 0) == 0);
  CHECK(pdf.find("/Count 1") != std::string::npos);
  const std::size_t box = pdf.find("/MediaBox");
  REQUIRE(box != std::string::npos);
  CHECK(pdf.substr(box, 24) == "/MediaBox [ 0 0 144 72 ]");
  CHECK(pdf.find("/CreationDate") == std::string::npos);
  CHECK(pdf_of_svg(picture) == pdf);
  CHECK_THROWS_AS(pdf_of_svg("<svg"), FormatError);
  CHECK_THROWS_AS(pdf_of_svg(R"(<svg xmlns="http://www.w3.org/2000/svg" width="100%" height="0"/>)"), FormatError);
}
