// stroke_warnings finds faults that validate() accepts, and does not warn about good characters.
#include <string>
#include <vector>

#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/stroke_warnings.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../catch.hpp"

namespace doubtful_strokes_tests {

using namespace calligraphy;

namespace {

/// "stroke kind" of each warning, in order.
std::string warnings_of(const std::vector<StrokeInput>& strokes, int degree = 3) {
  std::string text;
  for (const StrokeWarning& warning : stroke_warnings(make_character(U'永', strokes, degree))) {
    text += (text.empty() ? "" : ", ") + std::to_string(warning.stroke) + " " + to_string(warning.kind);
  }
  return text;
}

const StrokeInput heng{1, {{0.1, 0.5}, {0.9, 0.52}}};
const StrokeInput shu{2, {{0.5, 0.9}, {0.5, 0.1}}};

}  // namespace

TEST_CASE("strokes as taught in schools cause no warning, with cubics or quartics", "[model]") {
  CHECK(warnings_of({heng, shu}).empty());
  for (const Character& character : built_in_characters().characters) {
    INFO(encode_utf8(character.code));
    CHECK(stroke_warnings(character).empty());
    CHECK(stroke_warnings(with_quartic_curves(character)).empty());
  }
}

TEST_CASE("a stroke with the shape of another is found", "[model]") {
  CHECK(warnings_of({{2, {{0.1, 0.5}, {0.4, 0.1}}}, heng}) == "1 type");         // a pie recorded as shu
  CHECK(warnings_of({heng, {10, {{0.5, 0.9}, {0.8, 0.1}}}}) == "2 direction");   // a dian recorded as ti
  CHECK(warnings_of({{16, {{0.5, 0.9}, {0.5, 0.1}, {0.4, 0.2}}}}) == "1 type");  // a shu gou recorded as heng zhe
}

TEST_CASE("a stroke written from its end is found, with one warning", "[model]") {
  CHECK(warnings_of({{1, {{0.9, 0.52}, {0.1, 0.5}}}, shu}) == "1 direction");
  CHECK(warnings_of({heng, {2, {{0.5, 0.1}, {0.5, 0.9}}}}) == "2 direction");
  CHECK(warnings_of({{4, {{0.2, 0.12}, {0.46, 0.31}, {0.62, 0.58}, {0.68, 0.88}}}}) == "1 direction");
}

TEST_CASE("a stroke that overlaps another is found, one that only touches or crosses is not", "[model]") {
  CHECK(warnings_of({heng, heng}) == "2 overlap");
  CHECK(warnings_of({heng, shu, {1, {{0.3, 0.503}, {0.7, 0.508}}}}) == "3 overlap");
  CHECK(warnings_of({{1, {{0.3, 0.503}, {0.7, 0.508}}}, shu, heng}) == "3 overlap");
  CHECK(warnings_of({heng, {1, {{0.1, 0.53}, {0.9, 0.55}}}}).empty());
}

TEST_CASE("a stroke outside the em square is found by its curve, not by its handles", "[model]") {
  CHECK(warnings_of({{1, {{0.1, 0.5}, {1.02, 0.52}}}}) == "1 outside");
  CHECK(warnings_of({{1, {{-0.005, 0.5}, {0.9, 0.52}}}}).empty());
  CHECK(warnings_of({{4, {{0.68, 0.95}, {0.66, 1.5}, {0.46, 0.31}, {0.2, 0.12}}}}).find("outside") !=
        std::string::npos);
  CHECK(warnings_of({{4, {{0.68, 0.9}, {0.67, 1.02}, {0.46, 0.31}, {0.2, 0.12}}}}).find("outside") ==
        std::string::npos);
}

TEST_CASE("a dot that is a point causes no warning", "[model]") {
  CHECK(warnings_of({{8, {{0.5, 0.5}, {0.5, 0.5}}}, heng}).find("direction") == std::string::npos);
}

}  // namespace doubtful_strokes_tests
