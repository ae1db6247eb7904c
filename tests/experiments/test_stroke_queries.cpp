#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/nearest_point.hpp>

#include "../catch.hpp"
#include "../practice/pages.hpp"
#include "experiments/stroke_queries.hpp"

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

TEST_CASE("a pen path runs along each stroke from start to end at 50 mm/s", "[practice]") {
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

TEST_CASE("the pen deviates smoothly and at most by the wobble", "[practice]") {
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

TEST_CASE("the same seed gives the same paths, another seed different ones", "[practice]") {
  StrokeQueryOptions other;
  other.seed = 2;
  const auto first = drawn(), again = drawn(), second = drawn(other);
  for (std::size_t i = 0; i < first.size(); ++i) {
    CHECK(first[i].path == again[i].path);
    CHECK(first[i].path != second[i].path);
    CHECK(first[i].elements == second[i].elements);
  }
}

TEST_CASE("an option out of its domain is rejected", "[practice]") {
  StrokeQueryOptions options;
  SECTION("no speed") { options.speed = 0.0; }
  SECTION("no rate") { options.rate = -1.0; }
  SECTION("an infinite square") { options.em = std::numeric_limits<double>::infinity(); }
  SECTION("a wobble that is not a number") { options.wobble = std::numeric_limits<double>::quiet_NaN(); }
  CHECK_THROWS_AS(drawn(options), ValueError);
}
