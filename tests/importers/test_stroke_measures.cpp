// Measures of imported strokes against their source. Expected values are worked out by hand.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "../catch.hpp"
#include "../sanitized.hpp"
#include "importers/check/import_measures.hpp"
#include "importers/fit/crossings.hpp"
#include "importers/fit/frechet.hpp"
#include "importers/fit/outline.hpp"

namespace stroke_measures_tests {

using namespace calligraphy;
using namespace calligraphy::recognition;

namespace {

constexpr double step = 0.004;  // [em]

/// Eiter and Mannila's recurrence, cell by cell.
double plain_distance(const Path& path, const Path& source, double free) {
  const std::size_t n = path.size(), m = source.size();
  const double step = path_length(source) / static_cast<double>(m - 1);
  std::vector<std::vector<double>> leash(n, std::vector<double>(m));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      double before = i == 0 && step * static_cast<double>(j) <= free ? 0.0 : INFINITY;
      if (i == 0 && j == 0) before = 0.0;
      if (i > 0) before = std::min(before, leash[i - 1][j]);
      if (j > 0) before = std::min(before, leash[i][j - 1]);
      if (i > 0 && j > 0) before = std::min(before, leash[i - 1][j - 1]);
      leash[i][j] = std::max(before, (path[i] - source[j]).norm());
    }
  }
  double best = leash[n - 1][m - 1];
  for (std::size_t j = 0; j < m; ++j) {
    if (step * static_cast<double>(m - 1 - j) <= free) best = std::min(best, leash[n - 1][j]);
  }
  return best;
}

Path circle(const Point& centre, double radius) {
  Path path;
  for (int i = 0; i < 360; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    path.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
  }
  return path;
}

}  // namespace

TEST_CASE("the Fréchet distance keeps the order, which the nearest distance does not see", "[model]") {
  const Path line{{0.1, 0.5}, {0.9, 0.5}};
  const Path beside{{0.1, 0.53}, {0.9, 0.53}};
  CHECK(frechet_distance(line, line, 0.0, step) < step);
  CHECK(frechet_distance(beside, line, 0.0, step) == Approx(0.03).margin(step));
  const Path reversed{{0.9, 0.5}, {0.1, 0.5}};
  CHECK(frechet_distance(reversed, line, 0.0, step) == Approx(0.8).margin(step));
  // From its middle to its start and then over all of it: no point is off the line.
  const Path folded{{0.5, 0.5}, {0.1, 0.5}, {0.9, 0.5}};
  CHECK(frechet_distance(folded, line, 0.0, step) == Approx(0.4).margin(step));
  // Back and forth by 0.2 in the middle: the leash is half of it.
  const Path zigzag{{0.1, 0.5}, {0.6, 0.5}, {0.4, 0.5}, {0.9, 0.5}};
  CHECK(frechet_distance(zigzag, line, 0.0, step) == Approx(0.1).margin(step));
}

TEST_CASE("a path may begin and end as far from the ends of its source as is free, and no farther", "[model]") {
  const Path line{{0.1, 0.5}, {0.9, 0.5}};
  const Path shorter{{0.15, 0.5}, {0.87, 0.5}};
  CHECK(frechet_distance(shorter, line, 0.0, step) == Approx(0.05).margin(step));
  CHECK(frechet_distance(shorter, line, 0.05, step) < step);
  CHECK(frechet_distance(shorter, line, 0.03, step) == Approx(0.02).margin(step));
  const Path longer{{0.05, 0.5}, {0.9, 0.5}};
  CHECK(frechet_distance(longer, line, 0.05, step) == Approx(0.05).margin(step));
}

TEST_CASE("the distance to a detour is its height, whichever of the two is the path", "[model]") {
  const Path detour{{0.0, 0.0}, {0.5, 0.3}, {1.0, 0.0}};
  const Path straight{{0.0, 0.0}, {1.0, 0.0}};
  CHECK(frechet_distance(straight, detour, 0.0, step) == Approx(0.3).margin(step));
  CHECK(frechet_distance(detour, straight, 0.0, step) == Approx(0.3).margin(step));
}

TEST_CASE("the distance is that of the best of all walks, folds and free ends included", "[model]") {
  std::uint32_t state = 3;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / 16777216.0;
  };
  const auto scribble = [&] {
    Path path;
    for (int i = 0, count = 2 + static_cast<int>(4 * random()); i < count; ++i) {
      const double x = random();
      path.emplace_back(x, 0.3 * random());
    }
    return path;
  };
  for (int trial = 0; trial < (calligraphy_test::sanitized ? 20 : 200); ++trial) {
    const Path path = scribble(), source = scribble();
    const double coarse = 0.02, free = trial % 3 == 0 ? 0.0 : 0.1;
    const double plain = plain_distance(resampled(path, coarse, 1200), resampled(source, coarse, 1200), free);
    CHECK(frechet_distance(path, source, free, coarse) == Approx(plain));
  }
}

TEST_CASE("a path has no distance from itself, however long, and paths that are points have theirs", "[model]") {
  Path spiral;
  for (int i = 0; i < 20000; ++i) {
    const double angle = 0.01 * i;
    spiral.push_back(0.05 * angle * Point(std::cos(angle), std::sin(angle)));
  }
  const double distance = frechet_distance(spiral, spiral, 0.0, step);
  CHECK(distance == 0.0);
  CHECK(frechet_distance(Path{{0.5, 0.5}, {0.5, 0.5}}, Path{{0.5, 0.6}, {0.5, 0.6}}, 0.1, step) == Approx(0.1));
}

TEST_CASE("the inscribed radius is the distance to the outline inside it and 0 outside", "[model]") {
  const Path square{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  CHECK(inscribed_radius(square, {0.5, 0.5}) == Approx(0.5));
  CHECK(inscribed_radius(square, {0.9, 0.3}) == Approx(0.1));
  CHECK(inscribed_radius(square, {1.1, 0.5}) == 0.0);
  CHECK(inscribed_radius(square, {0.5, -0.1}) == 0.0);
  const Path clockwise(square.rbegin(), square.rend());
  CHECK(inscribed_radius(clockwise, {0.9, 0.3}) == Approx(0.1));
  CHECK(inscribed_radius(circle({0.3, 0.4}, 0.2), {0.4, 0.4}) == Approx(0.1).margin(1e-4));
  CHECK(inscribed_radius({}, {0.5, 0.5}) == 0.0);
}

TEST_CASE("the half-width of a brush stroke is at most 15 % of its length, and 0 without an outline", "[model]") {
  const Path median{{0.1, 0.5}, {0.9, 0.5}};
  const Path outline{{0.05, 0.46}, {0.95, 0.46}, {0.95, 0.54}, {0.05, 0.54}};
  CHECK(half_width(median, outline) == Approx(0.04));
  const Path thick{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  CHECK(half_width(Path{{0.4, 0.5}, {0.6, 0.5}}, thick) == Approx(0.03));
  CHECK(half_width(median, {}) == 0.0);
}

TEST_CASE("a stroke like its source has no fault", "[model]") {
  const Path corner{{0.1, 0.8}, {0.7, 0.8}, {0.7, 0.2}};
  const StrokeMeasures same = measure_stroke(corner, corner, 0.0);
  CHECK(same.backward < 0.01);
  CHECK(same.length == Approx(1.2));
  CHECK(same.source_length == Approx(1.2));
  CHECK(same.false_corners == 0);
  CHECK(same.lost_corners == 0);
}

TEST_CASE("a corner made round is lost, and one that is not in the source is false", "[model]") {
  const Path corner{{0.1, 0.8}, {0.7, 0.8}, {0.7, 0.2}};
  Path round{{0.1, 0.8}};  // a quarter circle of 0.2 em in place of the corner
  for (int i = 0; i <= 90; ++i) {
    const double angle = (90.0 - i) * std::numbers::pi / 180.0;
    round.push_back(Point(0.5, 0.6) + 0.2 * Point(std::cos(angle), std::sin(angle)));
  }
  round.emplace_back(0.7, 0.2);
  CHECK(measure_stroke(round, corner, 0.0).lost_corners == 1);
  CHECK(measure_stroke(round, corner, 0.0).false_corners == 0);
  CHECK(measure_stroke(corner, round, 0.0).false_corners == 1);
  CHECK(measure_stroke(corner, round, 0.0).lost_corners == 0);
}

TEST_CASE("a lost corner is as far inside as the nearer end, a false one as far off as the source passes it",
          "[model]") {
  const Path corner{{0.1, 0.8}, {0.7, 0.8}, {0.7, 0.4}};
  const Path cut{{0.1, 0.8}, {0.7, 0.4}};
  constexpr double sampling = 0.012;  // [em]; a turn is equal over two steps about a corner
  CHECK(measure_stroke(cut, corner, 0.0).lost_inside == Approx(0.4).margin(sampling));
  CHECK(measure_stroke(cut, corner, 0.0).false_distance == 0.0);
  // From (0.7, 0.8) to the line that cuts the corner: 0.6 * 0.4 / hypot(0.6, 0.4).
  CHECK(measure_stroke(corner, cut, 0.0).false_distance == Approx(0.24 / std::hypot(0.6, 0.4)).margin(sampling));
  CHECK(measure_stroke(corner, cut, 0.0).lost_inside == 0.0);
}

TEST_CASE("the reversal of a drawing is its sharpest turn, whatever the stroke, but for tiny segments", "[model]") {
  const Path stroke{{0.1, 0.5}, {0.9, 0.5}};
  CHECK(measure_stroke(stroke, stroke, 0.0).reversal == 0.0);
  CHECK(measure_stroke(stroke, Path{{0.1, 0.5}, {0.5, 0.5}, {0.5, 0.9}}, 0.0).reversal == Approx(90.0));
  CHECK(measure_stroke(stroke, Path{{0.1, 0.5}, {0.9, 0.5}, {0.6, 0.5}}, 0.0).reversal == Approx(180.0));
  CHECK(measure_stroke(stroke, Path{{0.1, 0.5}, {0.9, 0.5}, {0.895, 0.5}}, 0.0).reversal == 0.0);
}

TEST_CASE("a stroke that starts in its middle runs back", "[model]") {
  const Path source{{0.1, 0.5}, {0.9, 0.5}};
  const Path folded{{0.3, 0.5}, {0.1, 0.5}, {0.9, 0.5}};
  CHECK(measure_stroke(folded, source, 0.0).backward == Approx(0.25).margin(0.02));
  CHECK(measure_stroke(source, source, 0.0).backward == 0.0);
}

TEST_CASE("two paths cross at a place of each, or not at all", "[model]") {
  const Path heng{{0.1, 0.5}, {0.9, 0.5}};
  const Path bent{{0.5, 0.9}, {0.5, 0.6}, {0.6, 0.4}, {0.9, 0.4}};
  const auto crossing = crossing_of(heng, bent);
  REQUIRE(crossing);
  CHECK(crossing->on_one == Approx(0.45));
  CHECK(crossing->on_other == Approx(0.3 + std::hypot(0.05, 0.1)));
  CHECK_FALSE(crossing_of(heng, Path{{0.5, 0.9}, {0.5, 0.6}, {0.6, 0.6}}));
  CHECK_FALSE(crossing_of(heng, Path{{0.95, 0.9}, {0.95, 0.1}}));
}

TEST_CASE("what crosses within a half-width of an end only touches", "[model]") {
  const Path heng{{0.1, 0.5}, {0.9, 0.5}};
  const Path shu{{0.5, 0.9}, {0.5, 0.48}};
  for (const double half_width : {0.0, 0.03}) {
    const std::vector<Path> inner{without_ends(heng, half_width), without_ends(shu, half_width)};
    CHECK(crossing_strokes(inner).size() == (half_width == 0.0 ? 1 : 0));
  }
}

TEST_CASE("an end that crosses in the source is drawn out along its direction, one that does not stays", "[model]") {
  const std::vector<Path> sources{{{0.1, 0.5}, {0.9, 0.5}}, {{0.5, 0.9}, {0.5, 0.499}}};
  const auto crossings = crossing_strokes(sources);
  REQUIRE(crossings.size() == 1);
  const StrokeInput heng{1, {{0.1, 0.5}, {0.9, 0.5}}};
  std::vector<StrokeInput> fitted{heng, {2, {{0.51, 0.9}, {0.5, 0.507}}}};
  const StrokeInput before = fitted[1];
  CHECK(keep_crossings(crossings, sources, fitted) == std::vector<std::size_t>{1});
  CHECK(crossing_of(fitted[0].control_points, fitted[1].control_points));
  CHECK((fitted[1].control_points[0] - before.control_points[0]).norm() == 0.0);
  const Point moved = fitted[1].control_points[1] - before.control_points[1];
  CHECK(moved.norm() < 0.011);
  CHECK(moved.normalized().dot((before.control_points[1] - before.control_points[0]).normalized()) == Approx(1.0));
  CHECK(fitted[0].control_points == heng.control_points);
  CHECK(keep_crossings(crossings, sources, fitted).empty());

  fitted[1].control_points[1] = {0.5, 0.4995};  // a crossing that rounding may undo
  CHECK(keep_crossings(crossings, sources, fitted) == std::vector<std::size_t>{1});
  CHECK(fitted[1].control_points[1].y() < 0.498);

  std::vector<StrokeInput> far_off{heng, {2, {{0.5, 0.9}, {0.5, 0.55}}}};
  CHECK(keep_crossings(crossings, sources, far_off).empty());
}

TEST_CASE("two ends that cross at a corner are both drawn out", "[model]") {
  const std::vector<Path> sources{{{0.1, 0.5}, {0.502, 0.5}}, {{0.5, 0.502}, {0.5, 0.1}}};
  const auto crossings = crossing_strokes(sources);
  REQUIRE(crossings.size() == 1);
  std::vector<StrokeInput> fitted{{1, {{0.1, 0.5}, {0.495, 0.5}}}, {2, {{0.5, 0.494}, {0.5, 0.1}}}};
  CHECK(keep_crossings(crossings, sources, fitted) == std::vector<std::size_t>{0, 1});
  CHECK(crossing_of(fitted[0].control_points, fitted[1].control_points));
}

}  // namespace stroke_measures_tests
