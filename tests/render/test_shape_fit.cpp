// What the whole of a written path tells of the stroke, and what is made of it.
#include "../catch.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "render/shape_fit.hpp"
#include "render/stroke_verdict.hpp"
#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"
#include "../pen_path.hpp"

namespace shape_fit_tests {

using namespace calligraphy;

namespace {

constexpr double em = 0.04;  // [m]
const Placement place{{0.013, 0.021}, em};
const StrokeTolerances normal;

StrokeShape shape_through(int type, const std::vector<Point>& points) {
  const StrokeInput input{type, points, {}};
  ActiveStroke active;
  active.load(strokes(make_character(U'\u4E00', std::span(&input, 1)))[0], place);
  return shape_of(active, em);
}

/// Half an em to the right and half an em down.
StrokeShape corner() { return shape_through(16, {{0.2, 0.8}, {0.7, 0.8}, {0.7, 0.3}}); }
StrokeShape line(double length) { return shape_through(1, {{0.1, 0.5}, {0.1 + length, 0.5}}); }

ShapeMatch fit(const StrokeShape& shape, const std::vector<Point>& path, double hidden = 0.0) {
  WrittenPath written;
  written.begin(path.front(), em, hidden);
  for (const Point& tip : path) written.update(tip);
  ShapeFit fit;
  fit.begin(written, shape, Point::Zero());
  int steps = 0;
  while (!fit.step()) ++steps;
  CHECK(steps < ShapeFit::max_steps);
  return fit.match();
}

/// Straight from point to point [em, from the stroke's start] in steps of 0.1 mm.
std::vector<Point> way(const StrokeShape& shape, const std::vector<Point>& points) {
  std::vector<Point> path = {shape.origin + em * points.front()};
  for (const Point& point : points) calligraphy_test::draw_line(path, shape.origin + em * point, 1e-4);
  return path;
}

StrokeVerdict verdict_on_share(double length, double from, double to, const StrokeTolerances& tolerances = normal) {
  const StrokeShape shape = line(length);
  return verdict_on(fit(shape, way(shape, {{from * length, 0.0}, {to * length, 0.0}})), shape, 0.0, tolerances);
}

}  // namespace

TEST_CASE("a corner in another size, slant and place is that corner", "[render]") {
  const StrokeShape shape = corner();
  const ShapeMatch same = fit(shape, way(shape, {{0, 0}, {0.5, 0}, {0.5, -0.5}}));
  CHECK(same.misfit == Approx(0.0).margin(2e-3));
  CHECK(same.extent == Approx(1.0).margin(0.01));
  CHECK(same.roughness == Approx(1.0).margin(0.02));
  // By 0.8 to the right, 1.1 down, and a third of the way down slanted to the right: the map by its singular values.
  const ShapeMatch other = fit(shape, way(shape, {{0.02, 0.01}, {0.42, 0.01}, {0.57, -0.54}}));
  const double a = 0.8, b = -0.3, d = 1.1;  // [a b; 0 d]
  const double trace = a * a + b * b + d * d, product = a * d;
  const double least = std::sqrt(0.5 * (trace - std::sqrt(trace * trace - 4.0 * product * product)));
  CHECK(other.misfit < 0.02);  // the nodes are 0.03 em apart
  CHECK(other.narrowest == Approx(least).margin(0.05));
  CHECK(other.late == Approx(0.02).margin(1e-3));
  CHECK(other.early == Approx(-0.04).margin(1e-3));  // beyond the end
  CHECK(other.end == Approx(std::hypot(0.07, 0.04)).margin(1e-3));
  CHECK(verdict_on(other, shape, 0.0, normal) == StrokeVerdict::finished);
}

TEST_CASE("a tremor, loops, waves and a chord are other shapes, however near to the stroke", "[render]") {
  const StrokeShape shape = line(0.4), bent = corner();
  const auto about = [&](double amplitude, double wavelength, double loops) {
    std::vector<Point> points;
    for (int i = 0; i <= 2000; ++i) {
      const double along = 0.4 * i / 2000.0, angle = 2.0 * std::numbers::pi * along / wavelength;
      points.emplace_back(along + loops * amplitude * (std::cos(angle) - 1.0), amplitude * std::sin(angle));
    }
    return is_vetoed(fit(shape, way(shape, points)), shape, normal);
  };
  CHECK_FALSE(about(0.005, 0.05, 0.0));
  CHECK_FALSE(about(0.02, 0.4, 0.0));
  CHECK(about(0.03, 0.05, 0.0));
  CHECK(about(0.07, 0.2, 0.0));
  CHECK(about(0.03, 0.08, 1.0));
  CHECK_FALSE(is_vetoed(fit(bent, way(bent, {{0, 0}, {0.5, 0}, {0.5, -0.5}})), bent, normal));
  const ShapeMatch chord = fit(bent, way(bent, {{0, 0}, {0.5, -0.5}}));
  CHECK(is_vetoed(chord, bent, normal));
  CHECK(verdict_on(chord, bent, 0.0, normal) == StrokeVerdict::refused);
}

TEST_CASE("a pen that guidance pulls to the stroke writes no wave, and one that sticks and slips does not tremble",
          "[render]") {
  const StrokeShape shape = line(0.4), dot = line(0.1);
  const ShapeMatch pulled = fit(shape, way(shape, {{0.0, 0.16}, {0.09, 0.0}, {0.4, 0.0}}));
  CHECK(pulled.misfit > 0.029);
  CHECK_FALSE(is_vetoed(pulled, shape, normal));
  std::vector<Point> jerks;
  for (int i = 0; i <= 20; ++i) jerks.emplace_back(0.005 * i, i % 2 == 0 ? 0.006 : -0.006);
  CHECK(is_vetoed(fit(dot, way(dot, jerks)), dot, normal));
  CHECK_FALSE(is_vetoed(fit(dot, way(dot, jerks), 0.03 * em), dot, normal));
}

TEST_CASE("a long line through a dot is not the dot", "[render]") {
  const StrokeShape dot = line(0.1);
  const auto is_dot = [&](double to) { return !is_vetoed(fit(dot, way(dot, {{0.0, 0.0}, {to, 0.0}})), dot, normal); };
  CHECK(is_dot(0.1));
  CHECK(is_dot(0.3));
  CHECK_FALSE(is_dot(0.4));
}

TEST_CASE("short at both ends it is finished from the least share on, at one end in doubt, and refused below",
          "[render]") {
  using enum StrokeVerdict;
  CHECK(verdict_on_share(0.4, 0.0, 1.0) == finished);
  CHECK(verdict_on_share(0.4, 0.14, 0.86) == finished);   // 0.056 em at either end
  CHECK(verdict_on_share(0.4, 0.0, 0.77) == plausible);   // 0.092 em at one end
  CHECK(verdict_on_share(0.4, 0.23, 1.0) == plausible);
  CHECK(verdict_on_share(0.4, 0.0, 0.59) == refused);     // 0.67 - 0.05
  CHECK(verdict_on_share(0.8, 0.0, 0.88) == finished);
  CHECK(verdict_on_share(0.8, 0.0, 0.8) == plausible);
  CHECK(verdict_on_share(0.12, 0.0, 0.5) == refused);
  CHECK(verdict_on_share(0.4, 1.0, 0.0) == refused);
  CHECK(verdict_on_share(0.4, 0.0, 0.77, StrokeTolerances::strict()) == refused);
  CHECK(verdict_on_share(0.4, 0.0, 0.77, StrokeTolerances::lenient()) == finished);
}

TEST_CASE("friction hides a part of the way, but never half of the stroke", "[render]") {
  const StrokeShape shape = line(0.3);
  const auto verdict = [&](double share) {
    return verdict_on(fit(shape, way(shape, {{0.0, 0.0}, {0.3 * share, 0.0}})), shape, 0.1, normal);
  };
  CHECK(verdict(0.6) == StrokeVerdict::finished);
  CHECK(verdict(0.5) == StrokeVerdict::refused);
}

TEST_CASE("a path of any length is fitted, in few steps, and nothing is allocated", "[render]") {
  const StrokeShape shape = corner();
  for (const double length : {0.0, 1e-9, 0.01, 0.5, 5.0, 500.0}) {
    WrittenPath written;
    ShapeFit fit;
    const std::size_t before = calligraphy_test::allocations();
    written.begin(shape.origin, em, 0.0);
    for (int i = 0; i <= 3000; ++i) {
      const double turn = 0.01 * i;
      written.update(shape.origin + em * length * i / 3000 * Point(std::cos(turn), std::sin(turn)));
    }
    fit.begin(written, shape, Point::Zero());
    int steps = 1;
    while (!fit.step()) ++steps;
    const bool has_allocated = calligraphy_test::allocations() != before;
    CAPTURE(length);
    CHECK_FALSE(has_allocated);
    CHECK(steps <= ShapeFit::max_steps);
    CHECK(std::isfinite(fit.match().misfit));
    CHECK(std::isfinite(fit.match().roughness));
    CHECK(verdict_on(fit.match(), shape, 0.0, normal) == StrokeVerdict::refused);
  }
}

}  // namespace shape_fit_tests
