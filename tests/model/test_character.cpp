// Characters as sequences of typical strokes, Wang 2006, sec. 3.2, 3.5, Table 3.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../pen_path.hpp"

using namespace calligraphy;
using calligraphy_test::typical_character;

namespace {

/// Angle by which a stroke turns at the joint after an element, from its control polygon [degrees].
double turn_at_joint(const Stroke& stroke, std::size_t joint) {
  const auto at = static_cast<std::size_t>(feature_points(stroke.elements, stroke.curve_degree)[joint]);
  const Point before = (stroke.control_points[at] - stroke.control_points[at - 1]).normalized();
  const Point after = (stroke.control_points[at + 1] - stroke.control_points[at]).normalized();
  return std::acos(std::clamp(before.dot(after), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

}  // namespace

TEST_CASE("Table 3: five strokes with ids 2, 1, 10, 31, 4, 15 control points and 13 feature points", "[model]") {
  const Character& example = paper_example();
  CHECK(example.code == U'北');
  CHECK(example.stroke_count() == 5);
  CHECK(example.sequence.stroke_ids == std::vector<int>{2, 1, 10, 31, 4});
  CHECK(example.sequence.elements == std::vector<ElementList>{"L", "L", "L", "LLLL", "C"});
  CHECK(example.structure.control_points.size() == 15);
  CHECK(example.sequence.feature_points.size() == 13);
  CHECK(example.physics.attraction_factors.size() == 13);
  CHECK(example.sequence.feature_points == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 14});
  CHECK(validate(example).empty());
}

TEST_CASE("eq. (1) as printed contradicts Table 3: quartics give 16 control points", "[model]") {
  const Character quartic = with_quartic_curves(paper_example());
  CHECK(quartic.curve_degree == 4);
  CHECK(quartic.structure.control_points.size() == 16);
  CHECK(quartic.sequence.feature_points.size() == 13);
  CHECK(validate(quartic).empty());
}

TEST_CASE("the built-in 北 has the strokes of Table 3 in the standard order, with a round bend", "[model]") {
  const Character* north = built_in_characters().find(U'北');
  REQUIRE(north != nullptr);
  CHECK(north->sequence.stroke_ids == std::vector<int>{2, 1, 10, 4, 31});
  CHECK(north->sequence.elements == std::vector<ElementList>{"L", "L", "L", "C", "LCLL"});
  CHECK(north->sequence.feature_points.size() == 13);
}

TEST_CASE("every built-in character is valid and every typical stroke is used", "[model]") {
  const CharacterList& set = built_in_characters();
  CHECK(set.characters.size() >= 40);
  CHECK_FALSE(set.provenance.licence.empty());
  CHECK_FALSE(set.provenance.source.empty());
  CHECK_FALSE(set.provenance.attribution.empty());
  std::set<int> ids;
  std::set<char32_t> codes;
  for (const Character& character : set.characters) {
    CHECK(validate(character).empty());
    CHECK(codes.insert(character.code).second);
    ids.insert(character.sequence.stroke_ids.begin(), character.sequence.stroke_ids.end());
    for (const Point& point : character.structure.control_points) {
      CHECK((point.minCoeff() >= 0.0 && point.maxCoeff() <= 1.0));
    }
  }
  CHECK(ids.size() == 39);
  for (const char32_t code : U"永北京航空航天大学") {
    if (code != 0) CHECK(set.find(code) != nullptr);
  }
  CHECK(set.find(U'A') == nullptr);
}

TEST_CASE("the same shape with quartic curves is the same shape", "[model]") {
  for (const Character& character : built_in_characters().characters) {
    const Character quartic = with_quartic_curves(character);
    const auto before = strokes(character), after = strokes(quartic);
    REQUIRE(before.size() == after.size());
    double worst = 0.0;
    for (std::size_t s = 0; s < before.size(); ++s) {
      std::size_t a = 0, b = 0;
      for (const char kind : before[s].elements) {
        const auto p = before[s].control_points.subspan(a), q = after[s].control_points.subspan(b);
        worst = std::max(worst, (p[0] - q[0]).norm());
        if (kind == 'C') {
          for (int i = 0; i <= 16; ++i) {
            const double t = i / 16.0;
            worst = std::max(worst, (Bezier<3>{{p[0], p[1], p[2], p[3]}}.point(t) -
                                     Bezier<4>{{q[0], q[1], q[2], q[3], q[4]}}.point(t))
                                        .norm());
          }
        }
        a += kind == 'C' ? 3 : 1;
        b += kind == 'C' ? 4 : 1;
      }
      worst = std::max(worst, (before[s].control_points.back() - after[s].control_points.back()).norm());
    }
    CHECK(worst < 1e-15);
  }
  const Character once = with_quartic_curves(paper_example());
  CHECK(with_quartic_curves(once).structure.control_points == once.structure.control_points);
}

TEST_CASE("second-order continuity, as sec. 3.4 requires, is impossible at a corner", "[model]") {
  const Character corner = typical_character(16);  // heng zhe
  const double turn = turn_at_joint(strokes(corner)[0], 1);
  CHECK(turn > 75.0);
  CHECK(turn < 110.0);
  CHECK(typical_stroke(16).joints == "c");
}

TEST_CASE("smooth joints are tangent continuous, in the stroke library and in every character", "[model]") {
  int smooth_joints = 0;
  const auto check = [&](const Character& character, double limit) {
    for (const Stroke& stroke : strokes(character)) {
      for (std::size_t joint = 1; joint < stroke.elements.size(); ++joint) {
        if (!is_smooth_joint(*stroke.type, stroke.elements, joint - 1)) continue;
        ++smooth_joints;
        CHECK(turn_at_joint(stroke, joint) < limit);
      }
    }
  };
  for (int id = 1; id <= 39; ++id) check(typical_character(id), 5.0);
  CHECK(smooth_joints == 2 + 1 + 1 + 2 + 2 + 3);  // ids 22, 23, 30, 39
  for (const Character& character : built_in_characters().characters) check(character, 15.0);
}

TEST_CASE("strokes are consecutive views into the character", "[model]") {
  const Character& example = paper_example();
  const auto views = strokes(example);
  REQUIRE(views.size() == 5);
  const Point* at = example.structure.control_points.data();
  for (const Stroke& stroke : views) {
    CHECK(stroke.control_points.data() == at);
    CHECK(stroke.control_points.size() == static_cast<std::size_t>(control_point_count(stroke.elements)));
    CHECK(stroke.attraction_factors.size() == static_cast<std::size_t>(feature_point_count(stroke.elements)));
    at += stroke.control_points.size();
  }
}

TEST_CASE("attraction factors are 1 unless given, and stay with their feature points", "[model]") {
  CHECK(typical_character(16).physics.attraction_factors == std::vector<double>{1.0, 1.0, 1.0});
  CHECK(typical_character(16, {0.5, 2.0, 0.0}).physics.attraction_factors == std::vector<double>{0.5, 2.0, 0.0});
  const Character quartic = with_quartic_curves(typical_character(4, {0.5, 2.0}));
  CHECK(quartic.physics.attraction_factors == std::vector<double>{0.5, 2.0});
}
