// Claims about doubtful_strokes: faults that validate() lets pass are found, good characters are left alone.
#include <string>
#include <vector>

#include <calligraphy/base/text.hpp>
#include <calligraphy/importers/doubtful_strokes.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../catch.hpp"

namespace doubtful_strokes_tests {

using namespace calligraphy;

namespace {

/// "stroke kind" of each doubt, one after the other.
std::string doubts_of(const std::vector<StrokeInput>& strokes, int degree = 3) {
  std::string text;
  for (const Doubt& doubt : doubtful_strokes(make_character(U'永', strokes, degree))) {
    text += (text.empty() ? "" : ", ") + std::to_string(doubt.stroke) + " " + name_of(doubt.kind);
  }
  return text;
}

const StrokeInput heng{1, {{0.1, 0.5}, {0.9, 0.52}}};
const StrokeInput shu{2, {{0.5, 0.9}, {0.5, 0.1}}};

}  // namespace

TEST_CASE("strokes as they are taught raise no doubt, nor does one more degree of their curves", "[model]") {
  CHECK(doubts_of({heng, shu}).empty());
  for (const Character& character : built_in_characters().characters) {
    INFO(encode_utf8(character.code));
    CHECK(doubtful_strokes(character).empty());
    CHECK(doubtful_strokes(with_quartic_curves(character)).empty());
  }
}

TEST_CASE("a stroke with the shape of another is found", "[model]") {
  CHECK(doubts_of({{2, {{0.1, 0.5}, {0.4, 0.1}}}, heng}) == "1 type");         // a pie called shu
  CHECK(doubts_of({heng, {10, {{0.5, 0.9}, {0.8, 0.1}}}}) == "2 direction");   // a dian called ti
  CHECK(doubts_of({{16, {{0.5, 0.9}, {0.5, 0.1}, {0.4, 0.2}}}}) == "1 type");  // a shu gou called heng zhe
}

TEST_CASE("a stroke written from its end is found, once", "[model]") {
  CHECK(doubts_of({{1, {{0.9, 0.52}, {0.1, 0.5}}}, shu}) == "1 direction");
  CHECK(doubts_of({heng, {2, {{0.5, 0.1}, {0.5, 0.9}}}}) == "2 direction");
  CHECK(doubts_of({{4, {{0.2, 0.12}, {0.46, 0.31}, {0.62, 0.58}, {0.68, 0.88}}}}) == "1 direction");
}

TEST_CASE("a stroke on another is found, one that only touches or crosses is not", "[model]") {
  CHECK(doubts_of({heng, heng}) == "2 overlap");
  CHECK(doubts_of({heng, shu, {1, {{0.3, 0.503}, {0.7, 0.508}}}}) == "3 overlap");
  CHECK(doubts_of({{1, {{0.3, 0.503}, {0.7, 0.508}}}, shu, heng}) == "3 overlap");
  CHECK(doubts_of({heng, {1, {{0.1, 0.53}, {0.9, 0.55}}}}).empty());
}

TEST_CASE("a stroke out of the em square is found by its curve, not by its handles", "[model]") {
  CHECK(doubts_of({{1, {{0.1, 0.5}, {1.02, 0.52}}}}) == "1 outside");
  CHECK(doubts_of({{1, {{-0.005, 0.5}, {0.9, 0.52}}}}).empty());
  CHECK(doubts_of({{4, {{0.68, 0.95}, {0.66, 1.5}, {0.46, 0.31}, {0.2, 0.12}}}}).find("outside") != std::string::npos);
  CHECK(doubts_of({{4, {{0.68, 0.9}, {0.67, 1.02}, {0.46, 0.31}, {0.2, 0.12}}}}).find("outside") == std::string::npos);
}

TEST_CASE("a dot that is a point is doubted for nothing", "[model]") {
  CHECK(doubts_of({{8, {{0.5, 0.5}, {0.5, 0.5}}}, heng}).find("direction") == std::string::npos);
}

}  // namespace doubtful_strokes_tests
