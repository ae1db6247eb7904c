// Ink: discs along a path and their outline. Expected values are those of plane geometry.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "../hard_cases.hpp"
#include "character_lists.hpp"

using namespace calligraphy;

namespace {

StrokeInk even_ink(double half_width) {
  StrokeInk ink;
  std::fill_n(ink.half_widths.begin(), 8, half_width);
  return ink;
}

Character character_of(const StrokeInput& stroke) { return make_character(U'永', std::vector{stroke}); }

StrokeInput with_ink(StrokeInput stroke, const StrokeInk& ink) {
  stroke.ink = ink;
  return stroke;
}

/// Heng, 0.8 em long, with this ink.
Character heng(const StrokeInk& ink) { return character_of({1, {{0.1, 0.5}, {0.9, 0.5}}, {}, {}, ink}); }

std::vector<Point> outline_of(const Character& character, double tolerance = 5e-4) {
  return ink_outline(strokes(character)[0], tolerance);
}

/// Positive if counter-clockwise.
double area_of(const std::vector<Point>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& next = polygon[(i + 1) % polygon.size()];
    twice += polygon[i].x() * next.y() - next.x() * polygon[i].y();
  }
  return 0.5 * twice;
}

int winding_number(const std::vector<Point>& polygon, const Point& point) {
  double turned = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i] - point, b = polygon[(i + 1) % polygon.size()] - point;
    turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return static_cast<int>(std::lround(turned / (2.0 * std::numbers::pi)));
}

/// How far the point is outside all discs; negative inside one.
double clearance(const std::vector<InkDisc>& discs, const Point& point) {
  double least = 1e9;
  for (const InkDisc& disc : discs) least = std::min(least, (disc.centre - point).norm() - disc.radius);
  return least;
}

/// A typical stroke with a profile at the limits of what brushes do, or beyond.
StrokeInput wild_stroke(const TypicalStroke& type, calligraphy_test::Sequence& random) {
  StrokeInput stroke{type.id, {}};
  for (const std::array<double, 2>& point : type.shape) stroke.control_points.emplace_back(point[0], point[1]);
  return with_ink(stroke, calligraphy_test::random_ink(type, type.elements, 0.07, 0.03, random));
}

std::string first_problem(const StrokeInk& ink) {
  try {
    heng(ink);
  } catch (const ValueError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a line of one width has the outline of a stadium", "[model][ink]") {
  constexpr double r = 0.05, length = 0.8;
  const std::vector<Point> outline = outline_of(heng(even_ink(r)), 1e-5);
  CHECK(area_of(outline) == Approx(2.0 * r * length + std::numbers::pi * r * r).epsilon(1e-3));
  for (const Point& point : outline) {
    const double x = std::clamp(point.x(), 0.1, 0.9);
    CHECK((point - Point(x, 0.5)).norm() == Approx(r).margin(1e-9));
  }
}

TEST_CASE("a line that is drawn out is longer by that", "[model][ink]") {
  StrokeInk ink = even_ink(0.02);
  ink.start = 0.03;
  ink.end = 0.05;
  const Character character = heng(ink);
  const std::vector<InkDisc> discs = ink_discs(strokes(character)[0]);
  CHECK(discs.front().centre.x() == Approx(0.07));
  CHECK(discs.back().centre.x() == Approx(0.95));
}

TEST_CASE("offsets are to the left of the stroke, half-widths and offsets linear between knots", "[model][ink]") {
  constexpr std::size_t count = 8;
  StrokeInk ink;
  for (std::size_t i = 0; i < count; ++i) {
    ink.half_widths[i] = 0.01 * static_cast<double>(i + 1);
    ink.offsets[i] = 0.002 * static_cast<double>(i);
  }
  const Character character = heng(ink);
  const std::vector<InkDisc> discs = ink_discs(strokes(character)[0], 0.0005);
  const std::vector<double> knots = ink_line(strokes(character)[0]).knots;
  REQUIRE(knots.size() == count);
  CHECK(knots[1] == Approx(0.035));
  CHECK(knots[2] == Approx(0.08));
  CHECK(knots[4] - knots[3] == Approx(knots[3] - knots[2]));
  CHECK(knots[5] == Approx(0.7));
  CHECK(knots[6] == Approx(0.755));
  for (const InkDisc& disc : discs) {
    const double arc = disc.centre.x() - 0.1;
    std::size_t knot = 0;
    while (knot + 2 < count && knots[knot + 1] < arc) ++knot;
    const double between = (arc - knots[knot]) / (knots[knot + 1] - knots[knot]);
    CHECK(disc.radius == Approx(0.01 * (static_cast<double>(knot + 1) + between)));
    CHECK(disc.centre.y() - 0.5 == Approx(0.002 * (static_cast<double>(knot) + between)).margin(1e-12));
  }
}

TEST_CASE("every kind of stroke has as many knots as it should, in order, one on each corner, at any size",
          "[model][ink]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const InkSize size = ink_size(type, type.elements);
    CHECK(size.knots <= max_ink_knots);
    CHECK(size.corners <= max_ink_corners);
    CHECK(size.corners == static_cast<std::size_t>(std::count(type.joints.begin(), type.joints.end(), 'c')));
    for (const double scale : {1e-3, 0.1, 1.0, 10.0}) {
      INFO("typical stroke " << type.id << ", scale " << scale);
      StrokeInput input{type.id, {}};
      for (const auto& point : type.shape) input.control_points.emplace_back(scale * point[0], scale * point[1]);
      const Character character = character_of(with_ink(input, StrokeInk{0.01, 0.02, {}, {}, {}}));
      const Stroke stroke = strokes(character)[0];
      const InkLine line = ink_line(stroke);
      REQUIRE(line.knots.size() == size.knots);
      REQUIRE(line.corners.size() == size.corners);
      CHECK(line.knots.front() == 0.0);
      CHECK(std::adjacent_find(line.knots.begin(), line.knots.end(), std::greater_equal<>()) == line.knots.end());
      std::size_t found = 0;
      for (std::size_t joint = 0; joint < type.joints.size(); ++joint) {
        if (type.joints[joint] != 'c') continue;
        const Point corner = stroke.control_points[static_cast<std::size_t>(feature_points(type.elements)[joint + 1])];
        const auto knot = static_cast<double>(line.corners[found++]);
        const auto at = std::find(line.places.begin(), line.places.end(), knot) - line.places.begin();
        CHECK((line.points[static_cast<std::size_t>(at)] - corner).norm() < 1e-9);
      }
    }
  }
}

TEST_CASE("a shift moves the ink at a corner along the bisected direction, and nothing beyond the next knots",
          "[model][ink]") {
  const StrokeInput heng_zhe{16, {{0.1, 0.8}, {0.8, 0.8}, {0.8, 0.1}}};
  StrokeInk ink;
  std::fill_n(ink.half_widths.begin(), ink_size(typical_stroke(16), "LL").knots, 0.02);
  const Character plain = character_of(with_ink(heng_zhe, ink));
  ink.shifts[0] = 0.05;
  const Character shifted = character_of(with_ink(heng_zhe, ink));
  const std::vector<InkDisc> before = ink_discs(strokes(plain)[0]), after = ink_discs(strokes(shifted)[0]);
  REQUIRE(before.size() == after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double from_corner = (before[i].centre - Point(0.8, 0.8)).norm();
    const double share = std::max(0.0, 1.0 - from_corner / 0.035);
    const Point expected = 0.05 * share * Point(1.0, -1.0).normalized();
    CHECK((after[i].centre - before[i].centre - expected).norm() < 1e-9);
  }
  ink.shifts[0] = 0.5;  // within 0.035 em
  const Character torn = character_of(with_ink(heng_zhe, ink));
  const std::vector<InkDisc> discs = ink_discs(strokes(torn)[0], 0.004);
  for (std::size_t i = 1; i < discs.size(); ++i) CHECK((discs[i].centre - discs[i - 1].centre).norm() <= 0.01);
}

TEST_CASE("the outline of any stroke contains what its discs cover and nothing else", "[model][ink]") {
  constexpr double tolerance = 5e-4;
  constexpr double band = 2e-3;  // discs 1 mm of an em apart leave scallops; inner corners are cut by up to a spacing
  calligraphy_test::Sequence random(34);
  int inside = 0, outside = 0;
  for (const TypicalStroke& type : typical_strokes()) {
    for (int drawn = 0; drawn < 3; ++drawn) {
      const Character character = character_of(wild_stroke(type, random));
      const Stroke stroke = strokes(character)[0];
      const std::vector<InkDisc> discs = ink_discs(stroke, 0.001);
      const std::vector<Point> outline = ink_outline(stroke, tolerance);
      INFO("typical stroke " << type.id);
      for (int i = 0; i < 300; ++i) {
        const double share = random.between(0.0, 0.999);
        const InkDisc& near = discs[static_cast<std::size_t>(share * static_cast<double>(discs.size()))];
        const Point point = near.centre + random.point(-0.1, 0.1);
        const double clear = clearance(discs, point);
        if (std::abs(clear) < band) continue;
        ++(clear < 0.0 ? inside : outside);
        CHECK((winding_number(outline, point) != 0) == (clear < 0.0));
      }
      CHECK(area_of(outline) > 0.0);
      for (const Point& point : outline) CHECK(std::abs(clearance(discs, point)) < 2.0 * band);  // on its edge
    }
  }
  CHECK(inside > 8'000);
  CHECK(outside > 8'000);
}

TEST_CASE("the outline of a brush stroke that does not cross itself does not cross itself either", "[model][ink]") {
  const auto side = [](const Point& a, const Point& b, const Point& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()) > 0.0;
  };
  for (const char32_t code : {U'一', U'永', U'国', U'北', U'年'}) {
    const Character character = with_typical_ink(built_in_characters().at(code));
    for (const Stroke& stroke : strokes(character)) {
      const std::vector<Point> outline = ink_outline(stroke);
      const std::size_t count = outline.size();
      int crossings = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Point &a = outline[i], &b = outline[(i + 1) % count];
        for (std::size_t k = i + 2; k < count - (i == 0 ? 1 : 0); ++k) {
          const Point &c = outline[k], &d = outline[(k + 1) % count];
          if (side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)) ++crossings;
        }
      }
      INFO("typical stroke " << stroke.type->id);
      CHECK(crossings == 0);
    }
  }
}

TEST_CASE("a coarser outline has fewer points and the same area, nearly", "[model][ink]") {
  calligraphy_test::Sequence random(5);
  const Character character = character_of(wild_stroke(typical_stroke(20), random));
  const std::vector<Point> fine = outline_of(character, 1e-4), coarse = outline_of(character, 4e-3);
  CHECK(coarse.size() < fine.size() / 2);
  CHECK(area_of(coarse) == Approx(area_of(fine)).epsilon(0.05));
}

TEST_CASE("a stroke that is a point has the ink of a disc", "[model][ink]") {
  const Character dot = character_of({8, {{0.5, 0.5}, {0.5, 0.5}}, {}, {}, even_ink(0.1)});
  CHECK(area_of(outline_of(dot, 1e-5)) == Approx(std::numbers::pi * 0.01).epsilon(1e-3));
}

TEST_CASE("a tapered tip ends in a point", "[model][ink]") {
  StrokeInk ink = even_ink(0.03);
  ink.half_widths[7] = 0.0;
  const std::vector<Point> outline = outline_of(heng(ink));
  const auto is_left = [](const Point& a, const Point& b) { return a.x() < b.x(); };
  const auto tip = std::max_element(outline.begin(), outline.end(), is_left);
  CHECK((*tip - Point(0.9, 0.5)).norm() < 1e-9);
}

TEST_CASE("the polyline of a stroke lies within its tolerance of the curves, cubic and quartic", "[model][ink]") {
  const Character& cubic = *built_in_characters().find(U'永');
  const Character quartic = with_quartic_curves(cubic);
  for (std::size_t i = 0; i < strokes(cubic).size(); ++i) {
    const std::vector<Point> fine = stroke_polyline(strokes(cubic)[i], 1e-6);
    const std::vector<Point> coarse = stroke_polyline(strokes(quartic)[i], 1e-3);
    CHECK(coarse.size() <= fine.size());
    CHECK((coarse.front() - fine.front()).norm() < 1e-12);
    CHECK((coarse.back() - fine.back()).norm() < 1e-12);
    for (const Point& point : fine) {
      double nearest = 1e9;
      for (std::size_t k = 1; k < coarse.size(); ++k) {
        const Point along = coarse[k] - coarse[k - 1];
        const double share = std::clamp((point - coarse[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (point - coarse[k - 1] - share * along).norm());
      }
      CHECK(nearest <= 1e-3 + 1e-6);
    }
  }
}

TEST_CASE("ink outside its domain is refused by name and value", "[model][ink]") {
  StrokeInk ink = even_ink(0.02);
  CHECK(first_problem(ink).empty());
  ink.half_widths[3] = -0.01;
  CHECK(first_problem(ink) == "stroke 1: half-width of ink -0.01 em is not within 0 and 1");
  ink.half_widths[3] = std::nan("");
  CHECK(first_problem(ink).starts_with("stroke 1: half-width of ink nan em"));
  ink = even_ink(0.02);
  ink.offsets[0] = 1.5;
  CHECK(first_problem(ink) == "stroke 1: offset of ink 1.5 em is not within -1 and 1");
  ink = even_ink(0.02);
  ink.end = -1.0;
  CHECK(first_problem(ink) == "stroke 1: end of ink -1 em is not within 0 and 1");
  ink = even_ink(0.02);
  ink.shifts[0] = 0.01;
  CHECK(first_problem(ink) == "stroke 1: shift of ink 0.01 em follows the last of 0, which this stroke has");
}

TEST_CASE("all strokes of a character have ink or none has", "[model][ink]") {
  const StrokeInput with = with_ink({1, {{0.1, 0.5}, {0.9, 0.5}}}, even_ink(0.02));
  const StrokeInput without{2, {{0.5, 0.9}, {0.5, 0.1}}};
  CHECK_THROWS_WITH(make_character(U'十', std::vector{with, without}), "stroke 2: has no ink, unlike stroke 1");
  CHECK_THROWS_WITH(make_character(U'十', std::vector{without, with}), "stroke 2: has ink, unlike stroke 1");
  Character character = make_character(U'十', std::vector{with, with});
  character.physics.ink.pop_back();
  CHECK(validate(character).at(0).what == "2 strokes have the ink of 1");
  const Character bare = make_character(U'十', std::vector{without});
  CHECK_THROWS_AS(ink_outline(strokes(bare)[0]), ValueError);
}

TEST_CASE("ink survives the change to quartic curves and back to input", "[model][ink]") {
  const Character character = heng(even_ink(0.02));
  CHECK(with_quartic_curves(character).physics.ink == character.physics.ink);
  CHECK(input_of(strokes(character)[0]).ink == character.physics.ink[0]);
}

TEST_CASE("every kind of stroke has valid typical ink, wider where it is longer, thinner among others", "[model][ink]") {
  for (const TypicalStroke& type : typical_strokes()) {
    INFO("typical stroke " << type.id);
    const double usual = typical_half_width(type.id, 8, 0.5);
    CHECK(usual > 0.01);
    CHECK(usual < 0.04);
    CHECK(typical_half_width(type.id, 8, 0.7) > usual);
    CHECK(typical_half_width(type.id, 16, 0.5) < usual);
    StrokeInput stroke{type.id, {}};
    for (const std::array<double, 2>& point : type.shape) stroke.control_points.emplace_back(point[0], point[1]);
    const Character inked = with_typical_ink(character_of(stroke));
    CHECK(validate(inked).empty());
    REQUIRE(inked.physics.ink.size() == 1);
    CHECK(area_of(outline_of(inked)) > 0.0);
  }
  CHECK_THROWS_AS(typical_ink(0, 0.02), ValueError);
  CHECK_THROWS_AS(typical_half_width(1, 0, 0.5), ValueError);
}

TEST_CASE("typical ink is what calligraphers write: a na is widest near its end, a pie near its start", "[model][ink]") {
  const auto widest = [](int id) {
    const StrokeInk ink = typical_ink(id, 1.0);
    return std::max_element(ink.half_widths.begin(), ink.half_widths.end()) - ink.half_widths.begin();
  };
  CHECK(widest(6) >= 4);
  CHECK(widest(4) == 1);
  CHECK(typical_ink(4, 1.0).half_widths[7] < 0.5);
}

TEST_CASE("typical ink replaces none of a character's own", "[model][ink]") {
  const Character own = heng(even_ink(0.02));
  CHECK(with_typical_ink(own).physics.ink == own.physics.ink);
  const Character dot = with_typical_ink(character_of({8, {{0.5, 0.5}, {0.5, 0.5}}}));
  CHECK(validate(dot).empty());
}
