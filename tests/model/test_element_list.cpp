// Strokes of other compositions than their typical stroke: in memory and in both file formats.
#include "../catch.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/set_encoding.hpp>

#include "character_lists.hpp"

using namespace calligraphy;
using calligraphy_test::same;

namespace {

/// The typical stroke with other elements: its feature points, and curves that leave and arrive as smooth joints
/// require, in the direction of a neighbouring line or of the typical stroke.
StrokeInput variant(const TypicalStroke& type, const std::string& elements) {
  const std::vector<int> typical = feature_points(type.elements);
  const auto shape = [&](int i) {
    const auto& point = type.shape[static_cast<std::size_t>(i)];
    return Point(point[0], point[1]);
  };
  const auto feature = [&](std::size_t i) { return shape(typical[i]); };
  const auto direction = [&](std::size_t element, bool leaving) -> Point {
    const std::size_t joint = leaving ? element : element + 1;
    const bool inner = joint > 0 && joint < elements.size();
    if (inner && elements[joint - 1] == 'L') return (feature(joint) - feature(joint - 1)).normalized();
    if (inner && elements[joint] == 'L') return (feature(joint + 1) - feature(joint)).normalized();
    const int at = typical[joint];
    return (leaving ? shape(at + 1) - shape(at) : shape(at) - shape(at - 1)).normalized();
  };
  StrokeInput stroke{type.id, {feature(0)}, {}, elements};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i] == 'C') {
      const double third = (feature(i + 1) - feature(i)).norm() / 3.0;
      stroke.control_points.push_back(feature(i) + third * direction(i, true));
      stroke.control_points.push_back(feature(i + 1) - third * direction(i, false));
    }
    stroke.control_points.push_back(feature(i + 1));
  }
  return stroke;
}

/// All that a stroke may be: every typical stroke in every composition.
std::vector<StrokeInput> all_variants() {
  std::vector<StrokeInput> all;
  for (const TypicalStroke& type : typical_strokes()) {
    const auto size = type.elements.size();
    for (unsigned curves = 0; curves < 1U << size; ++curves) {
      std::string elements(size, 'L');
      for (std::size_t i = 0; i < size; ++i) {
        if (((curves >> i) & 1) != 0) elements[i] = 'C';
      }
      all.push_back(variant(type, elements));
    }
  }
  return all;
}

CharacterList list_of(Character character) { return {{}, {std::move(character)}}; }

std::string written(const CharacterList& list) {
  std::ostringstream out;
  write_characters(out, list);
  return out.str();
}

CharacterList parsed(const std::string& text) {
  std::istringstream in(text);
  return read_characters(in, "test.txt");
}

}  // namespace

TEST_CASE("a stroke may have any of its elements as lines or curves, and has the points that these take", "[model]") {
  for (const StrokeInput& input : all_variants()) {
    INFO("id " << input.id << " " << input.elements.elements());
    const auto curves = std::ranges::count(input.elements.elements(), 'C');
    const auto elements = static_cast<std::ptrdiff_t>(input.elements.size());
    CHECK(control_point_count(input.elements) == elements + 1 + 2 * curves);
    const Character character = make_character(U'一', std::vector{input});
    const Stroke stroke = strokes(character)[0];
    CHECK(stroke.elements == input.elements.elements());
    CHECK(stroke.control_points.size() == input.control_points.size());
    CHECK(static_cast<std::ptrdiff_t>(stroke.attraction_factors.size()) == elements + 1);
    const Character quartic = with_quartic_curves(character);
    CHECK(strokes(quartic)[0].elements == input.elements.elements());
    CHECK(static_cast<std::ptrdiff_t>(quartic.structure.control_points.size()) == elements + 1 + 3 * curves);
    CHECK(quartic.structure.control_points.size() <= max_control_points_per_stroke);
    CHECK(same(make_character(U'一', std::vector{input_of(stroke)}), character));
    CHECK(input_of(stroke).elements.empty() == (input.elements == stroke.type->elements));
  }
}

TEST_CASE("a composition has at most five elements, each a line or a curve", "[model]") {
  CHECK(ElementList("LCL").elements() == "LCL");
  CHECK(ElementList("LCL").curves() == 0b010);
  CHECK(ElementList::of(3, 0b010) == "LCL");
  CHECK(ElementList().empty());
  for (const char* const elements : {"LLLLLL", "X", "lc", "L C"}) {
    CHECK_THROWS_WITH(ElementList(elements), Catch::Matchers::StartsWith("elements '" + std::string(elements) + "'"));
  }
}

TEST_CASE("a stroke is smooth where its typical stroke is, but not between two lines", "[model]") {
  const TypicalStroke& bend = typical_stroke(31);  // LCLL
  const StrokeInput round = variant(bend, "LCLL");
  StrokeInput kinked = round;
  kinked.control_points[2] += Point(0.1, 0.0);  // the handle after the first line
  CHECK_NOTHROW(make_character(U'一', std::vector{round}));
  CHECK_THROWS_WITH(make_character(U'一', std::vector{kinked}),
                    Catch::Matchers::StartsWith("stroke 1: the joint after element 1 bends"));
  CHECK_NOTHROW(make_character(U'一', std::vector{variant(bend, "LLLL")}));
  CHECK_FALSE(is_smooth_joint(bend, "LLLL", 0));
  CHECK(is_smooth_joint(bend, "CLLL", 0));
  CHECK_FALSE(is_smooth_joint(bend, "CLLL", 1));
  CHECK_FALSE(is_smooth_joint(bend, "CCCC", 2));  // a corner stays one
}

TEST_CASE("every composition survives the text format, which states it where it is not the typical one", "[model]") {
  const CharacterList list = list_of(make_character(U'一', all_variants()));
  const std::string text = written(list);
  CHECK(same(parsed(text).characters[0], list.characters[0]));
  CHECK(text.find("\nstroke 31 LLLL 0.32,0.88 ") != std::string::npos);
  CHECK(text.find("\nstroke 31 0.32,0.88 ") != std::string::npos);
  CHECK(text.find("stroke 31 LCLL") == std::string::npos);
}

TEST_CASE("in the text format of version 1, round bends are lines unless their composition is stated", "[model]") {
  const std::string strokes =
      "character 北\nstroke 31 0.5,0.9 0.5,0.2 0.6,0.1 0.9,0.1 0.9,0.2\n"
      "stroke 31 LCLL 0.5,0.9 0.5,0.3 0.5,0.2 0.5,0.1 0.6,0.1 0.9,0.1 0.9,0.2\n"
      "stroke 30 0.5,0.9 0.5,0.3 0.5,0.2 0.5,0.1 0.6,0.1 0.9,0.1\n";
  CHECK(parsed("calligraphy characters 1\n" + strokes).characters[0].sequence.elements ==
        std::vector<ElementList>{"LLLL", "LCLL", "LCL"});
  CHECK_THROWS_WITH(parsed("calligraphy characters 2\n" + strokes),
                    "test.txt:3: stroke 1: typical stroke 31 takes 7 control points, not 5, "
                    "unless its elements are LLLL");
}

TEST_CASE("every composition survives a set file, from the most frequent to those of the longest code", "[model]") {
  std::vector<StrokeInput> strokes = all_variants();
  REQUIRE(strokes.size() > 300);  // 40 have short codes
  const CharacterList list = list_of(make_character(U'一', strokes));
  for (const CoordinatePrecision precision : {CoordinatePrecision::exact, CoordinatePrecision::fine}) {
    const CharacterSet set = CharacterSet::from_bytes(encode_character_set(list, precision), "test.set");
    const Character stored = set.find(U'一')->character();
    CHECK(stored.sequence.elements == list.characters[0].sequence.elements);
    CHECK(stored.sequence.stroke_ids == list.characters[0].sequence.stroke_ids);
    if (precision == CoordinatePrecision::exact) CHECK(same(stored, list.characters[0]));
    for (std::size_t i = 0; i < strokes.size(); i += 7) {
      const auto stroke = set.find(U'一')->stroke(static_cast<int>(i));
      REQUIRE(stroke);
      CHECK(stroke->elements == strokes[i].elements.elements());
      CHECK(std::ranges::equal(stroke->stroke().control_points,
                               calligraphy::strokes(stored)[i].control_points));
      CHECK(set.find(U'一')->stroke_id(static_cast<int>(i)) == strokes[i].id);
    }
  }
}

TEST_CASE("a set of typical strokes alone has a header for those, and two bits a stroke for two kinds", "[model]") {
  std::vector<StrokeInput> strokes(8, {1, {Point(0.1, 0.5), Point(0.9, 0.5)}});
  strokes.resize(16, {2, {Point(0.5, 0.9), Point(0.5, 0.1)}});
  CharacterList list = list_of(make_character(U'一', strokes));
  const std::size_t all = encode_character_set(list).size();
  list.characters[0] = make_character(U'一', std::span(strokes).first(12));
  CHECK(all - encode_character_set(list).size() == 4 * (2 + 4 * 10) / 8);
}
