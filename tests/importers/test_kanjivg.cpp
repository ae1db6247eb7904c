// parse_kanjivg: an SVG becomes centre lines with labels, and everything else is rejected.
#include <string>

#include <calligraphy/base/error.hpp>

#include "../catch.hpp"
#include "importers/read/kanjivg.hpp"

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

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
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
  CHECK(has(complaint(svg(path + R"(<path d="M1,2B3,4"/>)")), "stroke 2: path data at byte 4: command 'B'"));
  CHECK(has(complaint(svg(path + R"(<path d="M1,2L3,4M5,6L7,8"/>)")), "stroke 2: path data draws 2 lines"));
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
