#include "drawings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pens.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

Point normal_point(Random& random, double deviation) {
  const double x = random.normal();
  return deviation * Point(x, random.normal());
}

Point left_of(const Point& direction) { return {-direction.y(), direction.x()}; }

/// Three waves along a stroke, their deviations per axis.
class Distortion {
 public:
  Distortion(Random& random, Noise noise, double size) {
    const double per_axis = size / std::numbers::sqrt2;
    if (noise == Noise::displacement) waves_[0] = normal_point(random, per_axis);
    if (noise != Noise::distortion) return;
    waves_[0] = normal_point(random, per_axis * std::sqrt(1.0 / 3.0));
    for (std::size_t i = 1; i < 3; ++i) waves_[i] = normal_point(random, per_axis * std::sqrt(2.0 / 3.0));
  }
  Point operator()(double share) const {
    const double angle = std::numbers::pi * share;
    return waves_[0] + std::cos(angle) * waves_[1] + std::cos(2.0 * angle) * waves_[2];
  }

 private:
  std::array<Point, 3> waves_ = {Point::Zero(), Point::Zero(), Point::Zero()};
};

/// Plane waves over the square.
class Warp {
 public:
  Warp(Random& random, double size, double em) {
    constexpr double shortest = 0.5, longest = 1.5;  // [em]
    for (Wave& wave : waves_) {
      const double angle = random.between(0.0, 2.0 * std::numbers::pi);
      const double number = 2.0 * std::numbers::pi / (random.between(shortest, longest) * em);
      wave.number = number * Point(std::cos(angle), std::sin(angle));
      wave.phase = random.between(0.0, 2.0 * std::numbers::pi);
      wave.size = normal_point(random, size / std::sqrt(static_cast<double>(waves_.size())));
    }
  }
  Point operator()(const Point& at) const {
    Point moved = Point::Zero();
    for (const Wave& wave : waves_) moved += std::sin(wave.number.dot(at) + wave.phase) * wave.size;
    return moved;
  }

 private:
  struct Wave {
    Point number = Point::Zero(), size = Point::Zero();
    double phase = 0.0;
  };
  std::array<Wave, 8> waves_;
};

/// Mean over `length` of arc, its ends kept.
StrokeLine rounded(const StrokeLine& line, double length) {
  constexpr int steps = 16;
  return line.moved([&](const Point&, double share) {
    const double arc = share * line.length();
    const double reach = std::min({0.5 * length, arc, line.length() - arc});
    Point sum = Point::Zero();
    for (int i = 0; i <= steps; ++i) sum += line.at(arc + reach * (2.0 * i / steps - 1.0));
    return Point(sum / (steps + 1));
  });
}

/// In even steps of at most `step` [m].
StrokeLine resampled(const StrokeLine& line, double step) {
  const int count = std::max(2, static_cast<int>(std::ceil(line.length() / step)));
  std::vector<Point> points;
  for (int i = 0; i <= count; ++i) points.push_back(line.at(line.length() * i / count));
  return StrokeLine(std::move(points));
}

/// Shorter or longer at each end, along the tangent there [m].
StrokeLine with_ends(const StrokeLine& line, double before, double after) {
  const double length = line.length();
  if (!(length > 0.0)) return line;
  std::vector<Point> points = line.part(std::max(0.0, -before / length), 1.0 - std::max(0.0, -after / length)).points();
  if (before > 0.0) points.insert(points.begin(), line.at(0.0) - before * line.tangent(0.0));
  if (after > 0.0) points.push_back(line.at(length) + after * line.tangent(length));
  return StrokeLine(std::move(points));
}

}  // namespace

std::vector<StrokeLine> drawn_by_people(const std::vector<StrokeLine>& lines, const PeopleDraw& people, double em,
                                        std::uint64_t seed) {
  Random random(seed);
  const double angle = random.between(0.0, 2.0 * std::numbers::pi);
  const double away = people.shift * em * std::sqrt(random.next());
  const Point shift(away * std::cos(angle), away * std::sin(angle));
  const Warp warp(random, people.noise == Noise::warp ? people.noise_size * em : 0.0, em);
  std::vector<StrokeLine> drawn;
  for (const StrokeLine& line : lines) {
    const Distortion distortion(random, people.noise, people.noise_size * em);
    const double scale = 1.0 + people.scale * random.between(-1.0, 1.0);
    const double most = std::min(people.ends * em, 0.2 * line.length());
    const double before = most * random.between(-1.0, 1.0), after = most * random.between(-1.0, 1.0);
    const double phase = random.between(0.0, 2.0 * std::numbers::pi);
    StrokeLine result = resampled(people.ends > 0.0 ? with_ends(line, before, after) : line, 0.005 * em);
    if (people.rounding > 0.0) result = rounded(result, people.rounding * em);
    const StrokeLine smooth = result;
    const Point start = smooth.at(0.0);
    const double wave = people_speed * em / 10.0;
    drawn.push_back(smooth.moved([&](const Point& point, double share) {
      const double arc = share * smooth.length();
      const double aside = people.tremor * em * std::sin(2.0 * std::numbers::pi * arc / wave + phase);
      return Point(start + scale * (point - start) + shift + distortion(share) + warp(point) +
                   aside * left_of(smooth.tangent(arc)));
    }));
  }
  return drawn;
}

Attempts later_strokes(double em, double noise, double different) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random& random) {
    std::vector<Attempt> later;
    for (std::size_t i = due + 1; i < lines.size(); ++i) {
      const double difference = mean_distance(lines[due], lines[i]) / em;
      if (!(difference > different)) continue;
      const Distortion distortion(random, Noise::distortion, noise * em);
      later.push_back(
          {lines[i].moved([&](const Point& point, double share) { return Point(point + distortion(share)); }),
           difference});
    }
    return later;
  };
}

Attempts part_of_stroke(double from, double to, double shortest) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    const StrokeLine& line = lines[due];
    if (!(line.length() > 0.0) || line.length() < shortest) return std::vector<Attempt>{};
    return std::vector<Attempt>{{line.part(from, to)}};
  };
}

Attempts going_on(const Attempts& attempts) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random& random) {
    std::vector<Attempt> followed = attempts(lines, due, random);
    for (Attempt& attempt : followed) attempt.goes_on = true;
    return followed;
  };
}

Attempts backwards() {
  return [](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    return std::vector<Attempt>{{lines[due].reversed()}};
  };
}

Attempts doubled_back(double share) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    std::vector<Point> points = lines[due].part(0.0, share).points();
    for (std::size_t i = points.size() - 1; i > 0; --i) points.push_back(points[i - 1]);
    return std::vector<Attempt>{{StrokeLine(std::move(points))}};
  };
}

Attempts chord(double em, double different) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    const StrokeLine& line = lines[due];
    StrokeLine straight({line.at(0.0), line.at(line.length())});
    const double difference = mean_distance(line, straight) / em;
    if (!(difference > different)) return std::vector<Attempt>{};
    return std::vector<Attempt>{{std::move(straight), difference}};
  };
}

Attempts displaced_sideways(double distance) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    const StrokeLine& line = lines[due];
    const Point way = distance * left_of((line.at(line.length()) - line.at(0.0)).normalized());
    return std::vector<Attempt>{{line.moved([&](const Point& point, double) { return Point(point + way); })}};
  };
}

StrokeLine zigzag_about(const StrokeLine& line, const Zigzag& zigzag, double em) {
  const double length = line.length(), wave = std::min(zigzag.wavelength * em, length);
  const int steps = std::max(64, static_cast<int>(48.0 * length / wave));
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) {
    const double arc = length * i / steps;
    const double phase = (wave > 0.0 ? arc / wave : 0.0) + (zigzag.at_extreme ? 0.25 : 0.0);
    const double angle = 2.0 * std::numbers::pi * phase;
    const double height = zigzag.sine ? std::sin(angle) : std::asin(std::sin(angle)) * 2.0 / std::numbers::pi;
    points.push_back(line.at(arc) + zigzag.amplitude * em * height * left_of(line.tangent(arc)));
  }
  return StrokeLine(std::move(points));
}

Attempts zigzags(double em, double amplitude, bool sine) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    std::vector<Attempt> attempts;
    for (const double wavelength : {0.1, 0.2, 0.3, 0.5}) {
      for (const bool at_extreme : {false, true}) {
        attempts.push_back(
            {zigzag_about(lines[due], {amplitude, wavelength, sine, at_extreme}, em), lines[due].length() / em});
      }
    }
    return attempts;
  };
}

Attempts tremors(double em) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    std::vector<Attempt> attempts;
    if (lines[due].length() >= shortest_line * em) return attempts;
    for (const double amplitude : {0.02, 0.03, 0.04}) {
      for (const double wavelength : {0.03, 0.05}) {
        attempts.push_back({zigzag_about(lines[due], {amplitude, wavelength, true}, em), lines[due].length() / em});
      }
    }
    return attempts;
  };
}

StrokeLine loops_along(const StrokeLine& line, double radius, bool clockwise, double em) {
  constexpr int steps = 48;  // per loop
  const int loops = std::max(3, static_cast<int>(std::lround(line.length() / (2.0 * radius * em))));
  std::vector<Point> points;
  for (int i = 0; i <= loops * steps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / steps * (clockwise ? -1.0 : 1.0);
    const Point centre = line.at(line.length() * i / (loops * steps));
    points.push_back(centre + radius * em * Point(std::cos(angle), std::sin(angle)));
  }
  return StrokeLine(std::move(points));
}

Attempts circling(double em, bool along_short) {
  return [=](const std::vector<StrokeLine>& lines, std::size_t due, Random&) {
    const StrokeLine& line = lines[due];
    std::vector<Attempt> attempts;
    if ((line.length() < shortest_line * em) != along_short) return attempts;
    for (const double radius : {0.03, 0.05}) {
      for (const bool clockwise : {false, true}) {
        attempts.push_back({loops_along(line, radius, clockwise, em), line.length() / em});
      }
    }
    return attempts;
  };
}

}  // namespace calligraphy_test
