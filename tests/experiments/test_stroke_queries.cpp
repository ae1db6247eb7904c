#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/experiments/stroke_queries.hpp>

#include "../catch.hpp"
#include "../practice/pages.hpp"

using namespace calligraphy;
using calligraphy_test::characters;

namespace {

std::vector<StrokeQueries> drawn(const StrokeQueryOptions& options = {}) {
  return stroke_queries(characters("北永"), options);
}

double distance_to(const StrokeQueries& stroke, const Point& query) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& element : stroke.elements) {
    nearest = std::min(nearest, nearest_point(prepare_element(element), query).distance);
  }
  return nearest;
}

}  // namespace

TEST_CASE("a pen path leads along each stroke from its start to its end at 50 mm/s", "[practice]") {
  StrokeQueryOptions straight;
  straight.wobble = 0.0;
  const auto all = drawn(straight);
  REQUIRE(all.size() == 10);
  for (const StrokeQueries& stroke : all) {
    CHECK((stroke.path.front() - stroke.elements.front().front()).norm() < 1e-15);
    CHECK((stroke.path.back() - stroke.elements.back().back()).norm() < 1e-4);
    double longest = 0.0;
    for (std::size_t i = 1; i < stroke.path.size(); ++i) {
      longest = std::max(longest, (stroke.path[i] - stroke.path[i - 1]).norm());
      CHECK(distance_to(stroke, stroke.path[i]) < 1e-12);
    }
    CHECK(longest < 5.5e-5);
    CHECK(longest > 4.9e-5);
  }
}

TEST_CASE("the pen strays smoothly and at most by the wobble", "[practice]") {
  double furthest = 0.0;
  for (const StrokeQueries& stroke : drawn()) {
    for (std::size_t i = 0; i < stroke.path.size(); ++i) {
      furthest = std::max(furthest, distance_to(stroke, stroke.path[i]));
      if (i > 0) CHECK((stroke.path[i] - stroke.path[i - 1]).norm() < 1.2e-4);
    }
  }
  CHECK(furthest <= 0.003);
  CHECK(furthest > 0.001);
}

TEST_CASE("the same seed draws the same paths, another seed others", "[practice]") {
  StrokeQueryOptions other;
  other.seed = 2;
  const auto first = drawn(), again = drawn(), second = drawn(other);
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].path == again[i].path);
    CHECK(first[i].path != second[i].path);
    CHECK(first[i].elements == second[i].elements);
  }
}

TEST_CASE("a pen path that cannot be drawn is refused", "[practice]") {
  StrokeQueryOptions options;
  SECTION("no speed") { options.speed = 0.0; }
  SECTION("no rate") { options.rate = -1.0; }
  SECTION("an infinite square") { options.em = std::numeric_limits<double>::infinity(); }
  SECTION("a wobble that is no number") { options.wobble = std::numeric_limits<double>::quiet_NaN(); }
  CHECK_THROWS_AS(drawn(options), ValueError);
}
