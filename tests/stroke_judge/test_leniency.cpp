#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../catch.hpp"
#include "cases.hpp"
#include "pens_of_tests.hpp"

using namespace calligraphy;

namespace calligraphy_test {
namespace {

using Told = std::vector<std::tuple<StrokeRemarkKind, int, int, int>>;

Told told(const Case& each, const JudgeTolerances& tolerances) {
  Told all;
  for (const StrokeRemark& remark : match_strokes(each.pen->character, each.corrupted.paths, tolerances).remarks) {
    all.emplace_back(remark.kind, remark.path, remark.stroke, remark.stroke_count);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Remarks that each of the three tells, of `count` cases a row.
std::array<std::size_t, 3> check_nested(const std::vector<RightPen>& pens, std::size_t count) {
  const std::vector<std::vector<RightPen>> sources = {pens};
  std::array<std::size_t, 3> sums = {};
  for (std::size_t row = 0; row < corruptions().size(); ++row) {
    for (const Case& each : cases_of(sources, row, StrokeClass::any, count, 11)) {
      const Told strict = told(each, JudgeTolerances::strict()), normal = told(each, JudgeTolerances::normal()),
                 lenient = told(each, JudgeTolerances::lenient());
      CAPTURE(corruptions()[row].name, encode_utf8(each.pen->character.code), each.seed);
      CHECK(std::includes(strict.begin(), strict.end(), normal.begin(), normal.end()));
      CHECK(std::includes(normal.begin(), normal.end(), lenient.begin(), lenient.end()));
      sums[0] += strict.size();
      sums[1] += normal.size();
      sums[2] += lenient.size();
    }
  }
  return sums;
}

}  // namespace

TEST_CASE("what is told strictly includes what is told normally, and that what is told leniently", "[judge]") {
  std::vector<RightPen> pens;
  for (const Character& character : built_in_characters().characters) {
    pens.push_back({"copies", character, copy_of(character)});
  }
  const std::array<std::size_t, 3> sums = check_nested(pens, 60);
  CHECK(sums[1] > sums[2]);  // slants between the strict and the normal bound are people's
}

TEST_CASE("the same of people's pens", "[judge][corpus]") {
  const auto corpus = people();
  if (!corpus) return;
  const auto [strict, normal, lenient] = check_nested(corpus->pens, 130);
  CHECK(strict > normal);
  CHECK(normal > lenient);
}

}  // namespace calligraphy_test
