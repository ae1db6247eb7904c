// The stack of feature points: Wang 2006, sec. 4.3 and 4.3.3.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"
#include "../pen_path.hpp"
#include "../reference_curve.hpp"

using namespace calligraphy;
using calligraphy_test::beside;
using calligraphy_test::draw_line;
using calligraphy_test::hard_curves;
using calligraphy_test::HardCurve;
using calligraphy_test::path_of;
using calligraphy_test::ReferenceCurve;
using calligraphy_test::size_of;
using calligraphy_test::typical_character;

namespace {

const Placement place{{0.013, 0.021}, 0.04};
constexpr double pen_step = 0.0001;  // 100 mm/s at 1 kHz

const StrokeOptions as_printed = {.rules = Rules::wang2006};

struct Trace {
  int passed = 0;
  bool finished = false;
  int falls = 0;          ///< updates in which the index of the active element decreased
  double max_step = 0.0;  ///< maximum change of the closest point's arc length, except at feature points [m]
};

Trace trace(ActiveStroke& active, const std::vector<Point>& path, const StrokeOptions& options = {}) {
  Trace result;
  StrokeContact last;
  for (std::size_t i = 0; i < path.size() && !result.finished; ++i) {
    const StrokeContact contact = active.update(path[i], options);
    result.passed += contact.passed_feature;
    result.falls += contact.element < last.element;
    if (i > 0 && !contact.passed_feature) result.max_step = std::max(result.max_step, std::abs(contact.arc - last.arc));
    result.finished = contact.finished;
    last = contact;
  }
  return result;
}

}  // namespace

TEST_CASE("a pen that traces a typical stroke passes each feature point once, in order, and finishes", "[collision]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const Character character = typical_character(type.id);
    const Stroke stroke = strokes(character)[0];
    ActiveStroke active;
    active.load(stroke, place);
    const Trace result = trace(active, path_of(stroke, place, pen_step));
    INFO("typical stroke " << type.id);
    CHECK(result.passed == static_cast<int>(type.elements.size()));
    CHECK(result.finished);
    CHECK(result.falls == 0);
    CHECK(result.max_step < 3.0 * pen_step);
  }
}

TEST_CASE("a pen 2 mm off a typical stroke passes each feature point too", "[collision]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const Character character = typical_character(type.id);
    const Stroke stroke = strokes(character)[0];
    for (const double offset : {-0.002, -0.001, 0.001, 0.002}) {
      ActiveStroke active;
      active.load(stroke, place);
      const Trace result = trace(active, beside(path_of(stroke, place, pen_step), offset));
      INFO("typical stroke " << type.id << ", " << offset << " m to the left");
      CHECK(result.passed == static_cast<int>(type.elements.size()));
      CHECK(result.finished);
      CHECK(result.falls == 0);
    }
  }
}

TEST_CASE("a typical stroke traced backwards from near its start never finishes", "[collision]") {
  for (const TypicalStroke& type : typical_strokes()) {
    if (type.id == 39) continue;  // a circle ends where it starts
    const Character character = typical_character(type.id);
    const Stroke stroke = strokes(character)[0];
    std::vector<Point> path = path_of(stroke, place, pen_step);
    std::reverse(path.begin(), path.end());
    ActiveStroke active;
    active.load(stroke, place);
    INFO("typical stroke " << type.id);
    const auto near_start = std::find_if(path.begin(), path.end(), [&](const Point& tip) {
      return (tip - active.start()).norm() <= std::min(0.2 * place.em, 0.5 * (active.end() - active.start()).norm());
    });
    REQUIRE(near_start != path.end());
    active.begin(*near_start);
    CHECK_FALSE(trace(active, {near_start, path.end()}).finished);
  }
}

TEST_CASE("a reloaded stroke starts again, with all of its feature points", "[collision]") {
  const Character character = typical_character(18);
  const Stroke stroke = strokes(character)[0];
  const std::vector<Point> path = path_of(stroke, place, pen_step);
  ActiveStroke active;
  active.load(stroke, place);
  CHECK(trace(active, {path.begin(), path.begin() + static_cast<std::ptrdiff_t>(path.size() / 2)}).passed == 1);
  active.reload();
  const StrokeContact contact = active.update(active.start(), {});
  CHECK(contact.element == 0);
  CHECK(contact.arc == Approx(0.0).margin(1e-12));
  CHECK(contact.backwards == 0.0);
  CHECK(trace(active, path).passed == 3);
  active.load(stroke, place);
  CHECK(trace(active, path).passed == 3);
}

TEST_CASE("a pen far from a feature point passes its plane only as printed", "[collision]") {
  const Character character = typical_character(16);
  const Stroke stroke = strokes(character)[0];
  ActiveStroke active;
  active.load(stroke, place);
  const Point corner = place.to_page(stroke.control_points[1]);
  const Point beyond = corner + 0.5 * (corner - active.start()) + Point(0.0, 0.02);
  CHECK_FALSE(active.update(beyond, {}).passed_feature);
  CHECK(active.update(beyond, as_printed).passed_feature);
  // As printed, a pen that jumps back and forth across the planes finishes a stroke that it never touched.
  active.reload();
  CHECK(active.update(beyond, as_printed).passed_feature);
  CHECK(active.update(place.to_page(stroke.control_points[2]) + Point(0.05, -0.03), as_printed).finished);
}

TEST_CASE("a finished stroke keeps its closest point where the pen is", "[collision]") {
  const Character character = typical_character(16);
  const Stroke stroke = strokes(character)[0];
  const std::vector<Point> path = path_of(stroke, place, pen_step);
  ActiveStroke active;
  active.load(stroke, place);
  CHECK(trace(active, path).finished);
  const StrokeContact after = active.update(path.back(), {});
  CHECK(after.finished);
  CHECK_FALSE(after.passed_feature);
  CHECK((after.closest.point - path.back()).norm() < 1e-9);
}

TEST_CASE("crossing a feature plane back and forth passes one feature point", "[collision]") {
  const Character character = typical_character(16);
  const Stroke stroke = strokes(character)[0];
  ActiveStroke active;
  active.load(stroke, place);
  trace(active, path_of(stroke, place, pen_step));
  active.reload();
  std::vector<Point> path = {active.start()};
  const Point corner = place.to_page(stroke.control_points[1]);
  calligraphy_test::draw_line(path, corner, pen_step);
  int passed = trace(active, path).passed;
  const Point along = (corner - active.start()).normalized();
  for (int i = 0; i < 1000; ++i)
    passed += active.update(corner + (i % 2 ? 0.0001 : -0.0001) * along, {}).passed_feature;
  CHECK(passed == 1);
}

TEST_CASE("a pen that is put down anywhere on a stroke is found there, and followed from there", "[collision]") {
  const Character character = typical_character(18);
  const Stroke stroke = strokes(character)[0];
  const std::vector<Point> path = path_of(stroke, place, pen_step);
  ActiveStroke active;
  active.load(stroke, place);
  double way = 0.0, worst = 0.0, worst_back = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    way += (path[i] - path[i - 1]).norm();
    const StrokeContact found = active.nearest(path[i], {});
    worst = std::max({worst, std::abs(found.arc - way), found.closest.distance});
    CHECK(active.update(active.start(), {}).element == 0);  // it has no effect on the progress
    active.rest(found);
    const StrokeContact rested = active.update(path[i], {});
    worst_back = std::max(worst_back, rested.backwards);
    // Unless it is so near to the end of an element that it counts as past it.
    if (i >= 20 && !rested.passed_feature && found.element == active.nearest(path[i - 10], {}).element) {
      CHECK(active.update(path[i - 10], {}).backwards == Approx(10.0 * pen_step).epsilon(0.2));
    }
    active.reload();
  }
  CHECK(worst < 1e-4 * active.length());  // of the arc length on curves
  CHECK(worst_back < 1e-9);
}

TEST_CASE("the point at an arc length is as far along the polyline of a stroke", "[collision]") {
  for (const HardCurve& hard : hard_curves()) {
    const std::size_t count = hard.control_points.size();
    const double size = size_of(hard.control_points);
    if (count < 4 || size == 0.0) continue;
    // Between two lines, so that elements before and after count too.
    std::vector<Point> points = hard.control_points;
    points.insert(points.begin(), points.front() - Point(size, 0.0));
    points.push_back(points.back() + Point(0.0, size));
    const std::vector<double> factors(4, 1.0);
    ActiveStroke active;
    active.load({&typical_stroke(1), "LCL", static_cast<int>(count) - 1, points, factors}, {Point::Zero(), 1.0});

    const ReferenceCurve curve(hard.control_points);
    std::vector<Point> path = {points.front()};
    draw_line(path, points[1], 0.01 * size);
    for (int i = 1; i <= 2000; ++i) {
      const auto at = curve.point(i / 2000.0L);
      path.emplace_back(static_cast<double>(at[0]), static_cast<double>(at[1]));
    }
    draw_line(path, points.back(), 0.01 * size);
    double way = 0.0, worst = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      way += (path[i] - path[i - 1]).norm();
      worst = std::max(worst, (active.at(way).point - path[i]).norm());
    }
    INFO(hard.name << ": " << worst / size);
    CHECK(worst < 3e-3 * size);  // of the arc length of an element
  }
}

TEST_CASE("where the pen is nearest, the stroke has the tangent and the curvature of the contact", "[collision]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const Character character = typical_character(type.id);
    const Stroke stroke = strokes(character)[0];
    ActiveStroke active;
    active.load(stroke, place);
    double off = 0.0, turned = 0.0, bent = 0.0;
    for (const Point& tip : path_of(stroke, place, pen_step)) {
      const StrokeContact contact = active.nearest(tip, {});
      const double t = contact.closest.parameter;
      if (t < 1e-9 || t > 1.0 - 1e-9) continue;  // rounding decides on which side of a corner
      const StrokePlace there = active.at(contact.arc);
      const double curvature = active.element(contact.element).curvature(t);
      off = std::max(off, (there.point - contact.closest.point).norm());
      turned = std::max(turned, (there.tangent - contact.closest.tangent).norm());
      bent = std::max(bent, std::abs(there.curvature - curvature));
    }
    INFO("typical stroke " << type.id);
    CHECK(off < 1e-12);
    CHECK(turned < 1e-9);
    CHECK(bent < 1e-6);
  }
}

TEST_CASE("a place on a stroke is clamped to its ends, and at a corner still before it", "[collision]") {
  const Character character = typical_character(16);
  const Stroke stroke = strokes(character)[0];
  ActiveStroke active;
  active.load(stroke, place);
  const Point corner = place.to_page(stroke.control_points[1]);
  const Point before = (corner - active.start()).normalized(), after = (active.end() - corner).normalized();
  const double to_corner = active.element(0).length();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t allocations = calligraphy_test::allocations();
  for (const double arc : {-infinity, -1.0, 0.0, std::nan("")}) CHECK(active.at(arc).point == active.start());
  for (const double arc : {1.0, infinity}) CHECK((active.at(arc).point - active.end()).norm() < 1e-15);
  CHECK((active.at(to_corner).point - corner).norm() < 1e-15);
  CHECK((active.at(to_corner).tangent - before).norm() < 1e-12);
  CHECK((active.at(std::nextafter(to_corner, 1.0)).tangent - after).norm() < 1e-12);
  CHECK(active.at(to_corner).curvature == 0.0);
  CHECK(calligraphy_test::allocations() == allocations);
}

TEST_CASE("the attraction factor is linear in arc length, and as printed it steps at each feature point",
          "[collision]") {
  const Character character = typical_character(16, {1.0, 2.0, 0.5});
  const Stroke stroke = strokes(character)[0];
  const std::vector<Point> path = path_of(stroke, place, pen_step);
  const double first = (path.front() - place.to_page(stroke.control_points[1])).norm();
  const double second = (place.to_page(stroke.control_points[1]) - path.back()).norm();
  ActiveStroke active, printed;
  active.load(stroke, place);
  printed.load(stroke, place);
  double worst = 0.0, last = 1.0, max_step = 0.0;
  for (const Point& tip : path) {
    const StrokeContact contact = active.update(tip, {}), step = printed.update(tip, as_printed);
    const double expected =
        contact.arc <= first ? 1.0 + contact.arc / first : 2.0 - 1.5 * (contact.arc - first) / second;
    worst = std::max(worst, std::abs(contact.attraction - expected));
    if (!step.finished) CHECK(step.attraction == (step.element == 0 ? 1.0 : 2.0));
    if (!contact.passed_feature) max_step = std::max(max_step, std::abs(contact.attraction - last));
    last = contact.attraction;
  }
  CHECK(worst < 1e-9);
  CHECK(max_step < 2.0 * pen_step / first);
}

TEST_CASE("a pen that moves back along the stroke is reported to be behind by that arc length", "[collision]") {
  const Character character = typical_character(1);
  const Stroke stroke = strokes(character)[0];
  const std::vector<Point> path = path_of(stroke, place, pen_step);
  ActiveStroke active;
  active.load(stroke, place);
  trace(active, {path.begin(), path.begin() + 200});
  const StrokeContact back = active.update(path[150], {});
  CHECK(back.backwards == Approx((path[199] - path[150]).norm()).epsilon(1e-6));
  CHECK(active.update(path[210], {}).backwards == 0.0);
}

TEST_CASE("writing a stroke does not allocate", "[collision]") {
  const Character character = typical_character(27);
  const Stroke stroke = strokes(character)[0];
  const std::vector<Point> path = path_of(stroke, place, pen_step);
  ActiveStroke active;
  active.load(stroke, place);
  const std::size_t before = calligraphy_test::allocations();
  active.begin(active.start());
  const Trace result = trace(active, path);
  CHECK(calligraphy_test::allocations() == before);
  CHECK(result.finished);
}

TEST_CASE("a pen that leaves a stroke at its start and returns at its end does not finish it", "[collision]") {
  const Character* one = built_in_characters().find(U'一');
  REQUIRE(one != nullptr);
  const Placement em_40_mm{Point::Zero(), 0.04};
  const Stroke heng = strokes(*one).front();
  const Point begin = em_40_mm.to_page(heng.control_points[0]), end = em_40_mm.to_page(heng.control_points[1]);
  const Point aside = 0.015 * Point(begin.y() - end.y(), end.x() - begin.x()).normalized();
  ActiveStroke active;
  active.load(heng, em_40_mm);
  const Point corners[] = {begin, begin + aside, end + aside, end + 0.002 * (end - begin).normalized()};
  for (int leg = 0; leg < 3; ++leg) {
    for (int i = 0; i <= 300; ++i) {
      const Point tip = corners[leg] + (i / 300.0) * (corners[leg + 1] - corners[leg]);
      REQUIRE_FALSE(active.update(tip, {}).passed_feature);
    }
  }
}
