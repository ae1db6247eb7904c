// How much of a stroke has been written, in order and near enough.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/stroke_follower.hpp"
#include "../pen_path.hpp"

namespace stroke_follower_tests {

using namespace calligraphy;
using calligraphy_test::draw_line;
using calligraphy_test::path_of;

namespace {

constexpr double em = 0.04;  // [m]
const Placement place{{0.013, 0.021}, em};
const StrokeTolerances normal = StrokeTolerances::normal();
constexpr double step = 1e-4;

/// A stroke of straight lines through points in em.
Character line_through(int type, const std::vector<Point>& points) {
  const StrokeInput input{type, points, {}};
  return make_character(U'\u4E00', std::span(&input, 1));
}

/// To the right, of this length [em].
Character line_of(double length) { return line_through(1, {{0.1, 0.5}, {0.1 + length, 0.5}}); }

constexpr double long_one = 0.75;
const Character line = line_of(long_one);
/// A place on the page, from the start of each of these lines [em].
Point from_start(double along, double up) { return place.to_page({0.1 + along, 0.5 + up}); }

/// Half an em to the right and half an em down.
const Character corner = line_through(16, {{0.2, 0.8}, {0.7, 0.8}, {0.7, 0.3}});
const Point corner_start = place.to_page({0.2, 0.8});
constexpr double leg = 0.02;  // [m]

struct Written {
  double covered;
  bool at_end;    ///< before the pen is lifted
  bool accepted;  ///< once it is
};

struct Circumstances {
  StrokeTolerances tolerances = StrokeTolerances::normal();
  Point misplaced = Point::Zero();  ///< [m]
  double hidden = 0.0;              ///< [m]
};

/// A pen that begins the stroke with the first point of `path`.
Written write(const Character& character, const std::vector<Point>& path, const Circumstances& given = {}) {
  ActiveStroke active;
  active.load(strokes(character)[0], place);
  StrokeFollower follower;
  follower.load(active, em, given.tolerances);
  follower.begin(path.front(), given.misplaced);
  for (const Point& tip : path) follower.update(tip, tip);
  const bool at_end = follower.is_at_end(given.hidden);
  follower.leave();
  return {follower.covered(), at_end, follower.accepts(given.hidden)};
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

/// Of a line, between two shares of its length.
std::vector<Point> part(double length, double from, double to) {
  return through({from_start(from * length, 0), from_start(to * length, 0)});
}

}  // namespace

TEST_CASE("a typical stroke that is traced is covered entirely and accepted, at its end", "[render]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const Character character = calligraphy_test::typical_character(type.id);
    std::vector<Point> path = path_of(strokes(character)[0], place, step);
    INFO("typical stroke " << type.id);
    const Written whole = write(character, path);
    CHECK(whole.covered > 0.99);
    CHECK(whole.at_end);
    CHECK(whole.accepted);
    double total = 0.0, way = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) total += (path[i] - path[i - 1]).norm();
    std::size_t half = 1;
    while ((way += (path[half] - path[half - 1]).norm()) < 0.5 * total) ++half;
    path.resize(half + 1);
    const Written first_half = write(character, path);
    // In a corner the pen is also abreast of what follows, by the width of the corridor.
    CHECK(first_half.covered == Approx(0.5).margin(0.01 + normal.corridor * em / total));
    CHECK_FALSE(first_half.at_end);
    CHECK_FALSE(first_half.accepted);
    std::reverse(path.begin(), path.end());
    CHECK_FALSE(write(character, path).accepted);
  }
}

TEST_CASE("a part is accepted from max(0.42, coverage - slack / length) and the least way on, less what friction hides",
          "[render]") {
  constexpr double resolution = 0.02;  // of the em: the points of the stroke and the steps of the pen are 0.01 apart
  for (const StrokeTolerances& tolerances :
       {StrokeTolerances::lenient(), StrokeTolerances::normal(), StrokeTolerances::strict()}) {
    for (const double length : {0.2, 0.3, 0.5, 0.8}) {
      for (const double hidden : {0.0, 0.002}) {
        const double least = std::max(0.42, tolerances.coverage - (tolerances.slack + hidden / em) / length);
        // All but 0.075 em, at least 57 %, at most 67 %, and that for a coverage of 90 %.
        const double more = 0.7 * (tolerances.coverage - 0.9), shortest = 0.57 + std::max(0.0, more);
        const double way = std::clamp(1.0 - 0.075 / length, shortest, 0.67 + more) - hidden / em / length;
        const double off = resolution / length;
        CAPTURE(tolerances.slack, length, hidden, least);
        const Circumstances given{tolerances, Point::Zero(), hidden};
        if (least - off > way) {  // where the way is not what decides
          CHECK_FALSE(write(line_of(length), part(length, 0.0, least - off), given).accepted);
        }
        CHECK(write(line_of(length), part(length, 0.0, std::min(1.0, least + off)), given).accepted ==
              (least + off > std::max(0.57, way)));
      }
    }
  }
}

TEST_CASE("no half of a stroke is accepted, however short it is and however much friction hides", "[render]") {
  for (const double length : {0.02, 0.05, 0.08, 0.12, 0.2, 0.4, 0.8}) {
    for (const double hidden : {0.0, 0.002}) {
      for (const double from : {0.0, 0.25, 0.5}) {
        CAPTURE(length, hidden, from);
        CHECK_FALSE(write(line_of(length), part(length, from, from + 0.5), {normal, Point::Zero(), hidden}).accepted);
      }
      CHECK(write(line_of(length), part(length, 0.0, 1.0), {normal, Point::Zero(), hidden}).accepted);
    }
  }
}

TEST_CASE("a line begun beyond its start or before it is covered when it is as long as it should be", "[render]") {
  for (const double along : {-0.15, -0.07, 0.07, 0.15}) {
    CAPTURE(along);
    const auto to = [&](double share) {
      return write(line, through({from_start(along, 0), from_start(along + share * long_one, 0)}));
    };
    CHECK(to(1.0).covered == Approx(1.0).margin(1e-6));
    CHECK(to(1.0).at_end);
    CHECK(to(0.5).covered == Approx(0.5 + std::max(0.0, along) / long_one).margin(0.015));  // as if it were made up for
    CHECK_FALSE(to(0.5).accepted);
  }
}

TEST_CASE("one who begins beyond the start may end at the true end, not before", "[render]") {
  for (const double late : {0.05, 0.1, 0.15, 0.18}) {  // at most a quarter of the stroke
    for (const double beside : {0.0, 0.05}) {
      CAPTURE(late, beside);
      const auto to = [&](double along) {
        return write(line, through({from_start(late, beside), from_start(along, 0)}));
      };
      CHECK(to(long_one).covered == Approx(1.0).margin(1e-6));
      CHECK(to(long_one).at_end);
      CHECK(to(long_one).accepted);
      CHECK_FALSE(to(0.75 * long_one).accepted);
    }
  }
}

TEST_CASE("the corridor reaches from the stroke to where the pen began or where the character is", "[render]") {
  for (const double side : {-1.0, 1.0}) {
    for (const double beside : {0.0, 0.1}) {
      for (const double misplaced : {0.0, 0.1}) {
        CAPTURE(side, beside, misplaced);
        const auto accepted = [&](double up) {
          const std::vector<Point> path = through({from_start(0, side * beside), from_start(0.02, side * beside),
                                                   from_start(0.02, side * up), from_start(long_one, side * up)});
          return write(line, path, {normal, em * Point(0, side * misplaced)}).accepted;
        };
        const double most = std::max(beside, misplaced);
        CHECK(accepted(beside));
        CHECK(accepted(most + 0.9 * normal.corridor));
        CHECK(accepted(-0.9 * normal.corridor));
        CHECK_FALSE(accepted(-1.4 * normal.corridor));
        CHECK_FALSE(accepted(most + 1.4 * normal.corridor));
      }
    }
  }
}

TEST_CASE("the corridor follows a pen that drifts, not one that runs away", "[render]") {
  // Behind a drift in proportion to the way a first-order lag over 1 em is in the end
  // 1 / 0.75 (1 - exp(-0.75)) = 0.70 of it: 0.056 em here, and 0.084 em.
  for (const double side : {-1.0, 1.0}) {
    const auto accepted = [&](double drift) {
      return write(line, through({from_start(0, 0), from_start(long_one, side * drift)})).accepted;
    };
    CAPTURE(side);
    CHECK(accepted(0.08));
    CHECK_FALSE(accepted(0.12));
  }
}

TEST_CASE("a shift in any direction does not count against a stroke with a corner", "[render]") {
  const std::vector<Point> path =
      through({corner_start, corner_start + Point(leg, 0), corner_start + Point(leg, -leg)});
  for (int eighth = 0; eighth < 8; ++eighth) {
    const double angle = eighth * std::numbers::pi / 4.0;
    for (const double size : {0.05, 0.15}) {
      CAPTURE(eighth, size);
      const Written whole = write(corner, shifted(path, size * em * Point(std::cos(angle), std::sin(angle))));
      CHECK(whole.covered > 0.97);
      CHECK(whole.accepted);
    }
  }
}

TEST_CASE("a rounded corner is accepted, one that is cut off is not", "[render]") {
  std::vector<Point> rounded = {corner_start};
  constexpr double radius = 0.004;  // at most 1.7 mm from the corner
  const Point middle = corner_start + Point(leg - radius, -radius);
  draw_line(rounded, middle + Point(0, radius), step);
  for (int i = 0; i <= 90; ++i) {
    const double angle = (90 - i) * std::numbers::pi / 180.0;
    draw_line(rounded, middle + radius * Point(std::cos(angle), std::sin(angle)), step);
  }
  draw_line(rounded, corner_start + Point(leg, -leg), step);
  CHECK(write(corner, rounded).accepted);
  for (const double cut : {0.012, 0.02}) {
    const std::vector<Point> chord = through({corner_start, corner_start + Point(leg - cut, 0),
                                              corner_start + Point(leg, -cut), corner_start + Point(leg, -leg)});
    CAPTURE(cut);
    CHECK_FALSE(write(corner, chord).accepted);
  }
}

TEST_CASE("what a pen skips beside the corridor is not written", "[render]") {
  for (const double aside : {0.1, 0.25}) {
    CAPTURE(aside);
    const Written gap = write(line, through({from_start(0, 0), from_start(0.25, 0), from_start(0.25, aside),
                                             from_start(0.5, aside), from_start(0.5, 0), from_start(long_one, 0)}));
    CHECK_FALSE(gap.accepted);
    CHECK(gap.covered < 0.45);
  }
}

TEST_CASE("going over the same part twice covers it once, to and fro is not the whole", "[render]") {
  const std::vector<Point> path =
      through({from_start(0, 0), from_start(0.375, 0), from_start(0.05, 0), from_start(0.375, 0)});
  CHECK(write(line, path).covered == Approx(0.5).margin(0.015));
  CHECK_FALSE(write(line, path).accepted);
  CHECK_FALSE(write(line, through({from_start(0, 0), from_start(0.375, 0), from_start(0, 0)})).accepted);
}

TEST_CASE("a fine tremor does not make half a stroke the whole", "[render]") {
  // So short that the share of the way decides; in steps of the pen the tremor is twice as long as the stroke.
  std::vector<Point> path;
  for (double along = 0.0; along <= 0.03; along += 1e-4) {
    path.push_back(from_start(along, 0.012 * std::sin(2.0 * std::numbers::pi * along / 0.01)));
  }
  CHECK_FALSE(write(line_of(0.06), path).accepted);
}

TEST_CASE("what a pen has not reached is not covered, whatever the number of points of the row", "[render]") {
  for (double length = 0.3; length < 0.4; length += 0.01) {
    const Character character = line_of(length);
    std::vector<Point> path = {from_start(0, 0)};
    draw_line(path, from_start(length - 0.004, 0), 1e-5);
    CHECK(write(character, path).covered == Approx(1.0 - 0.004 / length).margin(0.001));
  }
}

TEST_CASE("the way is that of the hand, which guidance holds back across the stroke", "[render]") {
  // Half of a short stroke along it, as much across it.
  constexpr double length = 0.08;
  ActiveStroke active;
  active.load(strokes(line_of(length))[0], place);
  for (const bool feels : {true, false}) {
    StrokeFollower follower;
    follower.load(active, em, normal);
    follower.begin(from_start(0, 0), Point::Zero());
    for (int i = 0; i <= 400; ++i) {
      const double along = 0.5 * length * i / 400;
      follower.update(from_start(along, 0), feels ? from_start(along, along) : from_start(along, 0));
    }
    follower.leave();
    CHECK(follower.accepts(0.0) == feels);
  }
}

TEST_CASE("a wave or a zigzag of 10 % of the em about a stroke is not it, one of 4 % is", "[render]") {
  for (const double wavelength : {0.075, 0.15, 0.3}) {
    for (const double amplitude : {0.1, 0.04}) {
      std::vector<Point> wave, zigzag;
      for (double along = 0.0; along <= long_one; along += 2.5e-4) {
        const double phase = 2.0 * std::numbers::pi * along / wavelength;
        wave.push_back(from_start(along, amplitude * std::sin(phase)));
        zigzag.push_back(from_start(along, amplitude * 2.0 / std::numbers::pi * std::asin(std::sin(phase))));
      }
      CAPTURE(wavelength, amplitude);
      CHECK(write(line, wave).accepted == (amplitude < normal.corridor));
      CHECK(write(line, zigzag).accepted == (amplitude < normal.corridor));
    }
  }
}

TEST_CASE("samples that are lost on a straight way change nothing, and nor does the rate", "[render]") {
  const auto every = [](double distance) {
    std::vector<Point> path = {from_start(0, 0)};
    draw_line(path, from_start(long_one, 0.03), distance);
    return write(line, path);
  };
  const Written fine = every(1e-5);
  for (const double distance : {1e-4, 1e-3, 0.01, 0.05}) {
    CAPTURE(distance);
    CHECK(every(distance).covered == Approx(fine.covered).margin(0.01));
    CHECK(every(distance).accepted);
  }
}

TEST_CASE("a first stretch that is looked at over several ticks is judged the same at every tick", "[render]") {
  for (const TypicalStroke& type : typical_strokes()) {
    const Character character = calligraphy_test::typical_character(type.id);
    ActiveStroke active;
    active.load(strokes(character)[0], place);
    const auto is_written = [](const StrokeFollower& follower) {
      return follower.is_at_end(1e-4) && follower.accepts(2e-4);
    };
    bool was_late = false, same = true;
    for (const double lost : {0.04, 0.1, 0.4, 0.9}) {           // [em]
      for (const double distance : {step, 5 * step}) {          // slow and fast
        for (const std::size_t ticks : {2UL, 4UL, 1000UL}) {    // before it is lifted
          for (const double shift : {0.0, 0.15, -0.15}) {       // of the writer [em]
            std::vector<Point> path =
                shifted(path_of(strokes(character)[0], place, distance), shift * em * Point(0.7, -0.3));
            const auto first = std::min(path.size() - 1, static_cast<std::size_t>(lost * em / distance));
            path.erase(path.begin() + 1, path.begin() + static_cast<std::ptrdiff_t>(first));
            path.resize(std::min(path.size(), ticks));
            StrokeFollower at_once, spread;
            at_once.load(active, em, normal);
            spread.load(active, em, normal, 1000.0);
            StrokeContact contact;
            for (StrokeFollower* follower : {&at_once, &spread}) follower->begin(path.front(), Point::Zero());
            for (const Point& tip : path) {
              const Point hand = tip + Point(0.1 * (tip.x() - path[0].x()), 0.2 * (tip.x() - path[0].x()));
              for (StrokeFollower* follower : {&at_once, &spread}) follower->update(tip, hand);
              was_late = was_late || spread.covered() < at_once.covered();
              contact.closest = active.nearest(tip, {}).closest;
              const double astray[] = {at_once.astray(hand, contact), spread.astray(hand, contact)};
              const double corridor = normal.corridor * em;
              same = same && (astray[0] == astray[1] || std::max(astray[0], astray[1]) <= corridor) &&
                     is_written(at_once) == is_written(spread);
            }
            for (StrokeFollower* follower : {&at_once, &spread}) follower->leave();
            same = same && spread.covered() == at_once.covered() && spread.accepts(0.0) == at_once.accepts(0.0);
          }
        }
      }
    }
    CAPTURE(type.id);
    CHECK(same);
    if (type.id == 1) CHECK(was_late);  // a long line
  }
}

TEST_CASE("a dot without length is written where it is begun", "[render]") {
  const Character dot = line_of(0.0);
  CHECK(write(dot, {from_start(0, 0)}).accepted);
  CHECK(write(dot, {from_start(0, 0)}).at_end);
  CHECK(write(dot, {from_start(0.1, 0.1)}).accepted);
}

TEST_CASE("following a stroke takes a few kilobytes", "[render]") { CHECK(sizeof(StrokeFollower) <= 2560); }

}  // namespace stroke_follower_tests
