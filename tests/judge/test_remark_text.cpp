#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/remark_text.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/character_set.hpp>

#include "../catch.hpp"
#include "../characters.hpp"
#include "../pen_path.hpp"
#include "pen_traces.hpp"

using namespace calligraphy;
using calligraphy_test::copy_of;
using calligraphy_test::typical_character;
using Kind = StrokeRemarkKind;
using Said = std::pair<std::string, std::string>;

namespace {

Character built_in(std::string_view text) { return calligraphy_test::characters(text).front(); }

PenPath backwards(PenPath path) {
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<PenPath> in_order(const Character& character, const std::vector<std::size_t>& order) {
  const std::vector<PenPath> paths = copy_of(character);
  std::vector<PenPath> drawn;
  for (const std::size_t stroke : order) drawn.push_back(paths[stroke]);
  return drawn;
}

Said in_both(const StrokeRemark& remark, const Character& character) {
  return {remark_text(remark, character), remark_text(remark, character, Language("zh"))};
}

/// What the only remark says, which is of this kind.
Said said(Kind kind, const Character& character, const std::vector<PenPath>& paths,
          const CharacterIndex* others = nullptr) {
  const MatchResult match = match_strokes(character, paths, {}, others);
  REQUIRE(match.remarks.size() == 1);
  CHECK(match.remarks[0].kind == kind);
  return in_both(match.remarks[0], character);
}

/// What a remark would say, of a pen-down like this.
Said said(StrokeRemark remark, const Character& character, const DrawnStroke& drawn = {.length = 1.0}) {
  remark.length = drawn.length;
  remark.direction = drawn.direction;
  return in_both(remark, character);
}

/// A cross on a base line, 土 or 士; `upper` is the width of the cross [em].
Character cross_above_line(char32_t code, double upper) {
  const double half = 0.5 * upper, base = 0.6 - half;
  const std::vector<StrokeInput> strokes = {{1, {{0.5 - half, 0.6}, {0.5 + half, 0.6}}},
                                            {2, {{0.5, 0.95}, {0.5, 0.1}}},
                                            {1, {{0.5 - base, 0.1}, {0.5 + base, 0.1}}}};
  return make_character(code, strokes);
}

std::size_t length_in_characters(const std::string& text) { return decode_utf8(text).size(); }

}  // namespace

TEST_CASE("of strokes out of order it is said which to write first", "[judge]") {
  const Character ten = built_in("十"), three = built_in("三"), eternal = built_in("永");
  CHECK(said(Kind::order, ten, in_order(ten, {1, 0})) ==
        Said("Stroke 2 (shù) came too early: write stroke 1 (héng) first.", "第2笔（竖）写早了，先写第1笔（横）。"));
  CHECK(said(Kind::order, three, in_order(three, {1, 2, 0})) ==
        Said("Stroke 1 (héng) came too late: write it first.", "第1笔（横）写晚了，要最先写。"));
  CHECK(said(Kind::order, eternal, in_order(eternal, {0, 2, 3, 4, 1})) ==
        Said("Stroke 2 (héngzhégōu) came too late: write it straight after stroke 1.",
             "第2笔（横折钩）写晚了，要紧接着第1笔写。"));
  CHECK(said(Kind::order, eternal, in_order(eternal, {2, 3, 4, 0, 1})) ==
        Said("Strokes 1 (diǎn) and 2 (héngzhégōu) came too late: write them first.",
             "第1笔（点）和第2笔（横折钩）写晚了，要最先写。"));
  CHECK(said({.kind = Kind::order, .stroke = 2, .stroke_count = 3, .other_stroke = 0}, eternal) ==
        Said("Strokes 3 (héngpiě) to 5 (nà) came too early: write stroke 1 (diǎn) first.",
             "第3笔（横撇）到第5笔（捺）写早了，先写第1笔（点）。"));
  CHECK(said(Kind::order, eternal, in_order(eternal, {3, 1, 2, 0, 4})) ==
        Said("Strokes 1 (diǎn) and 4 (piě) changed places: write stroke 1 first.",
             "第1笔（点）和第4笔（撇）先后颠倒了，先写第1笔。"));
  CHECK(said(Kind::order, three, in_order(three, {2, 1, 0})) ==
        Said("Strokes 1 to 3 were written from the last to the first: begin with stroke 1 (héng).",
             "第1笔到第3笔的笔顺全反了，要从第1笔（横）写起。"));
}

TEST_CASE("of a stroke written backwards it is said where to start, in eight directions", "[judge]") {
  const std::vector<Said> starts = {{"right", "右边"},      {"top right", "右上方"},   {"top", "上边"},
                                    {"top left", "左上方"}, {"left", "左边"},          {"bottom left", "左下方"},
                                    {"bottom", "下边"},     {"bottom right", "右下方"}};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    for (const double beside : {-20.0, 0.0, 20.0}) {
      const double angle = (45.0 * static_cast<double>(i) + beside) * std::numbers::pi / 180.0;
      const Point middle(0.5, 0.5), arm(0.4 * std::cos(angle), 0.4 * std::sin(angle));
      const StrokeInput stroke{1, {middle + arm, middle - arm}};
      const Character line = make_character(U'一', {&stroke, 1});
      CAPTURE(i, beside);
      CHECK(said(Kind::direction, line, {backwards(copy_of(line)[0])}) ==
            Said("Stroke 1 (héng) was written backwards: start at the " + starts[i].first + ".",
                 "第1笔（横）的方向反了，从" + starts[i].second + "起笔。"));
    }
  }
  const Character eternal = built_in("永");
  CHECK(said({.kind = Kind::direction, .path = 0, .stroke = 3, .stroke_count = 2}, eternal) ==
        Said("Strokes 4 (piě) and 5 (nà) were written backwards: begin with stroke 4, at the top right.",
             "第4笔（撇）和第5笔（捺）的方向反了，先写第4笔，从右上方起笔。"));
  // A bent stroke: where in its box it starts, whichever way it goes from there.
  const StrokeInput folded{1, {{0.5, 0.9}, {-0.2, 0.2}, {0.2, 0.1}, {0.8, 0.2}}, {}, {"C"}};
  const Character fold = make_character(U'厶', {&folded, 1});
  CHECK(said({.kind = Kind::direction, .path = 0, .stroke = 0, .stroke_count = 1}, fold)
            .first.ends_with("start at the top."));
  // A stroke that starts in its own middle, and one that ends where it starts.
  const StrokeInput inner{1, {{0.5, 0.5}, {1.4, 1.7}, {-0.4, 1.0}, {0.5, 0.1}}, {}, {"C"}};
  CHECK(said({.kind = Kind::direction, .path = 0, .stroke = 0, .stroke_count = 1}, make_character(U'回', {&inner, 1}))
            .first.ends_with("start where the model starts."));
  const StrokeInput round{1, {{0.5, 0.9}, {-0.3, 0.0}, {1.3, 0.0}, {0.51, 0.9}}, {}, {"C"}};
  const Character ring = make_character(U'〇', {&round, 1});
  CHECK(said({.kind = Kind::direction, .path = 0, .stroke = 0, .stroke_count = 1}, ring) ==
        Said("Stroke 1 (héng) was written backwards: start where the model starts.",
             "第1笔（横）的方向反了，请照着范字起笔。"));
}

TEST_CASE("of a stroke of another shape it is said from where to where it goes, unless it bends", "[judge]") {
  const Character ten = built_in("十"), eternal = built_in("永");
  const StrokeRemark remark{.kind = Kind::shape, .path = 0, .stroke = 3, .stroke_count = 1};
  CHECK(said(remark, eternal) ==
        Said("Stroke 4 (piě) does not look right: draw it from the top right to the bottom left.",
             "第4笔（撇）的形状不太对，从右上方写到左下方。"));
  const StrokeRemark hooked{.kind = Kind::shape, .path = 0, .stroke = 1, .stroke_count = 1};
  CHECK(said(hooked, eternal) == Said("Stroke 2 (héngzhégōu) does not look right: follow the model.",
                                      "第2笔（横折钩）的形状不太对，请照着范字写。"));
  const StrokeRemark several{.kind = Kind::shape, .path = 0, .stroke = 0, .stroke_count = 2};
  CHECK(said(several, ten) == Said("Strokes 1 (héng) and 2 (shù) do not look right: follow the model.",
                                   "第1笔（横）和第2笔（竖）的形状不太对，请照着范字写。"));

  std::vector<PenPath> drawn = copy_of(ten);
  drawn[1] = points_along(drawn[1], 0.2 * path_length(drawn[1]), 12);
  CHECK(said(Kind::shape, ten, drawn) ==
        Said("Only a part of stroke 2 (shù) is there: draw all of it, from the top to the bottom.",
             "第2笔（竖）只写了一部分，要写完整，从上边写到下边。"));
  CHECK(said(hooked, eternal, {.length = 0.3}) == Said("Only a part of stroke 2 (héngzhégōu) is there: draw all of it.",
                                                       "第2笔（横折钩）只写了一部分，要写完整。"));
}

TEST_CASE("of joined and broken strokes it is said when to lift the pen", "[judge]") {
  const Character eternal = built_in("永"), ten = built_in("十");
  std::vector<PenPath> drawn = copy_of(eternal);
  calligraphy_test::draw_line(drawn[3], drawn[4].front(), 0.01);
  drawn[3].insert(drawn[3].end(), drawn[4].begin(), drawn[4].end());
  drawn.pop_back();
  CHECK(said(Kind::joined, eternal, drawn) ==
        Said("Strokes 4 (piě) and 5 (nà) are joined, as in quick writing: lift the pen between them.",
             "第4笔（撇）和第5笔（捺）连写了，笔画之间要提笔。"));
  drawn = copy_of(ten);
  const auto middle = static_cast<std::ptrdiff_t>(drawn[1].size() / 2);
  drawn.emplace_back(drawn[1].begin() + middle, drawn[1].end());
  drawn[1].resize(static_cast<std::size_t>(middle));
  CHECK(said(Kind::broken, ten, drawn) ==
        Said("Stroke 2 (shù) is in two pieces: draw it in one go.", "第2笔（竖）断成了两段，要一笔写完。"));
  CHECK(said({.kind = Kind::broken, .path = 1, .path_count = 3, .stroke = 1, .stroke_count = 1}, ten) ==
        Said("Stroke 2 (shù) is in three pieces: draw it in one go.", "第2笔（竖）断成了三段，要一笔写完。"));
}

TEST_CASE("of a missing stroke it is said where it belongs", "[judge]") {
  const std::vector<Said> places = {
      {"at the top left", "左上方"},    {"at the top", "上边"},    {"at the top right", "右上方"},
      {"at the left", "左边"},          {"in the middle", "中间"}, {"at the right", "右边"},
      {"at the bottom left", "左下方"}, {"at the bottom", "下边"}, {"at the bottom right", "右下方"}};
  std::vector<StrokeInput> strokes;
  for (int i = 0; i < 9; ++i) {
    const Point middle(0.4 + 0.2 * (i % 3), 0.9 - 0.2 * (i / 3));
    strokes.push_back({1, {middle - Point(0.08, 0.0), middle + Point(0.08, 0.0)}});
  }
  const Character grid = make_character(U'井', strokes);
  const MatchResult match = match_strokes(grid, std::vector<PenPath>());
  REQUIRE(match.remarks.size() == places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    CHECK(in_both(match.remarks[i], match.character) ==
          Said("Stroke " + number + " (héng) is missing: it belongs " + places[i].first + ".",
               "缺少第" + number + "笔（横），它应该在" + places[i].second + "。"));
  }
  const Character three = built_in("三");
  CHECK(said(Kind::missing, three, in_order(three, {0, 1})) ==
        Said("Stroke 3 (héng) is missing: it belongs at the bottom.", "缺少第3笔（横），它应该在下边。"));
  const std::vector<StrokeInput> upright = {{2, {{0.4, 0.8}, {0.4, 0.3}}}, {2, {{0.6, 0.9}, {0.6, 0.1}}}};
  const Character knife = make_character(U'刂', upright);
  CHECK(said(Kind::missing, knife, {copy_of(knife)[1]}) ==
        Said("Stroke 1 (shù) is missing: it belongs at the left.", "缺少第1笔（竖），它应该在左边。"));
  const StrokeInput level{1, {{0.1, 0.5}, {0.9, 0.5}}};
  const MatchResult one = match_strokes(make_character(U'一', {&level, 1}), std::vector<PenPath>());
  REQUIRE(one.remarks.size() == 1);
  CHECK(remark_text(one.remarks[0], one.character) == "Stroke 1 (héng) is missing: it belongs in the middle.");
}

TEST_CASE("of a line too many it is said by its number to leave it out, or how to write it", "[judge]") {
  const Character ten = built_in("十"), eternal = built_in("永");
  std::vector<PenPath> drawn = copy_of(ten);
  drawn.push_back(drawn[0]);
  CHECK(said(Kind::extra, ten, drawn) ==
        Said("Your 1st and 3rd lines are both stroke 1 (héng): write it only once, in its turn.",
             "你写的第1笔和第3笔都是第1笔（横），按笔顺写一次就够了。"));
  drawn.pop_back();
  drawn.insert(drawn.begin(), backwards(drawn[0]));
  CHECK(said(Kind::extra, ten, drawn) == Said("Your 1st line is stroke 1 (héng) backwards: start at the left.",
                                              "你写的第1笔是第1笔（横），但方向反了，从左边起笔。"));
  CHECK(said({.kind = Kind::extra, .path = 2, .path_count = 1, .other_path = 0, .other_stroke = 0}, ten,
             {.direction = WritingDirection::backwards}) ==
        Said("Your 3rd line is stroke 1 (héng) backwards: start at the left.",
             "你写的第3笔是第1笔（横），但方向反了，从左边起笔。"));
  CHECK(said(Kind::extra, eternal, in_order(eternal, {3, 0, 1, 2, 3, 4})) ==
        Said("Your 1st and 5th lines are both stroke 4 (piě): write it only once, in its turn.",
             "你写的第1笔和第5笔都是第4笔（撇），按笔顺写一次就够了。"));
  CHECK(said({.kind = Kind::extra, .path = 5, .path_count = 1, .other_stroke = 4}, eternal) ==
        Said("Your 6th line is not quite stroke 5 (nà): follow the model.",
             "你写的第6笔不太像第5笔（捺），请照着范字写。"));
  const std::vector<std::pair<int, std::string>> ordinals = {
      {1, "1st"},   {2, "2nd"},   {3, "3rd"},   {4, "4th"},     {10, "10th"},   {11, "11th"},   {12, "12th"},
      {13, "13th"}, {21, "21st"}, {22, "22nd"}, {101, "101st"}, {111, "111th"}, {112, "112th"}, {1000, "1000th"}};
  for (const auto& [number, ordinal] : ordinals) {
    CHECK(said({.kind = Kind::extra, .path = number - 1, .path_count = 1}, ten) ==
          Said("Your " + ordinal + " line is one too many: leave it out.",
               "你写的第" + std::to_string(number) + "笔是多余的，不用写。"));
  }
}

TEST_CASE("of another character it is said which it is", "[judge]") {
  const Character earth = cross_above_line(U'土', 0.45), scholar = cross_above_line(U'士', 0.75);
  const CharacterIndex twins(CharacterSet(CharacterList{{}, {earth, scholar}}));
  CHECK(said(Kind::proportion, scholar, copy_of(earth), &twins) ==
        Said("Stroke 1 (héng) should be longer than stroke 3 (héng): here it becomes 土.",
             "第1笔（横）应该比第3笔（横）长，不然就成了“土”。"));
  const Character two = built_in("二"), ten = built_in("十");
  const CharacterIndex both(CharacterSet(CharacterList{{}, {two, ten}}));
  CHECK(said(Kind::character, two, copy_of(ten), &both) ==
        Said("This looks like 十, not 二: have another look at the model.", "这像“十”，不像“二”，再看看范字。"));
  const Character nearly = cross_above_line(U'士', 0.5);
  const CharacterIndex lookalikes(CharacterSet(CharacterList{{}, {earth, nearly}}));
  CHECK(said(Kind::lookalike, earth, copy_of(nearly), &lookalikes) ==
        Said("This could be read as 士: mind how 土 differs.", "这也像“士”，注意“土”和它的区别。"));
}

TEST_CASE("whatever is wrong is said in short sentences, in both languages", "[judge]") {
  std::map<Kind, int> seen;
  const auto check = [&seen](const Character& character, const std::vector<PenPath>& drawn) {
    for (const StrokeRemark& remark : match_strokes(character, drawn, JudgeTolerances::strict()).remarks) {
      ++seen[remark.kind];
      const auto [english, chinese] = in_both(remark, character);
      CAPTURE(encode_utf8(character.code), english, chinese);
      const bool is_capital = 'A' <= english.front() && english.front() <= 'Z';
      const bool is_sentence =
          (is_capital || english.starts_with(encode_utf8(character.code))) && english.ends_with('.');
      const bool is_short = length_in_characters(english) <= 120 && length_in_characters(chinese) <= 60;
      const bool is_plain = english.find("pen-down") == english.npos && english.find("  ") == english.npos;
      const bool is_chinese = chinese.ends_with("。") && std::none_of(chinese.begin(), chinese.end(), [](char each) {
                                return ('a' <= each && each <= 'z') || ('A' <= each && each <= 'Z') || each == ' ';
                              });
      CHECK((is_sentence && is_short && is_plain && is_chinese));
    }
  };
  std::vector<Character> all = built_in_characters().characters;
  for (const TypicalStroke& type : typical_strokes()) all.push_back(typical_character(type.id));
  for (const Character& character : all) {
    const std::vector<PenPath> paths = copy_of(character);
    check(character, {});
    check(character, {paths.rbegin(), paths.rend()});
    for (std::size_t i = 0; i < paths.size(); ++i) {
      std::vector<PenPath> drawn = paths;
      drawn[i] = backwards(paths[i]);
      check(character, drawn);
      drawn.push_back(paths[i]);  // an attempt
      check(character, drawn);
      drawn = paths;
      for (Point& point : drawn[i]) point = paths[i].front() + Point(paths[i].front() - point).reverse();
      check(character, drawn);  // turned over
      drawn[i] = points_along(paths[i], 0.2 * path_length(paths[i]), 12);
      check(character, drawn);
      drawn = paths;
      const auto middle = static_cast<std::ptrdiff_t>(paths[i].size() / 2);
      if (middle > 1) {
        drawn[i] = PenPath(paths[i].begin(), paths[i].begin() + middle);
        drawn.insert(drawn.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     PenPath(paths[i].begin() + middle - 1, paths[i].end()));
        check(character, drawn);
      }
      drawn = paths;
      std::rotate(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(i), drawn.end());
      check(character, drawn);
      drawn.push_back({{1.5, 0.2}, {1.8, 0.9}, {1.5, 0.9}, {1.8, 0.2}});
      check(character, drawn);
      if (i + 1 < paths.size()) {
        drawn = paths;
        calligraphy_test::draw_line(drawn[i], paths[i + 1].front(), 0.01);
        drawn[i].insert(drawn[i].end(), paths[i + 1].begin(), paths[i + 1].end());
        drawn.erase(drawn.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        check(character, drawn);
        drawn = paths;
        std::swap(drawn[i], drawn[(i + 3) % drawn.size()]);
        check(character, drawn);
      }
    }
  }
  for (const Kind kind :
       {Kind::order, Kind::direction, Kind::shape, Kind::joined, Kind::broken, Kind::missing, Kind::extra}) {
    CAPTURE(to_string(kind));
    CHECK(seen[kind] > 20);
  }
}

TEST_CASE("each language has every text, and fills in nothing that English does not", "[judge]") {
  const auto words_in = [](const std::string& text) {
    std::set<std::string> words;
    for (std::size_t at = text.find('{'); at != text.npos; at = text.find('{', at + 1)) {
      words.insert(text.substr(at, text.find('}', at) + 1 - at));
    }
    return words;
  };
  const auto is_choice = [](std::string_view key) { return key.starts_with("ordinal.") || key.ends_with(".several"); };
  const Language english;
  for (const Language& language : languages()) {
    std::vector<std::string_view> keys = language.keys(), expected = english.keys(), differ;
    std::erase_if(keys, is_choice);
    std::erase_if(expected, is_choice);
    std::set_symmetric_difference(keys.begin(), keys.end(), expected.begin(), expected.end(), std::back_inserter(differ));
    CAPTURE(language.name(), differ);
    CHECK(differ.empty());
    for (const std::string_view key : language.keys()) {
      const auto here = words_in(language.text(key));
      auto there = words_in(english.text(key.starts_with("ordinal.") ? "ordinal" : key));
      if (key == "stroke") there.insert("{name}");  // which is Chinese
      CAPTURE(key, language.text(key));
      CHECK((!language.text(key).empty() && std::includes(there.begin(), there.end(), here.begin(), here.end())));
    }
  }
  CHECK_THROWS_WITH(Language("tlh"), Catch::Matchers::StartsWith("language \"tlh\": expected one of "));
}

TEST_CASE("a stroke that goes too far, not far enough, or is out of place, is so in one of four ways", "[judge]") {
  const std::vector<Said> off = {{"far to the right", "靠右"}, {"high", "高"}, {"far to the left", "靠左"}, {"low", "低"}};
  const std::vector<Said> ways = {{"to the right", "右"}, {"up", "上"}, {"to the left", "左"}, {"down", "下"}};
  for (std::size_t i = 0; i < 4; ++i) {
    for (const double beside : {-40.0, 0.0, 40.0}) {
      const double angle = (90.0 * static_cast<double>(i) + beside) * std::numbers::pi / 180.0;
      const Point middle(0.5, 0.5), arm(0.4 * std::cos(angle), 0.4 * std::sin(angle));
      const std::vector<StrokeInput> strokes = {{2, {middle - arm, middle + arm}}, {1, {{0.1, 0.5}, {0.9, 0.5}}}};
      const Character character = make_character(U'十', strokes);
      const Said &ahead = off[i], &behind = off[(i + 2) % 4], &way = ways[i];
      StrokeRemark remark{.kind = Kind::crossing, .stroke = 0, .stroke_count = 1, .other_stroke = 1};
      CAPTURE(i, beside);
      remark.end = StrokeEnd::end;
      CHECK(in_both(remark, character) ==
            Said("Stroke 1 (shù) goes on too far " + way.first + ": it should end at stroke 2 (héng).",
                 "第1笔（竖）向" + way.second + "写得太长了，到第2笔（横）就要收笔。"));
      remark.end = StrokeEnd::start;
      CHECK(in_both(remark, character) ==
            Said("Stroke 1 (shù) begins too " + behind.first + ": it should not go beyond stroke 2 (héng).",
                 "第1笔（竖）起笔太" + behind.second + "了，不要超出第2笔（横）。"));
      remark.kind = Kind::no_crossing;
      remark.other_character = U'丁';
      CHECK(in_both(remark, character) == Said("Stroke 1 (shù) begins too " + ahead.first + ": here it becomes 丁.",
                                               "第1笔（竖）起笔太" + ahead.second + "了，这样就成了“丁”。"));
      remark = {.kind = Kind::place, .stroke = 1, .stroke_count = 1, .offset = arm};
      CHECK(in_both(remark, character) ==
            Said("Stroke 2 (héng) is too " + ahead.first + ": look where the model has it.",
                 "第2笔（横）的位置太" + ahead.second + "了，请照着范字的位置写。"));
    }
  }
  const Character eternal = built_in("永");  // whose hooked stroke goes down, and only its hook goes left
  CHECK(remark_text({.kind = Kind::crossing, .stroke = 1, .stroke_count = 1, .other_stroke = 0, .end = StrokeEnd::end},
                    eternal)
            .starts_with("Stroke 2 (héngzhégōu) goes on too far down"));
}

TEST_CASE("of parts that changed places it is said where the first belongs", "[judge]") {
  const std::vector<StrokeInput> strokes = {
      {1, {{0.1, 0.7}, {0.3, 0.7}}}, {2, {{0.2, 0.9}, {0.2, 0.1}}}, {1, {{0.4, 0.5}, {0.9, 0.5}}}};
  const Character character = make_character(U'亿', strokes);
  CHECK(in_both({.kind = Kind::parts, .stroke = 0, .stroke_count = 2, .other_stroke = 2}, character) ==
        Said("The two parts are in each other's place: strokes 1 (héng) and 2 (shù) belong at the left.",
             "两个部件的位置写反了，第1笔（横）和第2笔（竖）应该在左边。"));
}

TEST_CASE("every remark of form says something else", "[judge]") {
  const Character eternal = built_in("永");
  std::vector<StrokeRemark> remarks;
  for (int kind = static_cast<int>(Kind::unreadable); kind <= static_cast<int>(Kind::proportion); ++kind) {
    const StrokeRemark remark{.kind = Kind(kind), .stroke = 0, .stroke_count = 1, .other_stroke = 2, .length = 0.5,
                              .orientation = WritingOrientation::mirrored};
    remarks.push_back(remark);
    if (Kind(kind) == Kind::crossing || Kind(kind) == Kind::no_crossing || Kind(kind) == Kind::gap) {
      for (const StrokeEnd end : {StrokeEnd::start, StrokeEnd::end}) remarks.push_back(remark), remarks.back().end = end;
    }
    if (Kind(kind) == Kind::crossing || Kind(kind) == Kind::no_crossing || Kind(kind) == Kind::proportion) {
      remarks.push_back(remark), remarks.back().other_character = U'水';
    }
    if (Kind(kind) == Kind::overlap || Kind(kind) == Kind::straight || Kind(kind) == Kind::wavy) {
      remarks.push_back(remark), remarks.back().stroke_count = 5;
    }
    if (Kind(kind) == Kind::length) remarks.push_back(remark), remarks.back().length = 2.0;
    for (int i = 2; Kind(kind) == Kind::orientation && i <= static_cast<int>(WritingOrientation::mirrored_right); ++i) {
      remarks.push_back(remark), remarks.back().orientation = WritingOrientation(i);
    }
  }
  for (const Language& language : languages()) {
    std::set<std::string> texts;
    for (const StrokeRemark& remark : remarks) texts.insert(remark_text(remark, eternal, language));
    CHECK(texts.size() == remarks.size());
  }
  CHECK(remark_text({.kind = Kind::length, .stroke = 0, .stroke_count = 1, .length = 0.5}, eternal) ==
        "Stroke 1 (diǎn) is too short beside the others: draw it longer.");
}

TEST_CASE("every kind of remark, on one stroke or several, is said in full in every language", "[judge]") {
  const Character eternal = built_in("永");
  for (const Language& language : languages()) {
    for (int kind = 0; kind <= static_cast<int>(Kind::proportion); ++kind) {
      std::string cell = std::string("cell.") + to_string(Kind(kind));  // a word for tables
      std::replace(cell.begin(), cell.end(), ' ', '_');
      CHECK_FALSE(language.text(cell).empty());
      for (const int count : {1, 2, 3}) {
        for (const int stroke : {0, 2}) {
          for (const int other : {-1, 1, 4}) {
            for (const double length : {0.2, 1.0}) {
              for (const WritingDirection direction : {WritingDirection::forwards, WritingDirection::backwards}) {
                const StrokeRemark remark{.kind = Kind(kind), .path = 21, .path_count = 1, .stroke = stroke,
                                          .stroke_count = count, .other_path = other,
                                          .other_stroke = is_of_form(Kind(kind)) ? 4 : other,
                                          .other_character = U'水', .length = length, .direction = direction,
                                          .end = other < 0 ? StrokeEnd::start : StrokeEnd::end,
                                          .orientation = WritingOrientation::mirrored_right};
                const std::string text = remark_text(remark, eternal, language);
                CAPTURE(language.name(), kind, count, stroke, other, text);
                CHECK((text.size() > 10 && text.find_first_of("{}") == text.npos));
              }
            }
          }
        }
      }
    }
  }
  CHECK_THROWS_WITH(remark_text({.stroke = 3, .stroke_count = 3}, eternal),
                    "remark on 3 strokes from index 3: the character has 5");
  constexpr int huge = std::numeric_limits<int>::max();
  const std::vector<StrokeRemark> impossible = {{.kind = Kind::missing},
                                                {.kind = Kind::shape, .stroke_count = 1},
                                                {.kind = Kind::joined, .stroke = 1, .stroke_count = huge},
                                                {.kind = Kind(static_cast<int>(Kind::proportion) + 1), .stroke = 0},
                                                {.kind = Kind::gap, .stroke = 0, .stroke_count = 1},
                                                {.kind = Kind::overlap, .stroke = 0, .stroke_count = 1},
                                                {.kind = Kind::bent, .stroke_count = 1},
                                                {.kind = Kind::orientation},
                                                {.kind = Kind::orientation, .orientation = WritingOrientation(8)},
                                                {.kind = Kind::side, .stroke = 0, .stroke_count = 1, .other_stroke = 1,
                                                 .end = StrokeEnd(3)},
                                                {.kind = Kind::extra},
                                                {.kind = Kind::extra, .path = 0, .other_stroke = huge}};
  for (const StrokeRemark& wrong : impossible) {
    CHECK_THROWS_AS(remark_text(wrong, eternal), ValueError);
    CHECK_THROWS_AS(remark_text(wrong, Character()), ValueError);
  }
  CHECK(remark_text({.kind = Kind::extra, .path = huge}, eternal).find("2147483648th line") != std::string::npos);
}
