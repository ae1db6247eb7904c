// What two collections write differently.
#include "../catch.hpp"

#include <algorithm>
#include <vector>

#include <calligraphy/importers/set_comparison.hpp>

using namespace calligraphy;

namespace {

std::vector<StrokeInput> inputs_of(const Character& character) {
  std::vector<StrokeInput> inputs;
  for (const Stroke& stroke : strokes(character)) inputs.push_back(input_of(stroke));
  return inputs;
}

/// The differences of this one character from the built-in ones, as "kind: what".
std::vector<std::string> differences(char32_t code, const std::vector<StrokeInput>& inputs) {
  const CharacterList list{{}, {make_character(code, inputs)}};
  const SetComparison result = compare_sets(list, CharacterSet(built_in_characters()), 1);
  CHECK(result.compared == 1);
  std::vector<std::string> found;
  for (const SetDifference& each : result.differences) {
    found.push_back(std::string(to_string(each.kind)) + ": " + each.what);
  }
  return found;
}

}  // namespace

TEST_CASE("collections that write the same do not differ, whatever the place and size") {
  CharacterList moved = built_in_characters();
  for (Character& character : moved.characters) {
    for (Point& point : character.structure.control_points) point = 0.7 * point + Point(0.2, 0.1);
  }
  const SetComparison result = compare_sets(moved, CharacterSet(built_in_characters()), 1);
  CHECK(result.compared == static_cast<int>(moved.characters.size()));
  CHECK(result.differences.empty());
}

TEST_CASE("another order or direction is told by the numbers of the strokes, and so is another character") {
  const std::vector<StrokeInput> three = inputs_of(built_in_characters().at(U'三'));
  CHECK(differences(U'三', {three[0], three[2], three[1]}) ==
        std::vector<std::string>{"order: is written in the order 1 3 2 there"});
  std::vector<StrokeInput> turned = three;
  std::reverse(turned[1].control_points.begin(), turned[1].control_points.end());
  CHECK(differences(U'三', turned) == std::vector<std::string>{"direction: stroke 2 runs the other way there"});
  CHECK(differences(U'三', {three[0], three[1]}) ==
        std::vector<std::string>{"count: has 2 strokes, there 3"});
  CHECK(differences(U'十', inputs_of(built_in_characters().at(U'二'))) ==
        std::vector<std::string>{"character: its drawing is nearest to 二 (U+4E8C) there"});
  CHECK(differences(U'永', three) ==
        std::vector<std::string>{"character: has 3 strokes, there 5; its drawing is nearest to 三 (U+4E09)"});
}
