// Friction of the paper: sticks without drift, whatever the rate, slides at mu N, and generates no energy.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <calligraphy/render/paper_friction.hpp>

#include "../hard_cases.hpp"
#include "../held_mass.hpp"

using namespace calligraphy;
using calligraphy_test::HeldMass;
using calligraphy_test::Sequence;

namespace {

constexpr int rates[] = {100, 500, 1000, 4000, 10'000, 20'000};

constexpr double coefficient = 0.3;
constexpr double pressed = 1.0;               // [N]
constexpr double sliding_force = 0.3;         // mu N [N]
constexpr double max_stretch = 0.3e-3;        // mu N / stiffness [m]
constexpr double vibration_frequency = 20.0;  // a whole number of samples a period at each rate [Hz]

constexpr int last_second = 20;

FrictionOptions usual_options() {
  FrictionOptions options;
  options.coefficient = coefficient;
  options.stiffness = sliding_force / max_stretch;
  return options;
}

/// Fades in over the first second, so that nothing breaks away at the start.
double biased_vibration(double bias, double amplitude, double time) {
  return std::min(1.0, time) * (bias + amplitude * std::sin(2.0 * std::numbers::pi * vibration_frequency * time));
}

/// Difference between the mean of a value over the last second and over the third.
template <typename Step>
double drift(int rate, Step step) {
  double early = 0.0, late = 0.0;
  for (int i = 0; i < (last_second + 1) * rate; ++i) {
    const double value = step(static_cast<double>(i) / rate);
    if (i / rate == 2) early += value / rate;
    if (i / rate == last_second) late += value / rate;
  }
  return late - early;
}

/// Drift of a mass of 0.2 kg with 6 N s/m, held firmly so that it is passive at 100 Hz too: b > K T / 2. The bias is
/// half of mu N.
double drift_of_mass(int rate, double amplitude) {
  const FrictionOptions options = usual_options();
  const double period = 1.0 / rate;
  PaperFriction friction;
  HeldMass mass(0.2, 6.0, period);
  return drift(rate, [&](double time) {
    const double force = friction.update(options, {mass.place, 0.0}, pressed).x();
    mass.advance(force + biased_vibration(0.5 * sliding_force, amplitude * sliding_force, time));
    return mass.place;
  });
}

/// Drift of the anchor of a pen that vibrates about half the maximum stretch.
double drift_of_hold(int rate, double amplitude) {
  const FrictionOptions options = usual_options();
  PaperFriction friction;
  return drift(rate, [&](double time) {
    const double tip = biased_vibration(0.5 * max_stretch, amplitude, time);
    return tip + friction.update(options, {tip, 0.0}, pressed).x() / options.stiffness;
  });
}

/// Several times around a random closed path of `count` steps, each shorter than `step`.
std::vector<Point> random_path(Sequence& random, int count, double step, bool closed) {
  std::vector<Point> path = {{0.0, 0.0}};
  Point direction(0.0, 0.0);
  for (int i = 0; i < count; ++i) {
    if (i % 7 == 0) direction = random.point(-1.0, 1.0);
    path.push_back(path.back() + 0.35 * step * (direction + random.point(-1.0, 1.0)));
  }
  if (closed) {
    const Point gap = path.front() - path.back();
    const int way_back = static_cast<int>(std::ceil(gap.norm() / step)) + 1;
    const Point from = path.back();
    for (int i = 1; i <= way_back; ++i) path.push_back(from + gap * i / way_back);
    const std::vector<Point> once = path;
    for (int round = 0; round < 3; ++round) path.insert(path.end(), once.begin() + 1, once.end());
  }
  return path;
}

/// Maximum work done by the force on the pen up to any moment of a path, by the trapezoidal rule [J].
double max_given(const FrictionOptions& options, const std::vector<Point>& path) {
  PaperFriction friction;
  double given = 0.0, most = 0.0;
  Point last_force(0.0, 0.0), last_tip = path.front();
  for (const Point& tip : path) {
    const Point force = friction.update(options, tip, pressed);
    given += 0.5 * (last_force + force).dot(tip - last_tip);
    most = std::max(most, given);
    last_force = force;
    last_tip = tip;
  }
  return most;
}

}  // namespace

TEST_CASE("a mass on the paper does not drift under biased vibration, at any rate", "[render]") {
  for (const int rate : rates) {
    INFO(rate << " Hz");
    CHECK(std::abs(drift_of_mass(rate, 0.3)) < 1e-9);
  }
}

TEST_CASE("the anchor of a vibrating pen does not drift, at any rate", "[render]") {
  for (const int rate : rates) {
    for (const double amplitude : {10e-6, 100e-6}) {
      INFO(rate << " Hz, " << amplitude << " m");
      CHECK(std::abs(drift_of_hold(rate, amplitude)) < 1e-9);
    }
  }
}

TEST_CASE("break-away friction depends on the path alone, not on the rate", "[render]") {
  // Back and forth between positions reached at instants that all rates share.
  const FrictionOptions options = usual_options();
  std::vector<std::vector<double>> forces;
  for (const int rate : rates) {
    Sequence random(31);
    PaperFriction friction;
    friction.update(options, {0.0, 0.0}, pressed);
    double from = 0.0;
    std::vector<double> found;
    for (int leg = 0; leg < 200; ++leg) {
      const double to = from + random.between(-2.0, 2.0) * max_stretch;
      const int samples = rate / 100;
      double force = 0.0;
      for (int i = 1; i <= samples; ++i) {
        force = friction.update(options, {from + (to - from) * i / samples, 0.0}, pressed).x();
      }
      found.push_back(force);
      from = to;
    }
    forces.push_back(found);
  }
  for (const auto& found : forces) {
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(forces[0][i]).margin(1e-12));
  }
}

TEST_CASE("on a curved path the rates converge, and differ by far less than a hand can feel", "[render]") {
  const FrictionOptions options = usual_options();
  const auto after = [&](int rate) {  // a figure of eight, 10 mm wide, in a second: 0.07 m/s
    PaperFriction friction;
    std::vector<Point> forces;
    for (int i = 0; i <= rate; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / rate;
      const Point force = friction.update(options, {0.005 * std::sin(angle), 0.005 * std::sin(2.0 * angle)}, pressed);
      if (i > 0 && i % (rate / 20) == 0) forces.push_back(force);
    }
    return forces;
  };
  const auto finest = after(20'000);
  const auto furthest = [&](int rate) {
    const auto forces = after(rate);
    double most = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) most = std::max(most, (forces[i] - finest[i]).norm());
    return most;
  };
  CHECK(furthest(500) < 0.05 * sliding_force);  // force JND: 6 to 10 %
  CHECK(furthest(4000) < 0.25 * furthest(500));
  CHECK(furthest(10'000) <= furthest(4000));
}

TEST_CASE("sliding friction is mu N against the motion", "[render]") {
  for (const double pressed : {0.1, 1.0, 3.0}) {
    for (const Point& direction : {Point(1.0, 0.0), Point(-0.6, 0.8)}) {
      PaperFriction friction;
      Point force(0.0, 0.0);
      for (int i = 0; i <= 100; ++i) {
        force = friction.update(usual_options(), 1e-4 * i * direction, pressed);  // 0.1 m/s
      }
      INFO(pressed << " N");
      CHECK((force + coefficient * pressed * direction).norm() < 1e-9);
    }
  }
}

TEST_CASE("the spring of friction never exceeds mu N", "[render]") {
  const FrictionOptions options = usual_options();
  Sequence random(5);
  PaperFriction friction;
  double largest = 0.0;
  Point tip(0.0, 0.0);
  for (int i = 0; i < 20'000; ++i) {
    tip += random.point(-1.0, 1.0) * std::pow(10.0, random.between(-7.0, -3.0));
    const double pressed = random.between(0.1, 2.0);
    const double force = friction.update(options, tip, pressed).norm();
    largest = std::max(largest, force / (coefficient * pressed));
  }
  CHECK(largest <= 1.0 + 1e-9);
  CHECK(largest > 0.99);
}

TEST_CASE("a new contact begins without friction", "[render]") {
  PaperFriction friction;
  for (const Point& place : {Point(0.0, 0.0), Point(0.1, -0.2)}) {
    CHECK(friction.update(usual_options(), place, pressed) == Point(0.0, 0.0));
    CHECK(friction.update(usual_options(), place + Point(0.001, 0.0), pressed).norm() > 0.2);
    friction.release();
  }
}

TEST_CASE("when the normal force on a resting pen falls and rises, friction follows without a step", "[render]") {
  const FrictionOptions options = usual_options();
  PaperFriction friction;
  friction.update(options, {0.0, 0.0}, pressed);
  Point last(0.0, 0.0);
  for (int i = 1; i <= 28; ++i) last = friction.update(options, {1e-5 * i, 0.0}, pressed);  // 0.01 m/s
  const Point held = last;
  REQUIRE(held.norm() > 0.05);
  double max_step = 0.0;
  bool along = true;
  for (const double to : {0.1, 1.0, 0.0, 1.0}) {
    const double from = to > 0.5 ? last.norm() / sliding_force : 1.0;
    for (int i = 0; i <= 1000; ++i) {
      const double pressed = from + (to - from) * i / 1000.0;
      const Point force = friction.update(options, {2.8e-4, 0.0}, pressed);
      max_step = std::max(max_step, (force - last).norm());
      along = along && force.x() <= 0.0 && force.y() == 0.0;
      last = force;
      if (to < from && pressed < 0.2 && pressed >= 0.1) CHECK(force.norm() > 0.9 * coefficient * 0.1);
    }
  }
  CHECK(along);
  CHECK(max_step <= 0.0004);  // mu N falls by 0.3 mN per tick
}

TEST_CASE("break-away friction generates no energy on any path, however coarse", "[render]") {
  // (z0 + z1) . dw >= 0, because the anchor only moves along z1, and then no z is longer than z1.
  Sequence random(7);
  for (const double step : {1e-6, 3e-5, 3e-4, 3e-3}) {
    for (int i = 0; i < 100; ++i) {
      INFO("steps up to " << step << " m");
      CHECK(max_given(usual_options(), random_path(random, 300, step, i % 2 == 0)) <= 1e-12);
    }
  }
}

TEST_CASE("friction is finite where its formulas nearly vanish or overflow", "[render]") {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const FrictionOptions options = usual_options();
  for (const double pressed : {0.0, least, 1e-310, 1e-200, 1.0, -1.0}) {
    PaperFriction friction;
    bool finite = true, bounded = true;
    double place = 0.0;
    for (const double way : {0.0, 0.0, least, 1e-310, 1e-160, 1e-20, 1e-6, -1e-6, 1.0, 1e3, -1e3, 1e200, -1e200}) {
      place += way;
      const Point force = friction.update(options, {place, -place}, pressed);
      finite = finite && force.allFinite();
      bounded = bounded && force.norm() <= coefficient * std::max(0.0, pressed) * (1 + 1e-9);
    }
    INFO(pressed << " N");
    CHECK(finite);
    CHECK(bounded);
  }
}

TEST_CASE("without normal force there is no friction, and a pen that does not move feels none", "[render]") {
  PaperFriction friction;
  for (int i = 0; i < 100; ++i) {
    CHECK(friction.update(usual_options(), {1e-4 * i, 0.0}, 0.0) == Point(0.0, 0.0));
  }
  friction.release();
  for (int i = 0; i < 100; ++i) {
    CHECK(friction.update(usual_options(), {0.01, 0.02}, pressed) == Point(0.0, 0.0));
  }
}
