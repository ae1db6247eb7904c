#include "hostile_strokes.hpp"
#include "experiments/stroke_queries.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include <calligraphy/model/character_list.hpp>

#include "hostile_queries.hpp"

namespace calligraphy_test {
namespace {

using Elements = std::vector<std::vector<Point>>;

int draw_count(RandomPoints& random) { return 50 + static_cast<int>(random.index(700)); }

/// Elements of any family end to end; some disconnected, some on top of one another.
Elements draw_elements(RandomPoints& random) {
  Elements elements;
  const std::size_t count = 1 + random.index(5);
  const bool joined = !one_in(random, 4);
  for (std::size_t i = 0; i < count; ++i) {
    constexpr int degrees[] = {2, 3, 3, 4};
    const int degree = degrees[random.index(std::size(degrees))];
    // Strokes have lines and gentle curves; the other families are there to break the tracker.
    const auto families = curve_families();
    const std::size_t family = one_in(random, 2) ? random.index(3) : random.index(families.size());
    auto points = families[family].draw(random, degree);
    if (joined && !elements.empty()) {
      const Point move = elements.back().back() - points.front();
      for (Point& point : points) point += move;
      points.front() = elements.back().back();
    }
    elements.push_back(points);
  }
  return elements;
}

Point on(const std::vector<Point>& points, double t) {
  std::array<Point, 5> row;
  std::copy(points.begin(), points.end(), row.begin());
  for (std::size_t n = points.size() - 1; n > 0; --n) {
    for (std::size_t i = 0; i < n; ++i) row[i] += t * (row[i + 1] - row[i]);
  }
  return row[0];
}

/// A wave of two sines.
class Wave {
 public:
  Wave(RandomPoints& random, double amplitude, double slowest, double fastest) {
    for (Sine& sine : sines_) {
      sine = {amplitude * random.next(), magnitude(random, slowest, fastest), random.between(0.0, 6.3)};
    }
  }
  double at(int tick) const {
    double sum = 0.0;
    for (const Sine& sine : sines_) sum += sine.amplitude * std::sin(sine.frequency * tick + sine.phase);
    return sum;
  }

 private:
  struct Sine {
    double amplitude, frequency, phase;
  };
  std::array<Sine, 2> sines_;
};

/// Some pens jump, or are lost for a tick.
PenPath placed(RandomPoints& random, const Elements& elements, std::vector<Point> ticks) {
  const Place place(random);
  const bool jumps = one_in(random, 3);
  PenPath path;
  for (const auto& element : elements) {
    auto& points = path.elements.emplace_back();
    for (const Point& point : element) points.push_back(place(point));
  }
  for (Point& tick : ticks) {
    if (jumps && one_in(random, 100)) tick = draw_query(random, elements[random.index(elements.size())]);
    path.ticks.push_back(place(tick));
    if (jumps && one_in(random, 500)) path.ticks.back() = draw_lost_query(random);
  }
  return path;
}

/// Written as by a person: the strokes of a character of the built-in set.
PenPath real_stroke(RandomPoints& random) {
  const auto& characters = calligraphy::built_in_characters().characters;
  const auto& character = characters[random.index(characters.size())];
  calligraphy::StrokeQueryOptions options;
  options.em = magnitude(random, -2.0, 0.0);
  options.speed = options.em * magnitude(random, -1.0, 1.0);
  options.wobble = options.em * magnitude(random, -3.0, -0.5);
  options.seed = random.bits();
  auto strokes = calligraphy::stroke_queries({&character, 1}, options);
  auto& stroke = strokes[random.index(strokes.size())];
  return {std::move(stroke.elements), std::move(stroke.path)};
}

PenPath along(RandomPoints& random) {
  const Elements elements = draw_elements(random);
  const int count = draw_count(random);
  const double amplitude = magnitude(random, -8.0, 0.0);
  const Wave x(random, amplitude, -3.0, -0.5), y(random, amplitude, -3.0, -0.5);
  std::vector<Point> ticks;
  for (int i = 0; i < count; ++i) {
    const double s = static_cast<double>(elements.size()) * i / count;
    const auto element = std::min(static_cast<std::size_t>(s), elements.size() - 1);
    ticks.push_back(on(elements[element], s - static_cast<double>(element)) + Point(x.at(i), y.at(i)));
  }
  if (one_in(random, 3)) std::reverse(ticks.begin(), ticks.end());
  return placed(random, elements, ticks);
}

PenPath wandering(RandomPoints& random) {
  const Elements elements = draw_elements(random);
  const Point centre = draw_query(random, elements[random.index(elements.size())]);
  const double reach = magnitude(random, -2.0, 1.0);
  const Wave x(random, reach, -3.0, -0.5), y(random, reach, -3.0, -0.5);
  std::vector<Point> ticks;
  for (int i = draw_count(random); i > 0; --i) ticks.push_back(centre + Point(x.at(i), y.at(i)));
  return placed(random, elements, ticks);
}

/// Straight from one hard position to another, at constant speed.
PenPath across(RandomPoints& random) {
  const Elements elements = draw_elements(random);
  const Point from = draw_query(random, elements[random.index(elements.size())]);
  const Point to = draw_query(random, elements[random.index(elements.size())]);
  const int count = draw_count(random);
  std::vector<Point> ticks;
  for (int i = 0; i <= count; ++i) ticks.push_back(from + (static_cast<double>(i) / count) * (to - from));
  return placed(random, elements, ticks);
}

/// A hand that holds the pen still, where the nearest point is hard to determine.
PenPath tremor(RandomPoints& random) {
  const Elements elements = draw_elements(random);
  const auto& element = elements[random.index(elements.size())];
  Point pen = one_in(random, 4) ? draw_tie(random, element) : draw_query(random, element);
  const double step = one_in(random, 8) ? 0.0 : magnitude(random, -17.0, -2.0);
  std::vector<Point> ticks;
  for (int i = draw_count(random); i > 0; --i) {
    ticks.push_back(pen);
    pen += step * random.in_disc();
  }
  return placed(random, elements, ticks);
}

/// Slower and slower towards a position where the nearest point is hard to determine, and beyond it.
PenPath approaching(RandomPoints& random) {
  const Elements elements = draw_elements(random);
  const auto& element = elements[random.index(elements.size())];
  const Point at = one_in(random, 4) ? draw_tie(random, element) : draw_query(random, element);
  const Point direction = random.direction();
  const double shrink = random.between(0.8, 0.99);
  std::vector<Point> ticks;
  double way = 1.0;
  for (int i = draw_count(random); i > 0 && way > 1e-17; --i) {
    ticks.push_back(at + way * direction);
    way *= shrink;
  }
  const std::vector<Point> there = ticks;
  for (auto tick = there.rbegin(); tick != there.rend(); ++tick) ticks.push_back(2.0 * at - *tick);
  return placed(random, elements, ticks);
}

PenPath jumping(RandomPoints& random) {
  const Elements elements = draw_elements(random);
  std::vector<Point> ticks;
  for (int i = draw_count(random) / 4; i > 0; --i) {
    ticks.push_back(draw_query(random, elements[random.index(elements.size())]));
  }
  return placed(random, elements, ticks);
}

constexpr PathFamily hostile_paths[] = {
    {"real stroke", real_stroke}, {"along", along},   {"wandering", wandering}, {"across", across},
    {"approaching", approaching}, {"tremor", tremor}, {"jumping", jumping},
};

}  // namespace

std::span<const PathFamily> path_families() { return hostile_paths; }

Point draw_lost_query(RandomPoints& random) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double lost[] = {infinity, -infinity, std::numeric_limits<double>::quiet_NaN(), 1e200, -1e300};
  Point query = random.point(-1.0, 1.0);
  const double value = lost[random.index(std::size(lost))];
  (one_in(random, 2) ? query.x() : query.y()) = value;
  if (one_in(random, 4)) query = Point(value, value);
  return query;
}

}  // namespace calligraphy_test
