// The library of 39 typical strokes, Wang 2006, sec. 3.1, 3.4, Figs. 7, 11, 12.
#include "../catch.hpp"

#include <string_view>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/typical_stroke.hpp>

using namespace calligraphy;

namespace {

struct Row {
  int id;
  std::string_view code, elements;
  int control_points, feature_points;
};

/// Typed in from the project's reading of the lost Fig. 7; counts with cubic curves.
constexpr Row rows[] = {
    {1, "H", "L", 2, 2},          {2, "S", "L", 2, 2},        {3, "SP", "C", 4, 2},     {4, "P", "C", 4, 2},
    {5, "P (short/flat)", "L", 2, 2}, {6, "N", "C", 4, 2},    {7, "TN", "C", 4, 2},     {8, "D", "L", 2, 2},
    {9, "D (left)", "L", 2, 2},   {10, "T", "L", 2, 2},       {11, "HG", "LL", 3, 3},   {12, "SG", "LL", 3, 3},
    {13, "WG", "CL", 5, 3},       {14, "XG", "CL", 5, 3},     {15, "BXG", "CL", 5, 3},  {16, "HZ", "LL", 3, 3},
    {17, "HP", "LC", 5, 3},       {18, "HZG", "LLL", 4, 4},   {19, "HZT", "LLL", 4, 4}, {20, "HZWG", "LLCLL", 8, 6},
    {21, "HXG", "LCL", 6, 4},     {22, "HXWG", "LLCL", 7, 5}, {23, "HZW", "LLC", 6, 4}, {24, "HZZ", "LLL", 4, 4},
    {25, "HZZZ", "LLLL", 5, 5},   {26, "HZZP", "LLLC", 7, 5}, {27, "HZZZG", "LLLCL", 8, 6}, {28, "HPWG", "LLCL", 7, 5},
    {29, "ST", "LL", 3, 3},       {30, "SW", "LCL", 6, 4},    {31, "SWG", "LCLL", 7, 5}, {32, "SZ", "LL", 3, 3},
    {33, "SZP", "LLC", 6, 4},     {34, "SZZ", "LLL", 4, 4},   {35, "SZWG/SZZG", "LLCL", 7, 5}, {36, "PZ", "LL", 3, 3},
    {37, "PD", "CL", 5, 3},       {38, "D/N (long)", "C", 4, 2}, {39, "Q", "CCCC", 13, 5}};

}  // namespace

TEST_CASE("the 39 typical strokes agree with the table in codes, elements and counts", "[model]") {
  REQUIRE(typical_strokes().size() == 39);
  for (const Row& row : rows) {
    const TypicalStroke& stroke = typical_stroke(row.id);
    INFO("id " << row.id);
    CHECK(&stroke == &typical_strokes()[static_cast<std::size_t>(row.id - 1)]);
    CHECK(stroke.id == row.id);
    CHECK(stroke.code == row.code);
    CHECK(stroke.elements == row.elements);
    CHECK(control_point_count(stroke.elements) == row.control_points);
    CHECK(feature_point_count(stroke.elements) == row.feature_points);
    CHECK(stroke.shape.size() == static_cast<std::size_t>(row.control_points));
    CHECK(stroke.joints.size() + 1 == row.elements.size());
  }
}

TEST_CASE("feature points are the ends of elements among the control points, for cubics and quartics", "[model]") {
  CHECK(feature_points(typical_stroke(1).elements) == std::vector<int>{0, 1});
  CHECK(feature_points(typical_stroke(4).elements) == std::vector<int>{0, 3});
  CHECK(feature_points(typical_stroke(4).elements, 4) == std::vector<int>{0, 4});
  CHECK(feature_points(typical_stroke(27).elements) == std::vector<int>{0, 1, 2, 3, 6, 7});  // LLLCL
  CHECK(feature_points(typical_stroke(27).elements, 4) == std::vector<int>{0, 1, 2, 3, 7, 8});
  CHECK(control_point_count(typical_stroke(39).elements, 4) == 17);
  for (const TypicalStroke& stroke : typical_strokes()) {
    for (const int degree : {3, 4}) {
      CHECK(feature_points(stroke.elements, degree).back() + 1 == control_point_count(stroke.elements, degree));
      CHECK(control_point_count(stroke.elements, degree) <= max_control_points_per_stroke);
      CHECK(stroke.elements.size() <= max_elements_per_stroke);
    }
  }
}

TEST_CASE("id 16 is a compound of two elements, id 20 of five, as in Figs. 11 and 12", "[model]") {
  CHECK(typical_stroke(16).elements.size() == 2);
  CHECK(typical_stroke(20).elements.size() == 5);
}

TEST_CASE("an id outside 1 to 39 is rejected with its value", "[model]") {
  for (const int id : {0, -1, 40, 1000000}) {
    CHECK_THROWS_AS(typical_stroke(id), ValueError);
    try {
      typical_stroke(id);
    } catch (const ValueError& error) {
      CHECK(std::string_view(error.what()).find(std::to_string(id)) != std::string_view::npos);
    }
  }
}
