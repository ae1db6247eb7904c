// fit_stroke: pen paths become typical strokes by geometry alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <string_view>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/character.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "../catch.hpp"
#include "../sanitized.hpp"

using namespace calligraphy;

namespace {

using Path = std::vector<Point>;

/// A stroke's centre line with `steps` points on each element.
Path sampled(std::string_view elements, const std::vector<Point>& points, int steps) {
  Path path{points.front()};
  std::size_t at = 0;
  for (const char kind : elements) {
    const bool line = kind == 'L';
    for (int step = 1; step <= steps; ++step) {
      const double t = static_cast<double>(step) / steps;
      path.push_back(line ? Point(points[at] + t * (points[at + 1] - points[at]))
                          : Bezier<3>{{points[at], points[at + 1], points[at + 2], points[at + 3]}}.point(t));
    }
    at += line ? 1 : 3;
  }
  return path;
}

Path sampled(const TypicalStroke& type, const std::vector<Point>& points, int steps) {
  return sampled(type.elements, points, steps);
}

/// The outline of a brush of constant width with blunt ends, whose median the path is.
Path outline_of(const Path& path, double half_width) {
  Path left, right;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point along = (path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]).normalized();
    left.push_back(path[i] + half_width * Point(-along.y(), along.x()));
    right.push_back(path[i] - half_width * Point(-along.y(), along.x()));
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  return left;
}

std::vector<Point> typical_points(const TypicalStroke& type) {
  std::vector<Point> points;
  for (const auto& point : type.shape) points.emplace_back(point[0], point[1]);
  return points;
}

/// Scales about the centre of the em square and adds reproducible noise of up to `noise`.
Path changed(Path path, double scale, double noise) {
  std::uint32_t state = 12345;
  const auto shake = [&] {
    state = state * 1664525u + 1013904223u;
    return noise * (static_cast<double>(state >> 8) / 8388608.0 - 1.0);
  };
  for (Point& point : path) {
    point = Point(0.5, 0.5) + scale * (point - Point(0.5, 0.5));
    const double up = shake(), right = shake();  // in this order with every compiler
    point += Point(right, up);
  }
  return path;
}

/// On plain numbers, x and y: Eigen's expressions take ten times as long where tests are not optimised.
double distance_to_segment(const double* point, const double* from, const double* to) {
  const double along_x = to[0] - from[0], along_y = to[1] - from[1];
  const double x = point[0] - from[0], y = point[1] - from[1];
  const double squared = along_x * along_x + along_y * along_y;
  double t = squared > 0.0 ? (x * along_x + y * along_y) / squared : 0.0;
  if (t < 0.0) t = 0.0;
  if (t > 1.0) t = 1.0;
  return std::hypot(x - t * along_x, y - t * along_y);
}

double distance_to_segment(const Point& point, const Point& from, const Point& to) {
  return distance_to_segment(point.data(), from.data(), to.data());
}

double farthest(const Path& from, const Path& to) {
  double largest = 0.0;
  for (const Point& point : from) {
    double nearest = (point - to.front()).norm();
    const double* const at = to.front().data();  // x and y of one after the other
    for (std::size_t i = 1; i < to.size(); ++i) {
      const double distance = distance_to_segment(point.data(), at + 2 * (i - 1), at + 2 * i);
      if (distance < nearest) nearest = distance;
    }
    largest = std::max(largest, nearest);
  }
  return largest;
}

/// Ids that share the same geometry: only the character tells which one is meant.
std::set<int> accepted_ids(int id) {
  static const std::vector<std::set<int>> twins = {
      {3, 4},    // shu pie and pie differ in how long they stay upright
      {4, 5},    // a small pie is short and straight
      {8, 38},   // dian and chang dian differ in length
      {6, 38},   // na and chang dian differ in how they end
      {2, 9},    // left dian is a short leaning shu
      {11, 17},  // a heng gou with a longer hook is a heng pie
      {23, 24},  // as do heng zhe wan and heng zhe zhe
      {30, 32},  // shu wan and shu zhe differ in the roundness of the bend
      {9, 5},    // without the thin start, which a pen does not show, a left dian is a short pie
      {9, 4},
  };
  std::set<int> accepted{id};
  for (const auto& pair : twins) {
    if (pair.contains(id)) accepted.insert(pair.begin(), pair.end());
  }
  return accepted;
}

/// Maximum bend at the smooth joints of the typical stroke [degree].
double max_smooth_bend(const StrokeInput& stroke) {
  const std::string_view elements = stroke.composition().elements();
  const std::vector<int> joints = feature_points(elements);
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < joints.size(); ++i) {
    if (!is_smooth_joint(typical_stroke(stroke.id), elements, i - 1)) continue;
    const auto at = static_cast<std::size_t>(joints[i]);
    const Point before = stroke.control_points[at] - stroke.control_points[at - 1];
    const Point after = stroke.control_points[at + 1] - stroke.control_points[at];
    const double cosine = before.dot(after) / (before.norm() * after.norm());
    largest = std::max(largest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
  }
  return largest;
}

Path spiral(int count) {
  Path path;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const double angle = 40.0 * share;
    path.push_back(Point(0.5, 0.5) + 0.4 * share * Point(std::cos(angle), std::sin(angle)));
  }
  return path;
}

Path zigzag(int count) {
  Path path;
  for (int i = 0; i < count; ++i) path.emplace_back(i % 2, static_cast<double>(i) / count);
  return path;
}

std::vector<std::pair<std::string, Path>> hard_inputs() {
  Path long_line;
  for (int i = 0; i < 10000; ++i) long_line.emplace_back(0.1 + 0.8e-4 * i, 0.5 + 0.01 * std::sin(0.01 * i));
  return {
      {"one point", {{0.5, 0.5}}},
      {"equal points", {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}},
      {"two points", {{0.2, 0.5}, {0.8, 0.5}}},
      {"two points, backwards", {{0.8, 0.5}, {0.2, 0.5}}},
      {"upwards", {{0.5, 0.1}, {0.5, 0.9}}},
      {"nearly one point", {{0.5, 0.5}, {0.5 + 1e-13, 0.5}}},
      {"a millionth of an em", {{0.5, 0.5}, {0.5 + 1e-6, 0.5}}},
      {"there and back", {{0.2, 0.5}, {0.8, 0.5}, {0.2, 0.5}}},
      {"10,000 points", long_line},
      {"10,000 equal points", Path(10000, Point(0.3, 0.7))},
      {"a spiral", spiral(400)},
      {"a spiral of 10,000 points", spiral(10000)},
      {"a zigzag", zigzag(9)},
      {"a zigzag of 10,000 points", zigzag(10000)},
      {"far away", {{-14.0, 14.0}, {14.0, -14.0}}},
      {"smallest numbers", {{0.0, 0.0}, {5e-324, 5e-324}}},
  };
}

}  // namespace

TEST_CASE("every typical shape drawn by a pen is recognised as itself or as a documented twin", "[model]") {
  for (const double scale : {1.0, 0.7, 0.5}) {
    for (const double noise : {0.0, 0.002, 0.005}) {
      if (calligraphy_test::sanitized && noise != 0.002) continue;
      for (const TypicalStroke& type : typical_strokes()) {
        const Path path = changed(sampled(type, typical_points(type), 12), scale, noise * scale);
        const FittedStroke fitted = fit_stroke(path);
        INFO("typical stroke " << type.id << " at scale " << scale << " with noise " << noise << " became "
                               << fitted.stroke.id);
        CHECK(accepted_ids(type.id).contains(fitted.stroke.id));
      }
    }
  }
}

TEST_CASE("typical shapes drawn with a brush at full size are recognised exactly", "[model]") {
  for (const TypicalStroke& type : typical_strokes()) {
    INFO("typical stroke " << type.id);
    const Path path = sampled(type, typical_points(type), 12);
    CHECK(fit_stroke(path, {.outline = outline_of(path, 0.02)}).recognised == type.id);
  }
}

TEST_CASE("a dense typical shape is fitted within 1 % of the em if its id is given", "[model]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const int only[] = {type.id};
    const FittedStroke fitted =
        fit_stroke(sampled(type, typical_points(type), 40), {.ids = only});
    INFO("typical stroke " << type.id << ", error " << fitted.error);
    CHECK(fitted.stroke.id == type.id);
    CHECK(fitted.error < 0.01);
  }
}

TEST_CASE("a typical shape with noise of 0.5 % of the em is fitted within 1 %, the circle within 2 %", "[model]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const Path path = changed(sampled(type, typical_points(type), 12), 1.0, 0.005);
    const int only[] = {type.id};
    const FittedStroke fitted = fit_stroke(path, {.ids = only});
    INFO("typical stroke " << type.id << ", error " << fitted.error);
    CHECK(fitted.error < (type.id == 39 ? 0.02 : 0.01));
  }
}

TEST_CASE("recognition does not depend on the position of the stroke", "[model]") {
  for (const TypicalStroke& type : typical_strokes()) {
    Path path = sampled(type, typical_points(type), 12);
    const int id = fit_stroke(path).stroke.id;
    for (Point& point : path) point += Point(3.0, -2.0);
    INFO("typical stroke " << type.id);
    CHECK(fit_stroke(path).stroke.id == id);
  }
}

TEST_CASE("the reported error of a pen path is the maximum distance in both directions, or more to keep the order",
          "[model]") {
  constexpr double step = 0.004;  // [em] between the points that are compared
  for (const TypicalStroke& type : typical_strokes()) {
    const Path path = changed(sampled(type, typical_points(type), 12), 1.0, 0.004);  // noise keeps it above zero
    const FittedStroke fitted = fit_stroke(path);
    const Path model = sampled(fitted.stroke.composition().elements(), fitted.stroke.control_points, 400);
    Path dense{path.front()};
    for (std::size_t i = 1; i < path.size(); ++i) {
      for (int k = 1; k <= 40; ++k) dense.push_back(path[i - 1] + k / 40.0 * (path[i] - path[i - 1]));
    }
    INFO("typical stroke " << type.id << " became " << fitted.stroke.id);
    const double distance = std::max(farthest(model, path), farthest(dense, model));
    CHECK(fitted.error > distance - 0.5 * step);
    CHECK(fitted.error < distance + step);
  }
}

TEST_CASE("a line becomes a curve where it is more than 1.8 % of the em from the path, and only there", "[model]") {
  const auto bowed = [](double sagitta) {  // a shu
    Path path;
    for (int i = 0; i <= 60; ++i) {
      const double t = i / 60.0;
      path.emplace_back(0.5 + 4.0 * sagitta * t * (1.0 - t), 0.9 - 0.8 * t);
    }
    return path;
  };
  const int shu[] = {2};
  const FittedStroke straight = fit_stroke(bowed(0.03), {.ids = shu});  // half of it to either side
  CHECK(straight.stroke.composition() == "L");
  CHECK(straight.unbent_error == straight.error);
  const FittedStroke bent = fit_stroke(bowed(0.05), {.ids = shu});
  CHECK(bent.stroke.id == 2);
  CHECK(bent.stroke.composition() == "C");
  CHECK(bent.unbent_error > 0.018);
  CHECK(bent.error < 0.006);

  // Heng zhe whose upright alone is bowed.
  Path corner;
  for (int i = 0; i < 40; ++i) corner.emplace_back(0.2 + 0.015 * i, 0.8);
  for (const Point& point : bowed(0.06)) corner.push_back(point + Point(0.3, -0.1));
  const int heng_zhe[] = {16};
  const FittedStroke turned = fit_stroke(corner, {.ids = heng_zhe});
  CHECK(turned.stroke.composition() == "LC");
  CHECK(turned.error < 0.01);
}

TEST_CASE("as many lines become curves as the path needs", "[model]") {
  const TypicalStroke& type = typical_stroke(24);  // heng zhe zhe, LLL
  Path path;
  const auto arc = [&](const Point& from, const Point& to, double sagitta) {
    const Point aside = sagitta * Point(from.y() - to.y(), to.x() - from.x()).normalized();
    for (int i = 0; i < 40; ++i) {
      const double t = i / 40.0;
      path.push_back(from + t * (to - from) + 4.0 * t * (1.0 - t) * aside);
    }
  };
  arc({0.1, 0.8}, {0.5, 0.8}, 0.1);
  arc({0.5, 0.8}, {0.5, 0.3}, 0.1);
  arc({0.5, 0.3}, {0.9, 0.3}, 0.1);
  path.emplace_back(0.9, 0.3);
  const int only[] = {type.id};
  const FittedStroke fitted = fit_stroke(path, {.ids = only});
  CHECK(std::ranges::count(fitted.stroke.composition().elements(), 'C') >= 2);
  CHECK(fitted.error < 0.018);
}

TEST_CASE("smooth joints of a typical stroke bend by less than 5 degrees", "[model]") {
  for (const double noise : {0.0, 0.004}) {
    for (const TypicalStroke& type : typical_strokes()) {
      const FittedStroke fitted = fit_stroke(changed(sampled(type, typical_points(type), 12), 0.8, noise));
      INFO("typical stroke " << type.id << " became " << fitted.stroke.id);
      CHECK(max_smooth_bend(fitted.stroke) < 5.0);
    }
  }
}

TEST_CASE("a stroke follows its path from the first touch to the last, entry and droop included", "[model]") {
  const Path shu{{0.33, 0.81}, {0.36, 0.79}, {0.38, 0.755}, {0.378, 0.40}, {0.376, 0.22}};
  const Path heng{{0.10, 0.50}, {0.15, 0.49}, {0.50, 0.53}, {0.83, 0.57}, {0.90, 0.545}};
  for (const auto& [id, path] : {std::pair{2, shu}, std::pair{1, heng}}) {
    const FittedStroke fitted = fit_stroke(path, {.outline = outline_of(path, 0.01)});
    INFO("typical stroke " << id);
    CHECK(fitted.stroke.id == id);
    CHECK(fitted.error < 0.025);
    CHECK((fitted.stroke.control_points.front() - path.front()).norm() < 0.035);
    CHECK((fitted.stroke.control_points.back() - path.back()).norm() < 0.035);
  }
}

TEST_CASE("a blunt end of a brush stroke begins a half-width inside its outline, a tapering one at its tip", "[model]") {
  const Path median{{0.1, 0.5}, {0.9, 0.5}};
  const Path blunt{{0.1, 0.46}, {0.9, 0.46}, {0.9, 0.54}, {0.1, 0.54}};
  const Path tapering{{0.1, 0.5}, {0.3, 0.46}, {0.9, 0.46}, {0.9, 0.54}, {0.3, 0.54}};
  const StrokeInput of_blunt = fit_stroke(median, {.outline = blunt}).stroke;
  CHECK((of_blunt.control_points.front() - Point(0.14, 0.5)).norm() < 0.005);
  CHECK((of_blunt.control_points.back() - Point(0.86, 0.5)).norm() < 0.005);
  const StrokeInput of_tapering = fit_stroke(median, {.outline = tapering}).stroke;
  CHECK((of_tapering.control_points.front() - Point(0.1, 0.5)).norm() < 0.008);
  const StrokeInput of_pen = fit_stroke(median).stroke;
  CHECK((of_pen.control_points.front() - median.front()).norm() < 1e-6);
  CHECK((of_pen.control_points.back() - median.back()).norm() < 1e-6);
}

TEST_CASE("a stroke that starts in its middle and runs over itself has an error of its fold, not of its distance",
          "[model]") {
  const Path folded{{0.5, 0.5}, {0.1, 0.5}, {0.9, 0.5}};
  const int heng[] = {1};
  CHECK(fit_stroke(folded, {.ids = heng}).unbent_error > 0.15);
}

TEST_CASE("a label restricts the candidates for a path", "[model]") {
  const Path heng{{0.1, 0.5}, {0.9, 0.6}};
  const std::vector<std::vector<int>> labels{{10}, {5, 4}, {16, 18}, {31}, {8, 38}};
  for (const std::vector<int>& ids : labels) {
    const FittedStroke fitted = fit_stroke(heng, {.ids = ids});
    INFO("became " << fitted.stroke.id);
    CHECK(std::ranges::find(ids, fitted.stroke.id) != ids.end());
  }
  const int unknown[] = {1, 40};
  CHECK_THROWS_AS(fit_stroke(heng, {.ids = unknown}), ValueError);
  const int zero[] = {0};
  CHECK_THROWS_AS(fit_stroke(heng, {.ids = zero}), ValueError);
}

TEST_CASE("a line that does not follow its path gives way to its rounder relative, where the label allows that",
          "[model]") {
  const auto pie = [](double length) {
    constexpr double height = 0.018;  // [em]; half of that is its distance from a line
    Path path;
    for (int i = 0; i <= 20; ++i) {
      const double share = i / 20.0;
      path.push_back(Point(0.7, 0.7) + length * share * Point(-0.87, -0.49) +
                     4.0 * share * (1.0 - share) * height * Point(0.49, -0.87));
    }
    return path;
  };
  const int either[] = {4, 5}, straight[] = {5};
  // A line follows within 1.8 % of the em and 10 % of the path: the long one, although a curve would be closer.
  for (const double length : {0.3, 0.08}) {
    const Path path = pie(length);
    const int expected = length > 0.1 ? 5 : 4;
    REQUIRE(fit_stroke(path).recognised == 5);
    CHECK(fit_stroke(path).stroke.id == expected);
    CHECK(fit_stroke(path, {.ids = either}).stroke.id == expected);
    CHECK(fit_stroke(path, {.ids = straight}).stroke.id == 5);
  }
}

TEST_CASE("a corner vertex lies at the intersection of the limbs, not on the rounded corner", "[model]") {
  const Path median{{0.20, 0.70}, {0.50, 0.70}, {0.72, 0.70}, {0.75, 0.69}, {0.76, 0.66}, {0.76, 0.40}, {0.76, 0.20}};
  const FittedStroke fitted = fit_stroke(median);
  REQUIRE(fitted.stroke.id == 16);
  const double cut = distance_to_segment(fitted.stroke.control_points[1], median[3], median[4]);
  CHECK(cut > 0.004);
  CHECK(fitted.error < 0.01);
}

TEST_CASE("similar strokes are distinguished by direction and length", "[model]") {
  const auto id_of = [](const Path& path) { return fit_stroke(path, {.outline = outline_of(path, 0.02)}).recognised; };
  CHECK(id_of({{0.1, 0.5}, {0.9, 0.6}}) == 1);                             // heng rises by 7 degrees
  CHECK(id_of({{0.3, 0.4}, {0.6, 0.6}}) == 10);                            // ti by 34
  CHECK(id_of({{0.5, 0.6}, {0.58, 0.5}}) == 8);                            // dian
  CHECK(id_of({{0.5, 0.6}, {0.47, 0.45}}) == 9);                           // left dian
  CHECK(id_of({{0.5, 0.9}, {0.5, 0.1}}) == 2);                             // shu
  CHECK(id_of({{0.7, 0.8}, {0.4, 0.7}}) == 5);                             // short pie
  CHECK(id_of({{0.2, 0.8}, {0.8, 0.82}, {0.74, 0.72}}) == 11);             // heng gou
  CHECK(id_of({{0.2, 0.8}, {0.8, 0.82}, {0.77, 0.3}}) == 16);              // heng zhe
  CHECK(id_of({{0.5, 0.9}, {0.5, 0.1}, {0.4, 0.16}}) == 12);               // shu gou
  CHECK(id_of({{0.5, 0.9}, {0.5, 0.2}, {0.7, 0.4}}) == 29);                // shu ti
  CHECK(id_of({{0.3, 0.8}, {0.3, 0.2}, {0.8, 0.24}}) == 32);               // shu zhe
  CHECK(id_of({{0.5, 0.8}, {0.3, 0.4}, {0.7, 0.45}}) == 36);               // pie zhe
  CHECK(id_of({{0.2, 0.8}, {0.7, 0.82}, {0.7, 0.1}, {0.6, 0.15}}) == 18);  // heng zhe gou
  CHECK(id_of({{0.2, 0.8}, {0.5, 0.82}, {0.5, 0.2}, {0.7, 0.4}}) == 19);   // heng zhe ti
}

TEST_CASE("hard inputs give a valid, finite stroke with any options", "[model]") {
  const std::vector<int> labels{16, 30, 39};
  const Path square{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  const std::vector<StrokeFitOptions> asked{
      {}, {.outline = square}, {.ids = labels}, {.outline = square, .ids = labels}};
  for (const auto& [name, path] : hard_inputs()) {
    for (std::size_t i = 0; i < asked.size(); ++i) {
      INFO(name << ", options " << i);
      FittedStroke fitted;
      REQUIRE_NOTHROW(fitted = fit_stroke(path, asked[i]));
      CHECK(std::isfinite(fitted.error));
      CHECK(fitted.error >= 0.0);
      double length = 0.0;
      for (std::size_t k = 1; k < fitted.stroke.control_points.size(); ++k) {
        length += (fitted.stroke.control_points[k] - fitted.stroke.control_points[k - 1]).norm();
      }
      CHECK(length > 0.005);
      const std::array strokes{fitted.stroke};
      REQUIRE_NOTHROW(make_character(U'一', strokes));
    }
  }
}

TEST_CASE("random scribbles give valid strokes, reproducibly", "[model]") {
  std::uint32_t state = 7;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / 16777216.0;
  };
  for (int trial = 0; trial < (calligraphy_test::sanitized ? 40 : 400); ++trial) {
    Path path;
    const int count = 2 + static_cast<int>(random() * 14);
    const double size = trial % 5 == 0 ? 10.0 : trial % 3 == 0 ? 0.05 : 1.0;
    for (int i = 0; i < count; ++i) path.emplace_back(size * random(), size * random());
    const Path outline = trial % 2 == 0 ? outline_of(path, 0.03) : Path();
    const StrokeFitOptions options{.outline = outline};
    INFO("scribble " << trial);
    const FittedStroke fitted = fit_stroke(path, options);
    const std::array strokes{fitted.stroke};
    REQUIRE_NOTHROW(make_character(U'一', strokes));
    CHECK(fit_stroke(path, options).stroke.control_points == fitted.stroke.control_points);
  }
}

TEST_CASE("a shoulder cut by the brush is followed by a curve", "[model]") {
  const Path median{{0.20, 0.70}, {0.45, 0.72}, {0.69, 0.74}, {0.76, 0.68}, {0.74, 0.45}, {0.72, 0.20}};
  const FittedStroke fitted = fit_stroke(median);
  REQUIRE(fitted.stroke.id == 16);
  CHECK(fitted.unbent_error > 0.018);
  CHECK(fitted.error < 0.012);
}

TEST_CASE("a brush remnant after a heng zhe is not a hook", "[model]") {
  const Path lifted{{0.20, 0.70}, {0.75, 0.74}, {0.72, 0.20}, {0.68, 0.21}};
  CHECK(fit_stroke(lifted, {.outline = outline_of(lifted, 0.02)}).stroke.id == 16);
  const Path hooked{{0.20, 0.70}, {0.75, 0.74}, {0.72, 0.20}, {0.56, 0.26}};
  CHECK(fit_stroke(hooked, {.outline = outline_of(hooked, 0.02)}).stroke.id == 18);
}

TEST_CASE("a point becomes a dian of about 2 % of the em around it", "[model]") {
  const FittedStroke fitted = fit_stroke(Path{{0.3, 0.7}});
  REQUIRE(fitted.stroke.id == 8);
  const auto& points = fitted.stroke.control_points;
  CHECK((0.5 * (points[0] + points[1]) - Point(0.3, 0.7)).norm() < 1e-12);
  CHECK((points[1] - points[0]).norm() == Approx(0.02));
  CHECK(fitted.error == Approx(0.01));
}

TEST_CASE("paths without points or with invalid ones are rejected", "[model]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(fit_stroke({}), ValueError);
  CHECK_THROWS_AS(fit_stroke(Path{{nan, 0.0}}), ValueError);
  CHECK_THROWS_AS(fit_stroke(Path{{0.0, 0.0}, {0.5, nan}}), ValueError);
  CHECK_THROWS_AS(fit_stroke(Path{{0.0, 0.0}, {infinity, 0.5}}), ValueError);
  CHECK_THROWS_AS(fit_stroke(Path{{0.0, 0.0}, {1e300, 0.5}}), ValueError);
  const Path outline{{0.0, 0.0}, {0.0, nan}, {1.0, 1.0}};
  CHECK_THROWS_AS(fit_stroke(Path{{0.0, 0.0}, {0.5, 0.5}}, {.outline = outline}), ValueError);
}

TEST_CASE("a path of many points gives the same stroke as one of few, and its error is not underestimated", "[model]") {
  for (const std::size_t count : {100u, 3'000u, 20'000u, 100'000u}) {
    std::vector<Point> line, corner;
    for (std::size_t i = 0; i <= count; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(count);
      line.emplace_back(t, 0.5);
      corner.push_back(t < 0.5 ? Point(0.2 + t, 0.8) : Point(0.7, 1.3 - t));
    }
    INFO(count);
    const FittedStroke heng = fit_stroke(line);
    CHECK(heng.stroke.id == 1);
    CHECK(heng.error <= 2e-4);
    const FittedStroke turn = fit_stroke(corner);
    CHECK(turn.stroke.id == 16);
    CHECK(turn.error <= 3e-3);
  }
  // A line cannot follow a saw of 5,000 teeth, each 2 % of the em high, any closer.
  std::vector<Point> saw;
  for (int i = 0; i <= 10'000; ++i) saw.emplace_back(1e-4 * i, i % 2 == 0 ? 0.5 : 0.52);
  CHECK(fit_stroke(saw).error >= 0.0099);
}
