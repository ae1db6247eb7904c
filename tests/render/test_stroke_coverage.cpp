// How much of a stroke has been written, in order and near enough.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <calligraphy/render/detail/stroke_coverage.hpp>
#include <calligraphy/render/stroke_tolerances.hpp>

#include "../pen_path.hpp"

namespace stroke_coverage_tests {

using namespace calligraphy;
using calligraphy_test::draw_line;
using calligraphy_test::path_of;

namespace {

const Placement place{{0.013, 0.021}, 0.04};
const double corridor = StrokeTolerances().corridor * place.em;  // 2.4 mm
constexpr double step = 1e-4;

/// A stroke of straight lines through points in em.
Character line_through(int type, const std::vector<Point>& points) {
  const StrokeInput input{type, points, {}};
  return make_character(U'\u4E00', std::span(&input, 1));
}

/// 30 mm to the right.
const Character line = line_through(1, {{0.1, 0.5}, {0.85, 0.5}});
const Point start = place.to_page({0.1, 0.5});
constexpr double length = 0.03;
Point on_line(double along, double up) { return start + Point(along, up); }

/// 20 mm to the right and 20 mm down.
const Character corner = line_through(16, {{0.2, 0.8}, {0.7, 0.8}, {0.7, 0.3}});
const Point corner_start = place.to_page({0.2, 0.8});
constexpr double leg = 0.02;

struct Written {
  double share;
  bool keeps;  ///< in the corridor
  double late;
};

/// A pen that begins the stroke with the first point of `path`, whatever its direction.
Written write(const Character& character, const std::vector<Point>& path) {
  const Stroke stroke = strokes(character)[0];
  ActiveStroke active;
  active.load(stroke, place);
  active.begin(path.front());
  StrokeCoverage coverage;
  coverage.restart(path.front(), stroke_starts({character, place}, {}).front());
  for (const Point& tip : path) coverage.update(tip, active.update(tip, {}), active.length(), corridor);
  return {coverage.share(active.length()), coverage.keeps_in_corridor(), coverage.late()};
}

std::vector<Point> through(const std::vector<Point>& points) {
  std::vector<Point> path = {points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) draw_line(path, points[i], step);
  return path;
}

std::vector<Point> shifted(std::vector<Point> path, const Point& shift) {
  for (Point& point : path) point += shift;
  return path;
}

}  // namespace

TEST_CASE("a typical stroke that is traced is covered entirely, half of it by half", "[render]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const Character character = calligraphy_test::typical_character(type.id);
    std::vector<Point> path = path_of(strokes(character)[0], place, step);
    INFO("typical stroke " << type.id);
    const Written whole = write(character, path);
    CHECK(whole.share > 0.98);
    CHECK(whole.keeps);
    CHECK(whole.late == 0.0);
    double way = 0.0, total = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) total += (path[i] - path[i - 1]).norm();
    std::size_t half = 1;
    while ((way += (path[half] - path[half - 1]).norm()) < 0.5 * total) ++half;
    path.resize(half + 1);
    // Near a corner the pen may already be on the next element, by the tolerance of a feature plane.
    CHECK(write(character, path).share == Approx(0.5).margin(0.01 + 2.0 * 0.0375 * place.em / total));
  }
}

TEST_CASE("a line begun beyond its start or before it is covered when it is as long as it should be", "[render]") {
  for (const double along : {-0.006, -0.003, 0.003, 0.006}) {
    CAPTURE(along);
    const Written whole = write(line, through({on_line(along, 0), on_line(along + length, 0)}));
    CHECK(whole.share == Approx(1.0).margin(1e-6));
    CHECK(whole.late == Approx(std::max(0.0, along)));
    CHECK(write(line, through({on_line(along, 0), on_line(along + 0.5 * length, 0)})).share ==
          Approx(0.5).margin(1e-6));
  }
  // What is left of it after a late start is not all of it.
  CHECK(write(line, through({on_line(0.006, 0), on_line(length, 0)})).share == Approx(0.8).margin(1e-6));
}

TEST_CASE("the corridor is measured from the stroke, or as far beside it as the pen began", "[render]") {
  for (const double side : {-1.0, 1.0}) {
    for (const double beside : {0.0, 0.004}) {
      // For the first millimetre the pen is where it began.
      const auto share = [&](double up) {
        return write(line, through({on_line(0, side * beside), on_line(0.001, side * beside), on_line(0.001, side * up),
                                    on_line(length, side * up)}))
            .share;
      };
      CAPTURE(side, beside);
      CHECK(share(beside) == Approx(1.0).margin(1e-6));
      CHECK(share(beside + 0.95 * corridor) == Approx(1.0).margin(1e-6));
      CHECK(share(beside + 1.05 * corridor) == Approx(0.001 / length).margin(1e-6));
      CHECK(share(-0.95 * corridor) == Approx(1.0).margin(1e-6));  // beyond the stroke
      CHECK(share(-1.05 * corridor) == Approx(0.001 / length).margin(1e-6));
    }
  }
}

TEST_CASE("an offset that the pen has given up is not tolerated again", "[render]") {
  const double third = length / 3.0;
  const auto share = [&](double kept) {
    return write(line, through({on_line(0, 0.004), on_line(third, 0.004), on_line(third, kept),
                                on_line(2 * third, kept), on_line(2 * third, 0.004), on_line(length, 0.004)}))
        .share;
  };
  CHECK(share(0.002) == Approx(1.0).margin(1e-6));      // 2 mm off what is left of it
  CHECK(share(0.0) == Approx(2.0 / 3.0).margin(1e-6));  // 4 mm
}

TEST_CASE("a shift within the corridor in any direction does not count against a stroke with a corner", "[render]") {
  const std::vector<Point> path =
      through({corner_start, corner_start + Point(leg, 0), corner_start + Point(leg, -leg)});
  for (int eighth = 0; eighth < 8; ++eighth) {
    const double angle = eighth * std::numbers::pi / 4.0;
    CAPTURE(eighth);
    const Written whole = write(corner, shifted(path, 0.002 * Point(std::cos(angle), std::sin(angle))));
    CHECK(whole.share > 0.97);
    CHECK(whole.keeps);
  }
}

TEST_CASE("a rounded corner is covered, one that is cut off is not", "[render]") {
  std::vector<Point> rounded = {corner_start};
  constexpr double radius = 0.003;  // at most 1.2 mm from the corner
  const Point middle = corner_start + Point(leg - radius, -radius);
  draw_line(rounded, middle + Point(0, radius), step);
  for (int i = 0; i <= 90; ++i) {
    const double angle = (90 - i) * std::numbers::pi / 180.0;
    draw_line(rounded, middle + radius * Point(std::cos(angle), std::sin(angle)), step);
  }
  draw_line(rounded, corner_start + Point(leg, -leg), step);
  CHECK(write(corner, rounded).share > 0.97);
  CHECK(write(corner, rounded).keeps);
  // A chord leaves the corridor on each leg where it is sqrt(2) corridors from where it left that leg.
  for (const double cut : {0.012, 0.018}) {
    const std::vector<Point> chord = through({corner_start, corner_start + Point(leg - cut, 0),
                                              corner_start + Point(leg, -cut), corner_start + Point(leg, -leg)});
    CAPTURE(cut);
    CHECK(write(corner, chord).share < 1.0 - (cut - 2.0 * std::numbers::sqrt2 * corridor) / leg + 0.01);
    CHECK(write(corner, chord).share < 0.9);
  }
}

TEST_CASE("what a pen skips is not covered, however it gets past it", "[render]") {
  for (const double aside : {0.004, 0.01}) {
    CAPTURE(aside);
    const Written gap = write(line, through({on_line(0, 0), on_line(0.01, 0), on_line(0.01, aside),
                                             on_line(0.02, aside), on_line(0.02, 0), on_line(length, 0)}));
    CHECK(gap.share == Approx(2.0 / 3.0).margin(1e-6));
  }
}

TEST_CASE("a pen keeps in the corridor that is outside for at most a tenth of its way", "[render]") {
  for (const double share : {0.02, 0.05}) {
    const double aside = 1.01 * corridor, there = share * length;
    std::vector<Point> path = through({on_line(0, 0), on_line(0.01, 0)});
    path.push_back(on_line(0.01, aside));  // a leap sideways, which is on the way too
    for (const Point& point : through({on_line(0.01, aside), on_line(0.01 + there, aside)})) path.push_back(point);
    for (const Point& point : through({on_line(0.01 + there, 0.0), on_line(length, 0.0)})) path.push_back(point);
    const double outside = (there + aside) / (length + 2.0 * aside);
    CAPTURE(share, outside);
    CHECK(write(line, path).keeps == (outside <= 0.1));
  }
}

TEST_CASE("a closest point that leaps ahead of the pen covers what a bend or a corner explains, and no more",
          "[render]") {
  const auto after_leap = [](double leap, bool passes_feature) {
    StrokeCoverage coverage;
    coverage.restart({0, 0}, {{0, 0}, {1, 0}, 0.0});
    StrokeContact contact;
    contact.closest.tangent = {1, 0};
    for (const double arc : {leap, leap + step}) {  // the pen moves by one step each time, and is on the stroke
      const Point tip = contact.closest.point + Point(step, 0);
      contact.closest.point = tip;
      contact.arc = arc;
      contact.passed_feature = passes_feature && arc == leap;
      coverage.update(tip, contact, length, corridor);
    }
    return length * coverage.share(length);
  };
  CHECK(after_leap(2.9 * step, false) == Approx(3.9 * step));
  CHECK(after_leap(3.1 * step, false) == Approx(step));  // the leap is not covered, what follows is
  CHECK(after_leap(1.4 * corridor, true) == Approx(1.4 * corridor + step));
  CHECK(after_leap(1.6 * corridor, true) == Approx(1.5 * corridor + step));
}

TEST_CASE("going over the same part twice covers it once", "[render]") {
  CHECK(write(line, through({on_line(0, 0), on_line(0.015, 0), on_line(0.002, 0), on_line(0.015, 0)})).share ==
        Approx(0.5).margin(1e-6));
}

TEST_CASE("a wave or a zigzag of 10 % of the em about a stroke does not keep to it, one of 4 % does", "[render]") {
  for (const double wavelength : {0.003, 0.006, 0.012}) {
    for (const double amplitude : {0.004, 0.0016}) {
      std::vector<Point> wave = {start}, zigzag = {start};
      for (double along = 0.0; along <= length; along += 1e-5) {
        const double phase = along / wavelength;
        wave.push_back(on_line(along, amplitude * std::sin(2.0 * std::numbers::pi * phase)));
        zigzag.push_back(
            on_line(along, amplitude * 2.0 / std::numbers::pi * std::asin(std::sin(2.0 * std::numbers::pi * phase))));
      }
      CAPTURE(wavelength, amplitude);
      const bool is_large = amplitude > corridor;
      for (const std::vector<Point>& path : {wave, zigzag}) {
        const Written written = write(line, path);
        CHECK(written.keeps == !is_large);
        if (!is_large) CHECK(written.share > 0.99);
      }
    }
  }
}

}  // namespace stroke_coverage_tests
