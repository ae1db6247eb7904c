#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../catch.hpp"
#include "../characters.hpp"
#include "pen_traces.hpp"

using namespace calligraphy;
using calligraphy_test::copy_of;

namespace {

/// A character of straight strokes.
Character of_lines(char32_t code, const std::vector<std::pair<Point, Point>>& lines) {
  std::vector<StrokeInput> strokes;
  for (const auto& [from, to] : lines) {
    const bool is_level = std::abs(to.y() - from.y()) < std::abs(to.x() - from.x());
    strokes.push_back({is_level ? 1 : 2, {from, to}});
  }
  return make_character(code, strokes);
}

/// 土 and 士: a cross on a base line; `upper` is the width of the cross [em].
Character cross_on_a_line(char32_t code, double upper) {
  const double lower = 1.2 - upper;
  return of_lines(code, {{Point(0.5 - upper / 2, 0.6), Point(0.5 + upper / 2, 0.6)},
                         {Point(0.5, 0.95), Point(0.5, 0.1)},
                         {Point(0.5 - lower / 2, 0.1), Point(0.5 + lower / 2, 0.1)}});
}

CharacterIndex index_of(const std::vector<Character>& characters) {
  return CharacterIndex(CharacterSet(CharacterList{{}, characters}));
}

std::vector<PenPath> moved(std::vector<PenPath> paths, const Eigen::Matrix2d& linear, const Point& offset) {
  for (PenPath& path : paths) {
    for (Point& point : path) point = linear * point + offset;
  }
  return paths;
}

/// What is told of a copy of one character where another was asked for, as "character 土".
std::string told(const Character& asked, const std::vector<PenPath>& paths, const CharacterIndex& index) {
  std::string text;
  for (const StrokeRemark& remark : match_strokes(asked, paths, {}, &index).remarks) {
    text += (text.empty() ? "" : ", ") + std::string(to_string(remark.kind));
    if (remark.other_character != 0) text += " " + encode_utf8(remark.other_character);
  }
  return text;
}

}  // namespace

TEST_CASE("a copy of any built-in character is recognised, wherever it is and of whatever size", "[judge]") {
  const CharacterSet set(built_in_characters());
  const CharacterIndex index(set);
  CHECK(index.size() == set.size());
  const Eigen::Matrix2d narrow = Point(0.2, 0.3).asDiagonal();
  for (const Character& character : built_in_characters().characters) {
    const std::vector<PenPath> copy = copy_of(character);
    const auto found = index.recognise(copy), elsewhere = index.recognise(moved(copy, narrow, {40.0, -3.0}));
    CAPTURE(encode_utf8(character.code));
    REQUIRE_FALSE(found.empty());
    CHECK(found.front().code == character.code);
    CHECK(found.front().distance < 1e-6);
    CHECK(std::is_sorted(found.begin(), found.end(),
                         [](const auto& one, const auto& other) { return one.distance < other.distance; }));
    REQUIRE(elsewhere.size() == found.size());
    CHECK(elsewhere.front().code == character.code);
  }
}

TEST_CASE("recognition gives at most as many characters as asked for, each once, in all forms of all layers",
          "[judge]") {
  const Character narrow = cross_on_a_line(U'土', 0.3), wide = cross_on_a_line(U'士', 0.9);
  Character other_form = wide;
  other_form.code = U'土';
  const std::vector<CharacterSet> layers = {CharacterSet(CharacterList{{}, {narrow}}),
                                            CharacterSet(CharacterList{{}, {other_form, wide}})};
  const CharacterIndex index(CharacterSet::layered(layers));
  CHECK(index.size() == 2);
  const auto found = index.recognise(copy_of(wide));
  REQUIRE(found.size() == 2);  // and not the narrow form again
  CHECK(found[0].distance < 1e-6);
  CHECK(found[1].distance < 1e-6);  // the form that the first layer hides
  CHECK(index.recognise(copy_of(wide), 1).size() == 1);
  CHECK(index.recognise(copy_of(wide), 0).empty());
  std::vector<PenPath> paths = copy_of(wide);
  paths.pop_back();
  CHECK(index.recognise(paths).empty());
  CHECK(index.recognise({}).empty());
  CHECK(CharacterIndex(CharacterSet()).recognise(paths).empty());
}

TEST_CASE("parts of characters and other codes of one are not recognised", "[judge]") {
  const Character cross = cross_on_a_line(U'土', 0.3);
  std::vector<Character> all = {cross};
  for (const char32_t code : {U'\u2E80', U'\u2F1F', U'\u31C0', U'\uF900', U'\U0002F800'}) {
    all.push_back(cross);
    all.back().code = code;
  }
  const auto found = index_of(all).recognise(copy_of(cross));
  REQUIRE(found.size() == 1);
  CHECK(found[0].code == U'土');
}

TEST_CASE("recognition refuses pen-downs that match_strokes() refuses", "[judge]") {
  const CharacterIndex index = index_of({cross_on_a_line(U'土', 0.3)});
  CHECK_THROWS_AS(index.recognise(std::vector<PenPath>{{}}), ValueError);
  CHECK_THROWS_AS(index.recognise(std::vector<PenPath>{{Point(NAN, 0.0)}}), ValueError);
}

TEST_CASE("another character of as many strokes is told, and nothing else", "[judge]") {
  const CharacterList& all = built_in_characters();
  const CharacterIndex index{CharacterSet(all)};
  int pairs = 0;
  for (const Character& written : all.characters) {
    const std::vector<PenPath> copy = copy_of(written);
    for (const Character& asked : all.characters) {
      if (asked.stroke_count() != written.stroke_count()) continue;
      CAPTURE(encode_utf8(asked.code), encode_utf8(written.code));
      // Where one crossing makes the other character, that is what is told.
      const auto is = [&](char32_t one, char32_t other) { return asked.code == one && written.code == other; };
      const bool crosses = is(U'刀', U'力') || is(U'乃', U'力'), does_not = is(U'力', U'刀') || is(U'力', U'乃');
      const std::string kind = crosses ? "crossing " : (does_not ? "no crossing " : "character ");
      const std::string expected = kind + encode_utf8(written.code);
      CHECK(told(asked, copy, index) == (asked.code == written.code ? "" : expected));
      ++pairs;
    }
  }
  CHECK(pairs > 300);
}

TEST_CASE("a character in another order or direction, turned or smaller, is not another one", "[judge]") {
  const CharacterList& all = built_in_characters();
  const CharacterIndex index{CharacterSet(all)};
  const Eigen::Matrix2d turned = 0.4 * Eigen::Rotation2Dd(0.3).toRotationMatrix();
  for (const Character& character : all.characters) {
    const std::vector<PenPath> copy = copy_of(character);
    CAPTURE(encode_utf8(character.code));
    for (std::size_t stroke = 0; stroke < copy.size(); ++stroke) {
      std::vector<PenPath> reversed = copy;
      std::reverse(reversed[stroke].begin(), reversed[stroke].end());
      CHECK_FALSE(told(character, reversed, index).starts_with("character"));
      if (stroke == 0) continue;
      std::vector<PenPath> swapped = copy;
      std::swap(swapped[0], swapped[stroke]);
      CHECK_FALSE(told(character, swapped, index).starts_with("character"));
    }
    if (copy.size() > 1) CHECK(told(character, moved(copy, turned, {0.2, 0.1}), index).empty());
  }
}

TEST_CASE("a lone slanted line is the nearest one by its angle, however narrow its box", "[judge]") {
  const Character one = of_lines(U'一', {{Point(0.1, 0.5), Point(0.9, 0.5)}});
  const Character dot = of_lines(U'丶', {{Point(0.4, 0.6), Point(0.6, 0.4)}});
  const CharacterIndex index = index_of({one, dot});
  const auto slanted = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return std::vector<PenPath>{{Point(0.2, 0.5), Point(0.2 + 0.5 * std::cos(angle), 0.5 - 0.5 * std::sin(angle))}};
  };
  CHECK(told(one, slanted(20.0), index).empty());
  CHECK(told(one, slanted(42.0), index) == "character 丶");
}

TEST_CASE("a character of fewer or more strokes is not told as another one", "[judge]") {
  const CharacterList& all = built_in_characters();
  const CharacterIndex index{CharacterSet(all)};
  const Character& three = *all.find(U'三');
  const Character& ten = *all.find(U'十');
  CHECK_FALSE(told(three, copy_of(ten), index).starts_with("character"));
  CHECK_FALSE(told(ten, copy_of(three), index).starts_with("character"));
}

TEST_CASE("where a form of fewer strokes is accepted as well, another character is told, and a mistake is none",
          "[judge]") {
  const std::vector<Character>& all = built_in_characters().characters;
  const CharacterIndex index{CharacterSet(built_in_characters())};
  int strangers = 0, told_right = 0, fitted_fewer = 0, mistakes = 0;
  for (const Character& asked : all) {
    if (strokes(asked).size() < 4) continue;
    std::vector<StrokeInput> inputs;
    for (const Stroke& stroke : strokes(asked)) inputs.push_back(input_of(stroke));
    inputs.pop_back();
    const std::vector<Character> forms = {asked, make_character(asked.code, inputs)};
    const auto other_of = [&](const std::vector<PenPath>& paths) {
      const MatchResult match = match_strokes(forms, paths, {}, &index);
      return match.count(StrokeRemarkKind::character) > 0 ? match.remarks[0].other_character : char32_t{};
    };
    for (const Character& written : all) {
      if (written.code == asked.code || strokes(written).size() != strokes(asked).size()) continue;
      CAPTURE(encode_utf8(asked.code), encode_utf8(written.code));
      ++strangers;
      fitted_fewer += match_strokes(forms, copy_of(written)).accepted;
      const char32_t other = other_of(copy_of(written));
      told_right += other == written.code ? 1 : 0;
      CHECK((other == written.code || other == char32_t{}));
    }
    // A stroke left out, of which there are then as many as in the other form.
    const std::vector<PenPath> right = copy_of(asked);
    for (std::size_t stroke = 0; stroke < right.size(); ++stroke) {
      std::vector<PenPath> paths = right;
      paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(stroke));
      CAPTURE(encode_utf8(asked.code), stroke);
      ++mistakes;
      CHECK(other_of(paths) == char32_t{});
    }
  }
  CHECK(strangers > 300);
  CHECK(told_right >= 0.98 * strangers);
  CHECK(fitted_fewer > 100);
  CHECK(mistakes > 200);
}

TEST_CASE("twins are told by their proportions, and of lookalikes there is a note", "[judge]") {
  const Character earth = cross_on_a_line(U'土', 0.45), scholar = cross_on_a_line(U'士', 0.75);
  const CharacterIndex twins = index_of({earth, scholar});
  CHECK(told(earth, copy_of(scholar), twins) == "proportion 士");
  CHECK(told(scholar, copy_of(earth), twins) == "proportion 土");
  CHECK(told(scholar, copy_of(scholar), twins).empty());

  const Character nearly = cross_on_a_line(U'士', 0.5);
  const CharacterIndex lookalikes = index_of({earth, nearly});
  CHECK(told(earth, copy_of(nearly), lookalikes) == "lookalike 士");
  const std::vector<PenPath> turned =
      moved(copy_of(scholar), Eigen::Rotation2Dd(0.35).toRotationMatrix(), Point(0.3, -0.1));
  CHECK(told(earth, turned, twins) == "proportion 士");
  CHECK(told(scholar, turned, twins).empty());

  const Character all_but_same = cross_on_a_line(U'士', 0.455);
  CHECK(told(earth, copy_of(all_but_same), index_of({earth, all_but_same})).empty());
  Character same = earth;
  same.code = U'士';
  CHECK(told(earth, copy_of(earth), index_of({earth, same})).empty());
}
