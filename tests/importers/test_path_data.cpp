// SVG path data as polylines: geometry and grammar of the specification.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/bezier.hpp>

#include "../catch.hpp"
#include "importers/read/path_data.hpp"

namespace path_data_tests {

using namespace calligraphy;
using Path = std::vector<Point>;

namespace {

std::string complaint(const std::string& data) {
  try {
    flattened_path(data, 0.01);
  } catch (const FormatError& error) {
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

double distance_to(const Path& path, const Point& point) {
  double nearest = INFINITY;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point along = path[i] - path[i - 1];
    const double t = std::clamp((point - path[i - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point - path[i - 1] - t * along).norm());
  }
  return nearest;
}

void check_same(const std::string& data, const std::string& expected) {
  INFO(data);
  const Path path = flattened_path(data, 0.01), wanted = flattened_path(expected, 0.01);
  REQUIRE(path.size() == wanted.size());
  for (std::size_t i = 0; i < path.size(); ++i) CHECK((path[i] - wanted[i]).norm() < 1e-9);
}

/// The greatest distance of the vertices and of the middles of the edges from a circle.
std::pair<double, double> distances_from_circle(const Path& path, const Point& centre, double radius) {
  double vertices = 0.0, edges = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    vertices = std::max(vertices, std::abs((path[i] - centre).norm() - radius));
    if (i > 0) edges = std::max(edges, std::abs((0.5 * (path[i] + path[i - 1]) - centre).norm() - radius));
  }
  return {vertices, edges};
}

}  // namespace

TEST_CASE("a polyline is within the tolerance of its curve everywhere", "[practice]") {
  const Bezier<3> cubic{{Point(10, 10), Point(90, 5), Point(-20, 100), Point(70, 95)}};
  const Bezier<2> quadratic{{Point(0, 0), Point(20, 40), Point(60, 0)}};
  for (const double tolerance : {1.0, 0.1, 0.005}) {
    const Path path = flattened_path("M10,10C90,5-20,100,70,95", tolerance);
    const Path other = flattened_path("M 0 0 Q 20 40 60 0", tolerance);
    for (int i = 0; i <= 1000; ++i) {
      REQUIRE(distance_to(path, cubic.point(i / 1000.0)) <= tolerance);
      REQUIRE(distance_to(other, quadratic.point(i / 1000.0)) <= tolerance);
    }
  }
}

TEST_CASE("every way to write a curve draws the same one", "[practice]") {
  // S mirrors the last handle: (40, 20) at (30, 30) is (20, 40).
  const std::string smooth = "M10 10C20 10 40 20 30 30C20 40 50 50 60 60";
  for (const char* const same :
       {"m10,10c10,0,30,10,20,20s20,20,30,30", "M10,10C20,10 40,20 30,30S50,50 60,60",
        "M10 10c10 0 30 10 20 20-10 10 20 20 30 30", " M 10 , 10 \n C 20 , 10 , 40 , 20 , 30 , 30 S 50 , 50 , 60 , 60 ",
        "M+10+1e1C20,10,40,20,30.0,30s2e1.2e2,30,30"}) {
    check_same(same, smooth);
  }
  const std::string lines = "M1 2L5 2L5 7L.5.25L1 2";
  for (const char* const same : {"M1,2H5V7L.5.25z", "m1 2h4v5l-4.5-6.75Z", "M1 2 5 2 5 7 .5.25Z",
                                 "m1,2 4,0 0,5-4.5-6.75z", "M1 2H3 5V4 7L.5.25 1 2"}) {
    Path path = flattened_path(same, 0.01);
    std::erase(path, Point(3, 2));
    std::erase(path, Point(5, 4));
    CHECK(path == flattened_path(lines, 0.01));
  }
}

TEST_CASE("S mirrors the handle of C and S alone, and T that of Q and T", "[practice]") {
  check_same("M0 0Q10 10 20 0T40 0T60 0t20 0", "M0 0Q10 10 20 0Q30-10 40 0Q50 10 60 0Q70-10 80 0");
  check_same("M0 0L20 0T40 0", "M0 0L20 0Q20 0 40 0");
  check_same("M0 0C0 10 20 10 20 0T40 0", "M0 0C0 10 20 10 20 0Q20 0 40 0");
  check_same("M0 0Q10 10 20 0S40 10 40 0", "M0 0Q10 10 20 0C20 0 40 10 40 0");
  check_same("M0 0C0 10 20 10 20 0L40 0S60 10 60 0", "M0 0C0 10 20 10 20 0L40 0C40 0 60 10 60 0");
}

TEST_CASE("an arc is on its ellipse, the large or the small part, in the sense of its flag", "[practice]") {
  // The four arcs of radius 5 from (0, 0) to (6, 0): centres (3, 4) and (3, -4).
  const struct {
    const char* flags;
    double centre, length;
  } arcs[] = {{"0 1", 4, 0.2048}, {"0 0", -4, 0.2048}, {"1 1", -4, 0.7952}, {"1 0", 4, 0.7952}};
  for (const auto& arc : arcs) {
    INFO(arc.flags);
    const Path path = flattened_path(std::string("M0 0A5 5 0 ") + arc.flags + " 6 0", 0.001);
    const auto [vertices, edges] = distances_from_circle(path, {3, arc.centre}, 5);
    CHECK(vertices < 1e-12);
    CHECK(edges <= 0.001);
    double length = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
    CHECK(length == Approx(arc.length * 10 * std::numbers::pi).epsilon(1e-3));
  }
  // Half an ellipse with semi-axes 10 and 5, the first along the diagonal.
  for (const Point& point : flattened_path("M0 0A10 5 45 0 1 14.142135623730951 14.142135623730951", 0.01)) {
    const Point from_centre = point - Point(std::sqrt(50.0), std::sqrt(50.0));
    const double along = from_centre.dot(Point(1, 1).normalized()), across = from_centre.dot(Point(-1, 1).normalized());
    CHECK(std::hypot(along / 10, across / 5) == Approx(1.0));
    CHECK(across < 1e-9);  // y down, a positive sense is clockwise to the eye: above the diagonal
  }
}

TEST_CASE("degenerate arcs are drawn as the specification has it", "[practice]") {
  check_same("M0 0A0 5 0 0 1 6 2", "M0 0L6 2");
  check_same("M0 0A5 0 0 0 1 6 2", "M0 0L6 2");
  check_same("M0 0A5 5 0 0 1 0 0L1 1", "M0 0L1 1");
  check_same("M0 0A-5 5 0 0 1 6 0", "M0 0A5 5 0 0 1 6 0");
  check_same("M0 0A1 1 0 0 1 6 0", "M0 0A3 3 0 0 1 6 0");  // too small to reach: scaled
  check_same("M0 0a1 1 0 01.5.5", "M0 0A1 1 0 0 1 0.5 0.5");
  check_same("M0 0a1,1,0,1,0.5.5a1 1 0 00-1-1", "M0 0A1 1 0 1 0 0.5 0.5A1 1 0 0 0-.5-.5");
  check_same("M0 0A1e300 1e300 0 0 1 6 0", "M0 0L6 0");
}

TEST_CASE("subpaths are told apart, and one that draws nothing is none", "[practice]") {
  const std::vector<Subpath> parts = flattened("M9 9M1 1L2 1L2 2zl0 3M5 5m1 0h2Z", 0.01);
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].points == Path{{1, 1}, {2, 1}, {2, 2}});
  CHECK(parts[0].is_closed);
  CHECK(parts[1].points == Path{{1, 1}, {1, 4}});
  CHECK_FALSE(parts[1].is_closed);
  CHECK(parts[2].points == Path{{6, 5}, {8, 5}});
  CHECK(has(complaint("M1 1L2 1M3 3L4 4"), "draws 2 lines, each after an M: expected one"));
  CHECK(complaint("M1 1M3 3L4 4").empty());
}

TEST_CASE("an outline is polygons, each closed by Z or by its last point", "[practice]") {
  const Path triangle{{0, 0}, {4, 0}, {4, 3}};
  CHECK(flattened_outline("M 0 0 L 4 0 L 4 3 Z", 0.01) == std::vector<Path>{triangle});
  CHECK(flattened_outline("m0,0l4,0 0,3zm0 0h4v3z", 0.01) == std::vector<Path>{triangle, triangle});
  CHECK(flattened_outline("M0 0H4V3L0 0", 0.01).size() == 1);
  CHECK_THROWS_AS(flattened_outline("M0 0H4V3", 0.01), FormatError);
  CHECK_THROWS_AS(flattened_outline("M0 0H4V3ZM5 5H6V7", 0.01), FormatError);
}

TEST_CASE("what is no path data is rejected with its byte", "[practice]") {
  CHECK(has(complaint(""), "at byte 0: expected a command"));
  CHECK(has(complaint("C1,2,3,4,5,6"), "at byte 0: expected M, found 'C'"));
  for (const char* const command : {"B3,4", "m", "e5", "&x;", "\xFF", ",L3,4", "L3,4,", "L,3,4", "L3", "A1,1,0,2,0,3,3",
                                    "A1,1,0,0,,0,3,3", "L3,4 5", "ZZ3"}) {
    INFO(command);
    CHECK(has(complaint(std::string("M1,2c1,1,2,2,3,3") + command), "at byte"));
  }
  CHECK(has(complaint("M1,2c1,2,3,4,5"), "expected a number, found the end"));
  CHECK(has(complaint("M1,,2"), "at byte 3: expected a number"));
  for (const char* const number : {"nan", "inf", "1e999", "x", "+-1", "--1", "."}) {
    INFO(number);
    CHECK(has(complaint(std::string("M1,") + number), "expected a number"));
  }
  CHECK(has(complaint("M1,1e9"), "beyond 10000"));
  CHECK(has(complaint("M0 0H9e3a9e3 9e3 0 0 1 0 9e3"), "beyond 10000"));
  CHECK(has(complaint("M1,1" + repeated("c9999,0,-9999,0,0,9", 100)), "more than 20000 points"));
  CHECK(has(complaint("M1,1" + repeated("M1,1", 20000)), "more than 20000 points"));
}

}  // namespace path_data_tests
