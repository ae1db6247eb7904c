// validate() and make_character() find every kind of fault and name the stroke.
#include "../catch.hpp"

#include <cmath>
#include <functional>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../special_values.hpp"

namespace validator_tests {

using namespace calligraphy;

namespace {

using calligraphy_test::infinity;

/// The problems of 北 as in Table 3 after a change, one per line as "stroke: what".
std::string problems_after(const std::function<void(Character&)>& change) {
  Character character = paper_example();
  change(character);
  std::string text;
  for (const ValidationIssue& problem : validate(character))
    text += std::to_string(problem.stroke) + ": " + problem.what + "\n";
  return text;
}

std::string complaint(const std::vector<StrokeInput>& inputs, int degree = 3) {
  try {
    make_character(U'北', inputs, degree);
  } catch (const ValueError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::vector<Point> curve = {{0.8, 0.7}, {0.7, 0.6}, {0.6, 0.55}, {0.5, 0.5}};

}  // namespace

TEST_CASE("a valid character has no problems", "[model]") {
  CHECK(problems_after([](Character&) {}).empty());
}

TEST_CASE("points that are not finite or too far away are reported with their stroke", "[model]") {
  for (const double value : {infinity, -infinity, std::nan(""), 17.0, -1e300}) {
    for (const std::size_t index : {0u, 5u, 9u, 14u}) {
      const int stroke = index < 2 ? 1 : index < 4 ? 2 : index < 6 ? 3 : index < 11 ? 4 : 5;
      const std::string found = problems_after([&](Character& c) { c.structure.control_points[index].y() = value; });
      INFO(found);
      CHECK(found.starts_with(std::to_string(stroke) + ": control point"));
      CHECK(found.size() < 100);  // -1e+300, not its 300 digits
    }
  }
}

TEST_CASE("attraction factors that are negative or not finite are reported with their stroke", "[model]") {
  for (const double value : {infinity, std::nan(""), -0.5}) {
    const std::string found = problems_after([&](Character& c) { c.physics.attraction_factors[2] = value; });
    CHECK(found.starts_with("2: attraction factor"));
  }
  CHECK(problems_after([](Character& c) { c.physics.attraction_factors[2] = 0.0; }).empty());
}

TEST_CASE("counts that do not match the ids are found", "[model]") {
  CHECK(contains(problems_after([](Character& c) { c.structure.control_points.pop_back(); }),
                 "0: the strokes take 15 control points, not 14"));
  CHECK(contains(problems_after([](Character& c) { c.structure.control_points.emplace_back(0.5, 0.5); }), "not 16"));
  CHECK(
      contains(problems_after([](Character& c) { c.sequence.feature_points[3] = 4; }), "0: the feature point indices"));
  CHECK(contains(problems_after([](Character& c) { c.sequence.feature_points.clear(); }),
                 "0: the feature point indices"));
  CHECK(contains(problems_after([](Character& c) { c.sequence.feature_points[0] = -7; }),
                 "0: the feature point indices"));
  CHECK(contains(problems_after([](Character& c) { c.physics.attraction_factors.pop_back(); }),
                 "13 feature points have 12"));
  CHECK(contains(problems_after([](Character& c) {
                   c.sequence.stroke_ids.pop_back();
                   c.sequence.elements.pop_back();
                 }),
                 "0: the strokes take 11"));
}

TEST_CASE("a composition of another number of elements is found", "[model]") {
  CHECK(problems_after([](Character& c) { c.sequence.elements.pop_back(); }) == "0: 5 strokes have 4 compositions\n");
  for (const char* const elements : {"", "LLL", "LLLLL"}) {
    const std::string found = problems_after([&](Character& c) { c.sequence.elements[3] = elements; });
    CHECK(found == "4: typical stroke 31 is LCLL; a stroke of this type has as many elements, not '" +
                       std::string(elements) + "'\n");
  }
}

TEST_CASE("unknown ids and degrees, and a character without strokes, are found", "[model]") {
  for (const int id : {0, 40, -3}) {
    const std::string found = problems_after([&](Character& c) { c.sequence.stroke_ids[2] = id; });
    CHECK(found.starts_with("3: typical stroke id " + std::to_string(id)));
  }
  for (const int degree : {0, 2, 5, -1}) {
    const std::string found = problems_after([&](Character& c) { c.curve_degree = degree; });
    CHECK(found.starts_with("0: curve degree " + std::to_string(degree)));
  }
  CHECK(problems_after([](Character& c) { c = {}; }) == "0: there is no stroke\n");
}

TEST_CASE("elements of zero length are found, but a stroke of one line may be a point", "[model]") {
  const std::string found =
      problems_after([](Character& c) { c.structure.control_points[8] = c.structure.control_points[7]; });
  CHECK(found == "4: element 2 has zero length\n");
  CHECK(contains(problems_after([](Character& c) {
                   for (std::size_t i = 11; i < 15; ++i) c.structure.control_points[i] = {0.5, 0.5};
                 }),
                 "5: element 1 has zero length"));
  CHECK(problems_after([](Character& c) { c.structure.control_points[1] = c.structure.control_points[0]; }).empty());
}

TEST_CASE("a smooth joint that bends is reported with its angle", "[model]") {
  // shu wan (30), LCL with smooth joints: the last line turned off by 90 degrees.
  const std::vector<Point> points = {{0.32, 0.80}, {0.32, 0.42}, {0.32, 0.26},
                                     {0.36, 0.24}, {0.48, 0.24}, {0.48, 0.60}};
  CHECK(contains(complaint({{30, points}}), "stroke 1: the joint after element 2 bends by 90 degrees"));
  std::vector<Point> straight = points;
  straight[5] = {0.78, 0.24};
  CHECK(complaint({{30, straight}}).empty());
  straight[5] = {0.48 + 0.3 * std::cos(0.25), 0.24 + 0.3 * std::sin(0.25)};  // 14.3 degrees
  CHECK(complaint({{30, straight}}).empty());
  straight[5] = {0.48 + 0.3 * std::cos(0.28), 0.24 + 0.3 * std::sin(0.28)};  // 16.0 degrees
  CHECK(contains(complaint({{30, straight}}), "bends by 16 degrees"));
}

TEST_CASE("errors of make_character name the stroke and what it requires", "[model]") {
  CHECK(complaint({{2, {{0, 0}, {0, 1}}}, {4, curve}}).empty());
  CHECK(contains(complaint({{2, {{0, 0}, {0, 1}}}, {40, curve}}), "stroke 2: typical stroke id 40"));
  CHECK(contains(complaint({{2, {{0, 0}, {0, 1}}}, {4, {{0, 0}, {1, 1}}}}),
                 "stroke 2: typical stroke 4 takes 4 control points, not 2"));
  CHECK(contains(complaint({{4, curve}}, 4), "stroke 1: typical stroke 4 takes 5 control points, not 4"));
  CHECK(contains(complaint({{4, curve, {1.0}}}), "stroke 1: typical stroke 4 takes 2 attraction factors, not 1"));
  CHECK(contains(complaint({{4, curve, {1.0, -2.0}}}), "stroke 1: attraction factor"));
  CHECK(contains(complaint({{4, curve}}, 5), "curve degree 5"));
  CHECK(contains(complaint({}), "no stroke"));
}

}  // namespace validator_tests
