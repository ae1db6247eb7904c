// Files of the npm package hanzi-writer-data become strokes and, fitted, characters.
#include <filesystem>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/model/character.hpp>

#include "../catch.hpp"
#include "../package_data.hpp"
#include "importers/fit/brush_stroke_fit.hpp"
#include "importers/read/hanzi_writer.hpp"

namespace hanzi_writer_tests {

using namespace calligraphy;
using recognition::Outline;

namespace {

/// The message of the FormatError for this text; empty if there is none.
std::string complaint(const std::string& text) {
  try {
    parse_hanzi_writer(text, "永.json");
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

Character fitted(char32_t code, const std::string& json) {
  std::vector<StrokeInput> strokes;
  for (const SourceStroke& stroke : parse_hanzi_writer(json, encode_utf8(code) + ".json")) {
    strokes.push_back(recognition::fit_brush_stroke(stroke.path, Outline(std::span(stroke.outline)), {}).stroke);
  }
  return make_character(code, strokes);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

}  // namespace

TEST_CASE("a median in units of 1/1024 em with the baseline at -124 is mapped to the unit square", "[practice]") {
  const Character character = fitted(U'一', R"({"medians":[[[0,-124],[1024,-124]],[[512,900],[512,-124]]]})");
  CHECK(character.code == U'一');
  REQUIRE(character.sequence.stroke_ids == std::vector<int>{1, 2});
  const auto& points = character.structure.control_points;
  CHECK((points[0] - Point(0.0, 0.0)).norm() < 1e-6);
  CHECK((points[1] - Point(1.0, 0.0)).norm() < 1e-6);
  CHECK((points[2] - Point(0.5, 1.0)).norm() < 1e-6);
  CHECK((points[3] - Point(0.5, 0.0)).norm() < 1e-6);
  CHECK(validate(character).empty());
  for (const double factor : character.physics.attraction_factors) CHECK(factor == 1.0);
}

TEST_CASE("outlines are in the frame of the medians, and a file may have none", "[practice]") {
  const auto drawn = parse_hanzi_writer(
      R"({"strokes":["M 0 -124 L 1024 -124 L 1024 900 Z"],"medians":[[[100,400],[900,400]]]})", "x.json");
  REQUIRE(drawn.size() == 1);
  CHECK(drawn[0].outline == std::vector<std::vector<Point>>{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}});
  CHECK(drawn[0].path.size() == 2);
  CHECK(parse_hanzi_writer(R"({"medians":[[[100,400],[900,400]]]})", "x.json")[0].outline.empty());
}

TEST_CASE("malformed files are rejected with the file and the place", "[practice]") {
  struct Case {
    std::string text;
    std::string place;
  };
  const std::vector<Case> cases = {
      {"", "not JSON"},
      {"{", "not JSON"},
      {"\xff\xfe", "UTF-8"},
      {R"({"medians":[[[1,2],[3,4]]]} x)", "not JSON"},
      {R"({"medians":[[[1,2],[1e999,4]]]})", "not JSON"},
      {R"({"medians":[[[1,2],[NaN,4]]]})", "not JSON"},
      {"[]", "is an array: expected one character"},
      {"{}", "medians: missing"},
      {R"({"medians":null})", "medians: expected a non-empty array"},
      {R"({"medians":{}})", "medians: expected a non-empty array"},
      {R"({"medians":[]})", "medians: expected a non-empty array"},
      {R"({"medians":[[[1,2],[300,4]],[]]})", "medians[1]: expected a non-empty array of points"},
      {R"({"medians":[7]})", "medians[0]: expected a non-empty array of points"},
      {R"({"medians":[{"0":[1,2]}]})", "medians[0]: expected a non-empty array of points"},
      {R"({"medians":[[[1,2],[3]]]})", "medians[0][1]: expected two finite numbers"},
      {R"({"medians":[[[1,2],[3,4,5]]]})", "medians[0][1]: expected two finite numbers"},
      {R"({"medians":[[[1,2],[3,"4"]]]})", "medians[0][1]: expected two finite numbers"},
      {R"({"medians":[[[1,2],[3,true]]]})", "medians[0][1]: expected two finite numbers"},
      {R"({"medians":[[[1,2],null]]})", "medians[0][1]: expected two finite numbers"},
      {R"({"medians":[[[1,2],[3,1e300]]]})", "medians[0][1]: (3, 1e+300) is more than 8 em"},
      {R"({"medians":[[[-18446744073709551615,2],[3,4]]]})", "medians[0][0]"},
      {R"({"medians":[[[1,2],[3,4]],[[500,400]]]})", "medians[1]: has no length"},
      {R"({"medians":[[[5,4],[5,4],[5,4]]]})", "medians[0]: has no length"},
      {R"({"medians":[[[1,2],[3,4]]],"strokes":[]})", "strokes: expected an array of 1 outlines, as many as medians"},
      {R"({"medians":[[[1,2],[3,4]]],"strokes":[7]})", "strokes[0]: expected the path data"},
      {R"({"medians":[[[1,2],[3,4]]],"strokes":["M 1 2 B 3"]})", "strokes[0]: path data at byte 6: command 'B'"},
      {R"({"medians":[[[1,2],[3,4]]],"strokes":["M 1 2 H 30 V 40"]})", "strokes[0]: path data is not closed"},
      {R"({"medians":[[[1,2],[3,4]]],"strokes":["M 1 2 H 300 Z"]})", "strokes[0]: the outline has no area"},
      {R"({"medians":[)" + repeated("[[1,2],[300,4]],", 300) + "[[1,2],[300,4]]]}", "medians: more than 256 strokes"},
      {R"({"medians":[[)" + repeated("[1,2],", 10001) + "[1,2]]]}", "medians[0]: more than 10000 points"},
  };
  for (const Case& hostile : cases) {
    const std::string said = complaint(hostile.text);
    INFO(hostile.text.substr(0, 80) << " -> " << said);
    CHECK(has(said, "永.json: "));
    CHECK(has(said, hostile.place));
  }
}

TEST_CASE("a hundred thousand nested arrays are rejected without a crash", "[practice]") {
  CHECK(has(complaint(repeated("[", 100000)), "永.json: not JSON"));
  CHECK(has(complaint(repeated("[", 100000) + repeated("]", 100000)), "永.json: is an array"));
  CHECK(has(complaint(R"({"medians":[[)" + repeated("[", 100000) + repeated("]", 100000) + "]]}"),
            "永.json: medians[0][0]: expected two finite numbers"));
}

TEST_CASE("a file of more than one megabyte is rejected", "[practice]") {
  const std::string valid = R"({"medians":[[[100,200],[600,200]]]})";
  CHECK(complaint(valid).empty());
  CHECK(complaint(std::string(500000, ' ') + valid).empty());
  const std::string too_large = complaint(std::string(1100000, ' ') + valid);
  CHECK(too_large == "永.json: larger than 1 MB");
}

namespace {

/// The fitter takes a bent dian for a chang dian, and a bent short pie for a pie: a line cannot follow them within 1 %
/// of the em. Schools teach each pair as one stroke.
std::vector<int> without_twins(std::vector<int> ids) {
  std::replace(ids.begin(), ids.end(), 38, 8);
  std::replace(ids.begin(), ids.end(), 5, 4);
  return ids;
}

}  // namespace

TEST_CASE("well-known characters of the package have the strokes taught in schools", "[practice]") {
  const std::filesystem::path directory = package_data("CALLIGRAPHY_HANZI_WRITER_DATA");
  if (directory.empty()) return;
  struct Known {
    char32_t code;
    std::vector<int> ids;
  };
  const std::vector<Known> known = {
      {U'一', {1}},
      {U'十', {1, 2}},
      {U'人', {4, 6}},
      {U'大', {1, 4, 6}},
      {U'永', {8, 18, 17, 4, 6}},
      {U'九', {4, 20}},
      {U'几', {3, 20}},
      {U'北', {2, 1, 10, 4, 31}},
      {U'马', {16, 35, 1}},
      {U'月', {3, 18, 1, 1}},
      {U'心', {9, 15, 8, 8}},
      {U'口', {2, 16, 1}},
      {U'女', {37, 4, 1}},
      {U'又', {17, 6}},
      {U'乙', {22}},
      {U'水', {12, 17, 4, 6}},
      {U'计', {8, 19, 1, 2}},
      {U'及', {4, 26, 6}},
      {U'乃', {27, 4}},
      {U'队', {28, 2, 4, 6}},
      {U'我', {5, 1, 12, 10, 14, 4, 8}},
      {U'不', {1, 4, 2, 38}},
      {U'凸', {2, 1, 2, 25, 1}},
      {U'凹', {2, 24, 2, 16, 1}},
      {U'之', {8, 17, 7}},
  };
  for (const Known& character : known) {
    const std::string name = encode_utf8(character.code);
    INFO(name);
    const Character found = fitted(character.code, read_file(directory / (name + ".json"), 1 << 20));
    CHECK(without_twins(found.sequence.stroke_ids) == without_twins(character.ids));
  }
}

}  // namespace hanzi_writer_tests
