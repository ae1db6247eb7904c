// parse_kanjivg: an SVG becomes centre lines with labels, and everything else is rejected.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/bezier.hpp>

#include "../catch.hpp"
#include "importers/read/kanjivg.hpp"
#include "importers/read/path_data.hpp"

namespace kanjivg_tests {

using namespace calligraphy;

namespace {

std::string svg(const std::string& content, const std::string& head = "") {
  return "<?xml version=\"1.0\"?>\n" + head +
         "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 109 109\">\n<g>" + content + "</g></svg>";
}

template <typename Action>
std::string complaint_of(Action action) {
  try {
    action();
  } catch (const FormatError& error) {
    return error.what();
  }
  return {};
}

std::string complaint(const std::string& text) {
  return complaint_of([&] { parse_kanjivg(text, "x.svg"); });
}

std::string path_complaint(const std::string& data) {
  return complaint_of([&] { flattened_path(data, 0.01); });
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

double distance_to(const std::vector<Point>& path, const Point& point) {
  double nearest = INFINITY;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point along = path[i] - path[i - 1];
    const double t = std::clamp((point - path[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point - path[i - 1] - t * along).norm());
  }
  return nearest;
}

}  // namespace

TEST_CASE("109 units with y down become the em square with y up, with labels and order kept", "[practice]") {
  const Drawing drawing = parse_kanjivg(
      svg(R"(<g><path kvg:type="㇐" d="M0,109c36.3,0,72.6,0,109,0"/></g><path d="M54.5,0C54.5,30,54.5,80,54.5,109"/>)",
          "<!-- Copyright -->"),
      "x.svg");
  REQUIRE(drawing.strokes.size() == 2);
  CHECK(drawing.notice == " Copyright ");
  CHECK(drawing.strokes[0].label == "㇐");
  CHECK(drawing.strokes[1].label.empty());
  CHECK((drawing.strokes[0].path.front() - Point(0.0, 0.0)).norm() < 1e-12);
  CHECK((drawing.strokes[0].path.back() - Point(1.0, 0.0)).norm() < 1e-12);
  CHECK((drawing.strokes[1].path.front() - Point(0.5, 1.0)).norm() < 1e-12);
  CHECK((drawing.strokes[1].path.back() - Point(0.5, 0.0)).norm() < 1e-12);
}

TEST_CASE("a polyline is within the tolerance of its curve everywhere", "[practice]") {
  const Bezier<3> curve{{Point(10, 10), Point(90, 5), Point(-20, 100), Point(70, 95)}};
  for (const double tolerance : {1.0, 0.1, 0.005}) {
    const std::vector<Point> path = flattened_path("M10,10C90,5-20,100,70,95", tolerance);
    for (int i = 0; i <= 1000; ++i) {
      REQUIRE(distance_to(path, curve.point(i / 1000.0)) <= tolerance);
    }
  }
}

TEST_CASE("relative, smooth and repeated commands draw the same curve as absolute ones", "[practice]") {
  // S mirrors the last handle: (40, 20) at (30, 30) is (20, 40).
  const std::string absolute = "M10 10C20 10 40 20 30 30C20 40 50 50 60 60";
  const std::vector<Point> expected = flattened_path(absolute, 0.01);
  for (const char* const same :
       {"m10,10c10,0,30,10,20,20s20,20,30,30", "M10,10C20,10 40,20 30,30S50,50 60,60",
        "M10 10c10 0 30 10 20 20-10 10 20 20 30 30", " M 10 , 10 \n C 20 , 10 , 40 , 20 , 30 , 30 S 50 , 50 , 60 , 60 ",
        "M+10+1e1C20,10,40,20,30.0,30s2e1.2e2,30,30"}) {
    INFO(same);
    const std::vector<Point> path = flattened_path(same, 0.01);
    REQUIRE(path.size() == expected.size());
    for (std::size_t i = 0; i < path.size(); ++i) CHECK((path[i] - expected[i]).norm() < 1e-9);
  }
}

TEST_CASE("path data other than a centre line is rejected with its byte", "[practice]") {
  CHECK(has(path_complaint(""), "at byte 0: expected a command"));
  CHECK(has(path_complaint("C1,2,3,4,5,6"), "expected M, found 'C'"));
  CHECK(has(path_complaint("M1,2L3,4"), "at byte 5: command 'L': expected C or S"));
  for (const char* const command :
       {"Z", "z", "H3", "v3", "Q1,2,3,4", "t1,2", "A1,1,0,0,0,3,3", "M3,4", "m3,4", "&x;", "\xFF"}) {
    INFO(command);
    CHECK(has(path_complaint(std::string("M1,2c1,1,2,2,3,3") + command), "expected C or S"));
  }
  CHECK(has(path_complaint("M1,2 3,4"), "straight line"));
  CHECK(has(path_complaint("M1"), "expected a number, found the end"));
  CHECK(has(path_complaint("M1,2c1,2,3,4,5"), "expected a number, found the end"));
  CHECK(has(path_complaint("M1,,2"), "at byte 3: expected a number"));
  for (const char* const number : {"nan", "inf", "1e999", "x", "+-1", "--1", "."}) {
    INFO(number);
    CHECK(has(path_complaint(std::string("M1,") + number), "expected a number"));
  }
  CHECK(has(path_complaint("M1,1e9"), "beyond 10000"));
  CHECK(has(path_complaint("M1,1" + repeated("c9999,0,-9999,0,0,9", 100)), "more than 20000 points"));
}

TEST_CASE("an outline has lines and curves of degree 2 and 3 and ends after Z", "[practice]") {
  const auto outline = [](const std::string& data) { return flattened_outline(data, 0.01); };
  const std::vector<Point> triangle{{0, 0}, {4, 0}, {4, 3}};
  CHECK(outline("M 0 0 L 4 0 L 4 3 Z") == triangle);
  CHECK(outline("m0,0l4,0 0,3z") == triangle);
  const Bezier<2> curve{{Point(0, 0), Point(20, 40), Point(60, 0)}};
  const std::vector<Point> curved = outline("M 0 0 Q 20 40 60 0 L 0 0 Z");
  for (int i = 0; i <= 100; ++i) REQUIRE(distance_to(curved, curve.point(i / 100.0)) <= 0.01);
  for (const Point& point : curved) CHECK(point.y() <= 20.0);
  CHECK(has(complaint_of([&] { outline("M0,0L4,0S1,1,2,2"); }), "command 'S': expected C, L, Q or Z"));
  CHECK(has(complaint_of([&] { outline("M0,0L4,0ZM1,1"); }), "expected the end after Z, found 'M1,1'"));
}

TEST_CASE("SVG other than a KanjiVG drawing is rejected with the place", "[practice]") {
  const std::string path = R"(<path d="M1,2c1,1,2,2,3,3"/>)";
  CHECK(complaint(svg(path)).empty());
  CHECK(has(complaint(""), "x.svg: line 1: not XML"));
  CHECK(has(complaint("\n\n<svg><g></svg>"), "x.svg: line 3: not XML"));
  CHECK(has(complaint(svg(path).substr(0, 100)), "not XML"));
  CHECK(has(complaint("<html/>"), "no <svg>"));
  CHECK(has(complaint("<svg viewBox=\"0 0 1024 1024\">" + path + "</svg>"), "viewBox '0 0 1024 1024'"));
  CHECK(has(complaint("<svg>" + path + "</svg>"), "viewBox ''"));
  CHECK(has(complaint(svg("")), "there is no stroke"));
  CHECK(has(complaint(svg(path + "<path/>")), "stroke 2: path data at byte 0"));
  CHECK(has(complaint(svg(path + R"(<path d="M1,2L3,4"/>)")), "stroke 2: path data at byte 5: command 'L'"));
  CHECK(has(complaint(svg("<g transform=\"scale(2)\">" + path + "</g>")), "transform"));
  CHECK(has(complaint(svg(repeated(path, 257))), "more than 256 strokes"));
  CHECK(has(complaint(svg(path + std::string(1 << 20, ' '))), "larger than 1 MB"));
  CHECK(has(complaint(svg("<path kvg:type=\"" + std::string(65, 'x') + "\" d=\"M1,2c1,1,2,2,3,3\"/>")), "kvg:type"));
  CHECK(has(complaint(svg("<path kvg:type=\"\xFF\" d=\"M1,2c1,1,2,2,3,3\"/>")), "stroke 1"));
}

TEST_CASE("entities declared in a document are not expanded, and deep nesting is harmless", "[practice]") {
  std::string entities = "<!DOCTYPE svg [<!ENTITY a0 \"1,2c1,1,2,2,3,3\">";
  for (int i = 1; i < 20; ++i) {
    const std::string before = "&a" + std::to_string(i - 1) + ";";
    entities += "<!ENTITY a" + std::to_string(i) + " \"" + repeated(before, 10) + "\">";
  }
  entities += "]>";
  CHECK(has(complaint(svg("<path d=\"M&a19;\"/>", entities)), "expected a number, found '&a19;'"));
  const std::string external = "<!DOCTYPE svg [<!ENTITY f SYSTEM \"file:///etc/passwd\">]>";
  CHECK(has(complaint(svg("<path d=\"&f;\"/>", external)), "'&'"));
  constexpr int depth = 100000;
  const std::string path = R"(<path d="M1,2c1,1,2,2,3,3"/>)";
  CHECK(parse_kanjivg(svg(repeated("<g>", depth) + path + repeated("</g>", depth)), "x.svg").strokes.size() == 1);
  CHECK(has(complaint(svg(repeated("<g>", depth))), "not XML"));
}

}  // namespace kanjivg_tests
