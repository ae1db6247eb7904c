// Which pen-down begins the stroke that is due: its place, its first direction, and the other strokes.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <calligraphy/render/renderer_options.hpp>

#include "render/stroke_capture.hpp"
#include "../allocation_counter.hpp"
#include "../pen_path.hpp"

namespace stroke_capture_tests {

using namespace calligraphy;

namespace {

constexpr double em = 0.04;  // [m]
constexpr double stretch = 0.0016;
constexpr double degree = std::numbers::pi / 180.0;

Point towards(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A stroke to the right from the origin, the only one.
const std::vector<StrokeStart> alone = {{{0, 0}, {1, 0}, stretch}};

/// A pen that moves by 0.1 mm per sample.
struct Pen {
  std::vector<StrokeStart> starts;
  StrokeTolerances tolerances;
  std::size_t due = 0;
  StrokeCapture capture = {};
  Point tip = {0, 0};

  CaptureVerdict down(const Point& place) {
    tip = place;
    for (StrokeStart& start : starts) start.min_cosine = std::cos(tolerances.direction);
    capture.put_down(tip, starts, due);
    return capture.update(tip, starts, due, em, tolerances);
  }
  /// The verdict at the end of the way; as a renderer does, it ends where the stroke is begun.
  CaptureVerdict go(const Point& way) {
    std::vector<Point> path = {tip};
    calligraphy_test::draw_line(path, tip + way, 1e-4);
    for (const Point& point : path) {
      tip = point;
      if (capture.update(tip, starts, due, em, tolerances) == CaptureVerdict::begun) break;
    }
    return capture.verdict();
  }
  CaptureVerdict draw(const Point& from, const Point& way) {
    down(from);
    return go(way);
  }
};

}  // namespace

TEST_CASE("a stroke is begun by its first stretch, not by less", "[render]") {
  Pen pen{alone, {}};
  CHECK(pen.down({0, 0}) == CaptureVerdict::undecided);
  CHECK(pen.go({0.0015, 0}) == CaptureVerdict::undecided);
  CHECK(pen.go({0.0002, 0}) == CaptureVerdict::begun);
  CHECK(pen.capture.begin() == Point(0, 0));
}

TEST_CASE("a stroke is begun within the tolerated distance of its start", "[render]") {
  for (const StrokeTolerances& tolerances :
       {StrokeTolerances::lenient(), StrokeTolerances::normal(), StrokeTolerances::strict()}) {
    const double radius = tolerances.start_distance * em;
    for (const double angle : {-90.0, -45.0, 0.0, 45.0, 90.0}) {  // ahead, where going on does not lead closer
      CAPTURE(radius, angle);
      Pen pen{alone, tolerances};
      CHECK(pen.draw(0.99 * radius * towards(angle * degree), {0.002, 0}) == CaptureVerdict::begun);
      CHECK(pen.capture.begin().isApprox(0.99 * radius * towards(angle * degree)));
      CHECK(pen.draw(1.01 * radius * towards(angle * degree), {0.02, 0}) == CaptureVerdict::undecided);
    }
  }
}

TEST_CASE("a stroke is begun within the tolerated angle of its direction, whichever way it runs", "[render]") {
  for (const StrokeTolerances& tolerances :
       {StrokeTolerances::lenient(), StrokeTolerances::normal(), StrokeTolerances::strict()}) {
    for (const double angle : {-179.0, -90.0, 0.0, 37.0, 135.0}) {
      for (const double side : {-1.0, 1.0}) {
        const StrokeStart start{{0, 0}, towards(angle * degree), stretch};
        Pen pen{{start}, tolerances};
        const auto off_by = [&](double off) -> Point { return 0.002 * towards(angle * degree + side * off); };
        CAPTURE(tolerances.direction, angle, side);
        CHECK(pen.draw({0, 0}, off_by(tolerances.direction - degree)) == CaptureVerdict::begun);
        CHECK(pen.draw({0, 0}, off_by(tolerances.direction + degree)) == CaptureVerdict::wrong_direction);
        CHECK(pen.draw({0, 0}, off_by(180.0 * degree)) == CaptureVerdict::wrong_direction);
      }
    }
  }
}

TEST_CASE("a pen that goes the wrong way near the start may turn and begin", "[render]") {
  Pen pen{alone, {}};
  CHECK(pen.draw({0, 0}, {-0.003, 0}) == CaptureVerdict::wrong_direction);
  CHECK(pen.go({0.005, 0}) == CaptureVerdict::begun);
  CHECK(pen.capture.begin().norm() <= 0.003);
}

TEST_CASE("a pen that approaches the stroke from the side neither begins it nor goes the wrong way", "[render]") {
  for (const double side : {-1.0, 1.0}) {
    CAPTURE(side);
    Pen pen{alone, {}};
    CHECK(pen.draw({0, 0.005 * side}, {0, -0.005 * side}) == CaptureVerdict::undecided);
    CHECK(pen.go({0.003, 0}) == CaptureVerdict::begun);
    // Nor does the approach count towards the first stretch, with another start nearby either.
    Pen near_another{{alone[0], {{0, 0.008 * side}, {0, side}, stretch}}, {}};
    CHECK(near_another.draw({0, 0.005 * side}, {0.0012, -0.005 * side}) == CaptureVerdict::undecided);
    CHECK(near_another.go({0.001, 0}) == CaptureVerdict::begun);
    // One that crosses it or moves off does.
    CHECK(pen.draw({0, 0.005 * side}, {0, -0.007 * side}) == CaptureVerdict::wrong_direction);
    CHECK(pen.draw({0, 0.005 * side}, {0, 0.002 * side}) == CaptureVerdict::wrong_direction);
    // On its way it may write on already: 45 degrees, of which only the part along the stroke counts.
    CHECK(pen.draw({0, 0.005 * side}, {0.002, -0.002 * side}) == CaptureVerdict::begun);
  }
}

TEST_CASE("who writes another stroke of the character writes that one until the pen is lifted", "[render]") {
  const Point other(0.012, 0);
  Pen pen{{alone[0], {other, {0, 1}, stretch}}, {}};
  CHECK(pen.draw(other, {0, 0.0015}) == CaptureVerdict::undecided);
  CHECK(pen.go({0, 0.0015}) == CaptureVerdict::another_stroke);
  CHECK_FALSE(pen.capture.is_nearest());
  CHECK(pen.go(Point(-0.004, 0) - pen.tip) == CaptureVerdict::another_stroke);
  CHECK(pen.go({0.01, 0}) == CaptureVerdict::another_stroke);  // through the start of the stroke that is due
  CHECK(pen.draw({0, 0}, {0.003, 0}) == CaptureVerdict::begun);
  CHECK(pen.capture.is_nearest());
}

TEST_CASE("strokes that have been written are no longer considered", "[render]") {
  Pen pen{{{{0.005, 0}, {1, 0}, stretch}, alone[0]}, {}};
  pen.due = 1;
  CHECK(pen.draw({0.005, 0}, {0.003, 0}) == CaptureVerdict::begun);
  CHECK(pen.capture.is_nearest());
  std::swap(pen.starts[0], pen.starts[1]);
  pen.due = 0;
  CHECK(pen.draw({0.005, 0}, {0.003, 0}) == CaptureVerdict::another_stroke);
}

TEST_CASE("a later stroke is meant where it fits clearly better, not where the two fit alike", "[render]") {
  // From the same start, 40 degrees apart; both tolerate 60 degrees.
  Pen pen{{alone[0], {{0, 0}, towards(40.0 * degree), stretch}}, {}};
  CHECK(pen.draw({0, 0}, 0.002 * towards(0.0)) == CaptureVerdict::begun);
  CHECK(pen.draw({0, 0}, 0.002 * towards(20.0 * degree)) == CaptureVerdict::begun);
  CHECK(pen.draw({0, 0}, 0.002 * towards(25.0 * degree)) == CaptureVerdict::begun);  // 1.7 times as far off
  CHECK(pen.draw({0, 0}, 0.002 * towards(40.0 * degree)) == CaptureVerdict::another_stroke);
  // And 4 mm apart; both tolerate 8 mm.
  pen.starts[1] = {{0, 0.004}, {1, 0}, stretch};
  CHECK(pen.draw({0, 0.002}, {0.002, 0}) == CaptureVerdict::begun);
  CHECK(pen.draw({0, 0.004}, {0.002, 0}) == CaptureVerdict::another_stroke);
  pen.tolerances.distinction = std::numeric_limits<double>::infinity();
  CHECK(pen.draw({0, 0.004}, {0.002, 0}) == CaptureVerdict::begun);
}

TEST_CASE("who has misplaced the strokes before is expected to misplace this one alike", "[render]") {
  const Point shift(0.006, 0.002);
  const std::vector<StrokeStart> first = {{{0.01, 0.01}, {1, 0}, stretch}};
  Pen pen{{alone[0], {shift, {1, 0}, stretch}}, {}};
  CHECK(pen.draw(shift, {0.002, 0}) == CaptureVerdict::another_stroke);
  for (int written = 0; written < 3; ++written) {
    Pen before{first, {}, 0, pen.capture, {0, 0}};
    REQUIRE(before.draw(first[0].point + shift, {0.002, 0}) == CaptureVerdict::begun);
    before.capture.written(first[0].point, before.capture.down());
    pen.capture = before.capture;
  }
  CHECK(pen.draw(shift, {0.002, 0}) == CaptureVerdict::begun);
  CHECK(pen.capture.is_nearest());
  pen.capture.restart();  // another character
  CHECK(pen.draw(shift, {0.002, 0}) == CaptureVerdict::another_stroke);
}

TEST_CASE("as printed only the place counts", "[render]") {
  const StrokeTolerances printed = RendererOptions::wang2006().tolerances;
  Pen pen{{{{0, 0}, {1, 0}, 0.0}, {{0.004, 0}, {0, 1}, 0.0}}, printed};
  const double radius = printed.start_distance * em;
  for (int eighth = 0; eighth < 8; ++eighth) {
    const Point way = towards(eighth * 45.0 * degree);
    CAPTURE(eighth);
    CHECK(pen.down(0.99 * radius * way) == CaptureVerdict::begun);  // another start or not
    CHECK(pen.down(1.01 * radius * way) == CaptureVerdict::undecided);
    CHECK(pen.go(-0.02 * radius * way) == CaptureVerdict::begun);  // by sliding in
  }
}

TEST_CASE("the first stretch of a stroke is 0.04 em long, of a short stroke a quarter", "[render]") {
  const Placement place{{0.01, 0.02}, em};
  for (const double length : {0.5, 0.2, 0.1}) {  // [em]
    const StrokeInput input{1, {{0.2, 0.3}, {0.2 + 0.8 * length, 0.3 + 0.6 * length}}, {}};
    const std::vector<StrokeStart> starts = stroke_starts({make_character(U'\u4E00', std::span(&input, 1)), place}, {});
    REQUIRE(starts.size() == 1);
    CAPTURE(length);
    CHECK(starts[0].point.isApprox(place.to_page({0.2, 0.3})));
    CHECK(starts[0].direction.isApprox((place.to_page({0.8, 0.6}) - place.to_page({0, 0})).normalized()));
    CHECK(starts[0].stretch == Approx(em * std::min(0.04, 0.25 * length)));
  }
}

TEST_CASE("a first stretch that contradicts what follows is judged over what follows", "[render]") {
  const Placement place{{0.01, 0.02}, em};
  const auto start_of = [&](const std::vector<Point>& points) {
    const StrokeInput input{16, points, {}};  // two lines
    return stroke_starts({make_character(U'\u4E00', std::span(&input, 1)), place}, {}).front();
  };
  for (const double length : {0.5, 0.16}) {  // over 0.15 em, over half of the stroke
    const double entry = 0.04, judged = std::min(0.15, 0.5 * (entry + length)) - entry;
    for (const double angle : {-100.0, -75.0, -50.0, 0.0, 50.0, 75.0, 100.0}) {
      CAPTURE(length, angle);
      const Point turn = Point(0.3, 0.5) + entry * towards(angle * degree);
      const StrokeStart start = start_of({{0.3, 0.5}, turn, turn + Point(length, 0.0)});
      const Point there = entry * towards(angle * degree) + Point(judged, 0.0);
      const double off = std::abs(std::atan2(there.y(), there.x()) - angle * degree);
      if (off > 60.0 * degree) {
        CHECK(start.direction.isApprox(there.normalized(), 1e-6));
        CHECK(start.stretch == Approx(em * there.norm()).epsilon(1e-6));
      } else {
        CHECK(start.stretch <= 0.04 * em * (1.0 + 1e-9));
        CHECK(start.direction.dot(towards(angle * degree)) > 0.5);
      }
    }
  }
}

TEST_CASE("deciding what a pen begins does not allocate", "[render]") {
  Pen pen{{alone[0], {{0.004, 0}, {0, 1}, stretch}}, {}};
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 1000; ++i) {
    pen.capture.put_down({1e-5 * i, 0}, pen.starts, 0);
    pen.capture.update({1e-5 * i + 0.002, 0}, pen.starts, 0, em, pen.tolerances);
    pen.capture.written({0, 0}, {0, 0});
  }
  CHECK(calligraphy_test::allocations() == before);
}

TEST_CASE("a pen that goes back to the start begins the stroke from there", "[render]") {
  const Point ahead(0.006, 0), near(0.002, 0);
  Pen pen{alone, {}};
  pen.down(ahead);
  CHECK(pen.go(near - ahead) == CaptureVerdict::undecided);
  CHECK(pen.go({1.01 * stretch, 0}) == CaptureVerdict::begun);
  CHECK((pen.capture.begin() - near).norm() < 1e-9);
}

TEST_CASE("a pen put down at the start of the due stroke may set out with a reverse hook", "[render]") {
  // Another stroke begins 4 mm away and runs the other way.
  Pen pen{{{{0, 0}, {1, 0}, stretch}, {{-0.004, 0.001}, {-1, 0}, stretch}}, {}};
  pen.down({0, 0});
  CHECK(pen.go({-0.0024, 0}) == CaptureVerdict::wrong_direction);
  CHECK(pen.go({0.0045, 0}) == CaptureVerdict::begun);
}

}  // namespace stroke_capture_tests
