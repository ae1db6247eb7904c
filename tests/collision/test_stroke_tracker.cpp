// The tracker against every element queried individually (Wang 2006, sec. 4.3.3).
#include "../catch.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/stroke_tracker.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/placed_character.hpp>

#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"

using namespace calligraphy;
using calligraphy_test::Sequence;

namespace {

double min_distance(const std::vector<StrokeElement>& elements, const Point& query) {
  double least = std::numeric_limits<double>::infinity();
  for (const StrokeElement& element : elements) least = std::min(least, nearest_point(element, query).distance);
  return least;
}

/// Along the stroke with a lateral wobble; the pen jumps every so often, in this share of the ticks.
std::vector<Point> path_along(const std::vector<StrokeElement>& elements, Sequence& random, double jumps) {
  std::vector<Point> path;
  for (const StrokeElement& element : elements) {
    for (int i = 0; i < 200; ++i) {
      const double t = i / 200.0;
      const Point along = element.tangent(t);
      const double aside = 0.004 * std::sin(0.05 * static_cast<double>(path.size()));
      path.push_back(element.point(t) + aside * Point(-along.y(), along.x()));
      if (random.next() < jumps) path.push_back(random.point(-0.01, 0.05));
    }
  }
  return path;
}

}  // namespace

TEST_CASE("a tracker names a tolerance that is out of range", "[collision]") {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 0.0, -1e-9, 1.5}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(StrokeTracker(std::span<const StrokeElement>(), bad), ValueError);
  }
  CHECK_THROWS_WITH(StrokeTracker(std::span<const StrokeElement>(), 1.5),
                    "tolerance = 1.5, must be above 0 and at most 1");
}

TEST_CASE("the tracker finds the nearest point of the whole stroke at every tick", "[collision]") {
  Sequence random(5);
  double worst = 0.0;
  int uncertified = 0, elsewhere = 0;
  for (const Character& character : built_in_characters().characters) {
    for (const Stroke& stroke : strokes(character)) {
      const std::vector<StrokeElement> elements = place_elements(stroke, {});
      const std::vector<Point> path = path_along(elements, random, 0.02);
      StrokeTracker tracker(elements);
      for (const Point& tip : path) {
        const StrokePoint found = tracker.update(tip);
        worst = std::max(worst, std::abs(found.closest.distance - min_distance(elements, tip)));
        uncertified += !found.closest.certified();
        const double of_its_element = nearest_point(elements[static_cast<std::size_t>(found.element)], tip).distance;
        elsewhere += std::abs(of_its_element - found.closest.distance) > 1e-12;
      }
    }
  }
  CHECK(worst <= 1e-9 * 0.04);
  CHECK(uncertified == 0);
  CHECK(elsewhere == 0);
}

TEST_CASE("a pen with noise or in the steps of an encoder is tracked as exactly as a smooth one", "[collision]") {
  const double noise = GENERATE(0.0, 10e-6), step = GENERATE(0.0, 23e-6, 55e-6);
  Sequence random(8);
  NearestPointOptions tight;
  tight.tolerance = 1e-15;
  double worst = 0.0;
  for (const Character& character : built_in_characters().characters) {
    for (const Stroke& stroke : strokes(character)) {
      const std::vector<StrokeElement> elements = place_elements(stroke, {});
      StrokeTracker tracker(elements);
      for (Point tip : path_along(elements, random, 0.0)) {
        tip += random.point(-noise, noise);
        if (step > 0.0) tip = step * (tip / step).array().round();
        const StrokePoint found = tracker.update(tip);
        const NearestPoint exact = nearest_point(elements[static_cast<std::size_t>(found.element)], tip, tight);
        worst = std::max(worst, (found.closest.point - exact.point).norm());
      }
    }
  }
  // A smooth pen gives 2.5e-12 m; the tolerance would permit 4e-11 m.
  INFO("worst " << 1e15 * worst << " fm");
  CHECK(worst <= 4e-12);
}

TEST_CASE("of equal distances the tracker returns the earlier element, and it does not allocate", "[collision]") {
  const std::vector<Point> across = {{0.0, 0.0}, {0.02, 0.0}}, down = {{0.02, 0.0}, {0.02, -0.02}};
  const std::vector<StrokeElement> corner = {prepare_element(across), prepare_element(down)};
  const std::size_t before = calligraphy_test::allocations();
  StrokeTracker tracker(corner);
  int later = 0;
  // Outside the corner its point is the nearest of both limbs; on the bisector inside both are equally far.
  for (int round = 0; round < 3; ++round) {
    for (const Point& tip : {Point(0.025, 0.005), Point(0.0225, 0.0025), Point(0.015, -0.005), Point(0.025, 0.005)}) {
      later += tracker.update(tip).element != 0;
      tracker.update({0.021, -0.015});  // the later limb is the last one queried
    }
  }
  CHECK(later == 0);
  CHECK(calligraphy_test::allocations() == before);
}

TEST_CASE("a query that is not finite leaves the tracker unchanged", "[collision]") {
  const std::vector<Point> across = {{0.0, 0.0}, {0.02, 0.0}},
                           bend = {{0.02, 0.0}, {0.03, 0.0}, {0.03, -0.02}, {0.02, -0.03}};
  const std::vector<StrokeElement> elements = {prepare_element(across), prepare_element(bend)};
  StrokeTracker tracker(elements);
  const Point tip(0.028, -0.01);
  const StrokePoint before = tracker.update(tip);
  CHECK(before.element == 1);
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    const StrokePoint lost = tracker.update({x, 0.0});
    CHECK(lost.closest.status == NearestPointStatus::not_finite);
    CHECK(std::isinf(lost.closest.distance));
    CHECK(lost.closest.point.allFinite());
  }
  const StrokePoint after = tracker.update(tip);
  CHECK(after.element == before.element);
  CHECK(after.closest.distance == Approx(before.closest.distance).epsilon(1e-12));
}

TEST_CASE("a tracker without elements rejects every query, and one of more than five cannot be made", "[collision]") {
  StrokeTracker none{std::span<const StrokeElement>()};
  CHECK(none.update({0.0, 0.0}).closest.status == NearestPointStatus::not_finite);
  const std::vector<StrokeElement> elements(6, prepare_element(std::vector<Point>{{0.0, 0.0}, {0.01, 0.0}}));
  CHECK_THROWS_WITH(StrokeTracker(elements), "number of elements = 6, must be at most 5");
}

TEST_CASE("a tracker ignores an element that cannot answer, as a batch does", "[collision]") {
  const double no = std::numeric_limits<double>::quiet_NaN();
  const StrokeElement bad = prepare_element(std::vector<Point>{{no, 0.0}, {0.01, 0.0}}),
                      tiny = prepare_element(std::vector<Point>{{0.0, 0.0}, {1e-290, 0.0}}),
                      line = prepare_element(std::vector<Point>{{0.0, 0.0}, {0.01, 0.0}}),
                      next = prepare_element(std::vector<Point>{{0.01, 0.0}, {0.01, 0.02}});
  for (const auto& elements : std::vector<std::vector<StrokeElement>>{
           {bad, line, next}, {line, bad, next}, {tiny, line}, {line, next, tiny}, {bad, bad}, {bad}}) {
    StrokeTracker tracker(elements);
    int different = 0;
    for (int i = 0; i < 100; ++i) {
      const Point tip = i % 10 == 9 ? Point(1e200, no) : Point(0.0003 * i, 0.001 * (i % 7) - 1e-4);
      StrokePoint there = tracker.update(tip), found[1];
      nearest_points(elements, std::vector{tip}, found);
      different += there.closest.distance != Approx(found[0].closest.distance).epsilon(1e-12) ||
                   (found[0].closest.certified() && there.element != found[0].element);
    }
    CHECK(different == 0);
  }
}
