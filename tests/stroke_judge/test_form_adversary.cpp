// Faults of form that add up: however they are chosen, writing that is far from the character is told.
#include <iterator>
#include <string>
#include <vector>

#include <Eigen/QR>

#include <calligraphy/base/text.hpp>
#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/character_list.hpp>

#include "form_faults.hpp"
#include "judge/pen_traces.hpp"
#include "model/random_points.hpp"
#include "polyline.hpp"

namespace calligraphy_test {
namespace {

using namespace calligraphy;

constexpr int soon = 12, proposals = 60, writers = 3;

/// A fault of one stroke, from hardly to clearly.
struct Attack {
  FormFault fault;
  double least, most;  // FormRow::size
};
const Attack attacks[] = {{FormFault::protrude, 0.05, 0.3}, {FormFault::fall_short, 0.05, 0.3},
                          {FormFault::collapse, 0.0, 0.7},  {FormFault::uncross, 0.0, 0.0},
                          {FormFault::chord, 0.0, 0.0},     {FormFault::arch, 0.05, 0.3},
                          {FormFault::zigzag, 0.03, 0.2},   {FormFault::displace, 0.05, 0.3}};

std::vector<Character> attacked() {
  const auto imported = imported_characters();
  const CharacterSet set = imported ? *imported : CharacterSet(built_in_characters());
  std::vector<Character> characters;
  for (const char32_t code : U"永我国书好中") {
    const auto found = set.find(code);
    if (found) characters.push_back(found->character());
  }
  return characters;
}

/// The writing with one more fault.
std::vector<PenPath> worse(const RightPen& pen, RandomPoints& random) {
  for (;;) {
    const Attack& attack = attacks[random.index(std::size(attacks))];
    const FormRow row{"attack", attack.fault, random.between(attack.least, attack.most), {}};
    const auto written = malform(pen, row, random.bits());
    if (written) return written->paths;
  }
}

bool is_silent(const RightPen& pen) {
  const MatchResult match = match_strokes(pen.character, pen.paths);
  return match.remarks.size() == static_cast<std::size_t>(match.count(StrokeRemarkKind::hook));
}

/// The mean distance of the writing from the character, stroke by stroke, after the best affine map.
double distance_from_character(const RightPen& pen) {
  constexpr int count = 16;
  const std::vector<PenPath> lines = middle_lines(pen.character);
  const auto rows = static_cast<Eigen::Index>(count * lines.size());
  Eigen::MatrixX3d drawn(rows, 3);
  Eigen::MatrixX2d wanted(rows, 2);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const PenPath is = evenly(pen.paths[i], count), should_be = evenly(lines[i], count);
    for (std::size_t k = 0; k < count; ++k, ++row) {
      drawn.row(row) << is[k].x(), is[k].y(), 1.0;
      wanted.row(row) = should_be[k].transpose();
    }
  }
  const Eigen::MatrixX2d map = drawn.colPivHouseholderQr().solve(wanted);
  return (drawn * map - wanted).rowwise().norm().mean();
}

}  // namespace

TEST_CASE("a dozen faults of form that add up are told", "[judge]") {
  for (const Character& character : attacked()) {
    for (std::uint64_t seed = 0; seed < writers; ++seed) {
      RandomPoints random(seed);
      RightPen pen{"copy", character, copy_of(character)};
      CHECK(is_silent(pen));
      int step = 0;
      for (; step < soon && is_silent(pen); ++step) pen.paths = worse(pen, random);
      CAPTURE(encode_utf8(character.code), seed, step, distance_from_character(pen));
      CHECK(step < soon);
    }
  }
}

TEST_CASE("whoever keeps only faults of form that are not told does not get far from the character", "[judge]") {
  for (const Character& character : attacked()) {
    for (std::uint64_t seed = 0; seed < writers; ++seed) {
      RandomPoints random(seed);
      RightPen pen{"copy", character, copy_of(character)};
      int kept = 0;
      for (int proposal = 0; proposal < proposals; ++proposal) {
        RightPen next{"copy", character, worse(pen, random)};
        if (!is_silent(next)) continue;
        pen = std::move(next);
        ++kept;
      }
      CAPTURE(encode_utf8(character.code), seed, kept);
      CHECK(distance_from_character(pen) < 0.1);  // 0.09 by the judge's own fit
    }
  }
}

}  // namespace calligraphy_test
