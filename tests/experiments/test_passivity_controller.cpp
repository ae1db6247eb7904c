// Passivity controller: Colgate's bound, and walls that it makes stable.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/passivity_controller.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"
#include "../held_mass.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::HeldMass;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;
const Vector3d lost(not_a_number, not_a_number, not_a_number);

Vector3d random_vector(Sequence& random, double largest) {
  const double x = random.between(-largest, largest), y = random.between(-largest, largest);
  return {x, y, random.between(-largest, largest)};
}

struct Press {
  double peak = 0.0;   ///< maximum force [N]
  double swing = 0.0;  ///< peak-to-peak motion over the last fifth [m]
};

/// A device of 45 g and 0.1 N s/m is pressed with 0.5 N onto a wall below 0, which it hits at 0.1 m/s, for 12 s. What
/// remains when the energy of sampling is removed, the damping of the device, has a time constant of 2 m / b = 0.9 s.
Press press(double stiffness, bool controlled, double saturation, int delay = 0, double period = 0.001) {
  constexpr double mass = 0.045, damping = 0.1, push = 0.5;
  Capabilities device;
  device.apparent_mass = mass;
  device.sample_delay = delay;
  const double usable = injectable_damping({device, 1.0 / period});
  PassivityController passivity({controlled ? usable : 0.0, delay}, period);
  HeldMass pen(mass, damping, period);
  pen.speed = -0.1;
  std::vector<double> places(static_cast<std::size_t>(delay) + 1, 0.0);
  const int ticks = static_cast<int>(12.0 / period);
  double lowest = infinity, highest = -infinity;
  Press result;
  for (int i = 0; i < ticks; ++i) {
    std::rotate(places.begin(), places.end() - 1, places.end());
    places[0] = pen.place;
    const double sample = places.back();
    Vector3d force = passivity.next({0.0, 0.0, sample}, {0.0, 0.0, std::max(0.0, -stiffness * sample)});
    force.z() = std::clamp(force.z(), -saturation, saturation);
    passivity.sent(force);
    result.peak = std::max(result.peak, std::abs(force.z()));
    pen.advance(force.z() - push);
    if (i < ticks - ticks / 5) continue;
    lowest = std::min(lowest, pen.place);
    highest = std::max(highest, pen.place);
  }
  result.swing = highest - lowest;
  return result;
}

}  // namespace

TEST_CASE("a pen that runs into a spring is damped by K T / 2, Colgate's bound", "[passivity controller]") {
  for (const double stiffness : {500.0, 5000.0}) {
    for (const double speed : {0.01, 0.1}) {
      for (const double period : {0.0001, 0.001, 0.01}) {
        for (const int axis : {0, 2}) {
          PassivityOptions options;
          options.max_damping = 1e6;
          PassivityController passivity(options, period);
          Vector3d place(0, 0, 0);
          passivity.next(place, Vector3d(0, 0, 0));
          passivity.sent(Vector3d(0, 0, 0));
          place[axis] = speed * period;
          passivity.next(place, -stiffness * place);
          Vector3d expected(0, 0, 0);
          expected[axis] = -0.5 * stiffness * period * speed;
          CHECK((passivity.damping() - expected).norm() < 1e-9 * expected.norm());
        }
      }
    }
  }
}

TEST_CASE("damping stays below its maximum, in plane and along the normal separately", "[passivity controller]") {
  PassivityOptions options;
  options.max_damping = 0.2;
  PassivityController passivity(options, 0.001);
  passivity.next({0, 0, 0}, {0, 0, 0});
  passivity.sent({0, 0, 0});
  const Vector3d force = passivity.next({3e-4, 4e-4, -2e-4}, {-30.0, -40.0, 20.0});
  CHECK(passivity.damping().isApprox(Vector3d(-0.2 * 0.3, -0.2 * 0.4, 0.2 * 0.2)));
  CHECK(force.isApprox(Vector3d(-30.0, -40.0, 20.0) + passivity.damping()));
}

TEST_CASE("with control a pen comes to rest on a wall 10 to 50 times stiffer than is passive, below the peak",
          "[passivity controller]") {
  // b = 0.1 N s/m and T = 1 ms: critical is 200 N/m.
  for (const double stiffness : {2001.0, 5000.0, 10'000.0}) {
    const Press with = press(stiffness, true, 7.9), without = press(stiffness, false, 7.9);
    INFO(stiffness << " N/m: peak " << with.peak << " N, peak-to-peak " << with.swing << " m, without "
                   << without.swing);
    CHECK(with.swing < 1e-6);
    CHECK(with.peak < 7.9);
    CHECK(without.swing > 1e-4);
  }
}

TEST_CASE("with control a pen comes to rest on a wall that a delayed sample makes unstable", "[passivity controller]") {
  for (const int delay : {1, 2}) {
    const Press with = press(1000.0, true, 7.9, delay), without = press(1000.0, false, 7.9, delay);
    INFO("delay " << delay << ": peak-to-peak " << with.swing << " m, without " << without.swing);
    CHECK(with.swing < 1e-6);
    CHECK(with.peak < 7.9);
    CHECK(without.swing > 1e-4);
  }
}

TEST_CASE("dissipated energy is no credit to vibrate on", "[passivity controller]") {
  PassivityOptions options;
  options.max_damping = 1e6;
  PassivityController passivity(options, 0.001);
  double place = 0.0;
  for (int i = 0; i < 1000; ++i) {  // 0.1 m against 1 N that the field does not request
    passivity.next({place, 0, 0}, {0, 0, 0});
    passivity.sent({i < 999 ? -1.0 : 0.0, 0, 0});
    place += 1e-4;
  }
  CHECK(passivity.energy_given() < -0.09);
  place -= 1e-4;  // where the force last dissipated; the spring below begins here
  passivity.next({place, 0, 0}, {0, 0, 0});
  passivity.sent({0, 0, 0});
  passivity.next({place + 1e-4, 0, 0}, {-1000.0 * 1e-4, 0, 0});
  CHECK(passivity.damping().x() == Approx(-0.5 * 1000.0 * 0.001 * 0.1));
}

TEST_CASE("without damping the desired force is unchanged", "[passivity controller]") {
  PassivityController passivity(PassivityOptions{}, 0.001);
  Sequence random(9);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d wanted = random_vector(random, 10.0);
    CHECK(passivity.next(random_vector(random, 0.01), wanted) == wanted);
    passivity.sent(random_vector(random, 3.0));
  }
}

TEST_CASE("a lost sample injects no damping and leaves every value finite", "[passivity controller]") {
  PassivityOptions options;
  options.max_damping = 10.0;
  PassivityController passivity(options, 0.001);
  Sequence random(10);
  bool finite = true;
  for (int i = 0; i < 2000; ++i) {
    const bool is_lost = i % 5 < 2;
    Vector3d position = random_vector(random, 0.001);
    if (is_lost) position[i % 3] = i % 2 ? not_a_number : infinity;
    const Vector3d force = passivity.next(position, random_vector(random, 3.0));
    finite = finite && force.allFinite() && std::isfinite(passivity.energy_given());
    if (is_lost) CHECK(passivity.damping() == Vector3d(0, 0, 0));
    passivity.sent(force);
  }
  CHECK(finite);
}

TEST_CASE("a step across a lost sample injects no damping, because it took more than a period",
          "[passivity controller]") {
  PassivityController passivity({.max_damping = 1e6}, 0.001);
  for (const bool is_lost : {true, false}) {
    passivity.restart();
    for (int i = 0; i < 2; ++i) {
      passivity.next(i == 1 && is_lost ? lost : Vector3d(0, 0, 0), {0, 0, 0});
      passivity.sent({0, 0, 0});
    }
    passivity.next({1e-4, 0, 0}, {-0.1, 0, 0});
    CHECK(passivity.damping().isZero() == is_lost);
  }
}

TEST_CASE("a restarted passivity controller behaves like a new one", "[passivity controller]") {
  PassivityOptions options;
  options.max_damping = 10.0;
  options.delay = 3;
  PassivityController used(options, 0.001);
  Sequence random(11);
  for (int i = 0; i < 102; ++i) {
    used.next(i % 7 ? random_vector(random, 0.001) : lost, random_vector(random, 3.0));
    used.sent(random_vector(random, 3.0));
  }
  used.next(lost, {0, 0, 0});
  used.sent({1.0, 0, 0});
  used.restart();
  PassivityController fresh(options, 0.001);
  for (int i = 0; i < 100; ++i) {
    const Vector3d position = random_vector(random, 0.01), wanted = random_vector(random, 3.0);
    const Vector3d force = fresh.next(position, wanted);
    CHECK(used.next(position, wanted) == force);
    CHECK(used.damping() == fresh.damping());
    fresh.sent(force);
    used.sent(force);
  }
}

TEST_CASE("an option of the passivity controller out of range is named with its value", "[passivity controller]") {
  const auto complaint = [](const PassivityOptions& options, double period) -> std::string {
    try {
      PassivityController(options, period);
    } catch (const ValueError& error) {
      return error.what();
    }
    return "";
  };
  const auto names = [&](const PassivityOptions& options, double period, const std::string& text) {
    const std::string found = complaint(options, period);
    INFO(found << " should have " << text);
    CHECK(found.find("passivity: " + text) == 0);
  };
  CHECK(complaint({}, 0.001).empty());
  for (const auto& [value, text] : {std::pair{-0.5, "-0.5"}, {not_a_number, "nan"}, {-infinity, "-inf"}}) {
    names({.max_damping = value}, 0.001, std::string("max_damping = ") + text);
    names({}, value, std::string("period = ") + text);
  }
  names({.max_damping = infinity}, 0.001, "max_damping = inf");
  names({}, 0.0, "period = 0");
  names({}, infinity, "period = inf");
  names({.delay = -1}, 0.001, "delay = -1");
  names({.delay = 16}, 0.001, "delay = 16");
  names({.delay = std::numeric_limits<int>::max()}, 0.001, "delay = 2147483647");
}

TEST_CASE("the passivity controller does not allocate", "[passivity controller]") {
  PassivityOptions options;
  options.max_damping = 10.0;
  options.delay = 2;
  PassivityController passivity(options, 0.001);
  Sequence random(12);
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 10'000; ++i) {
    passivity.sent(passivity.next(i % 11 ? random_vector(random, 0.01) : lost, random_vector(random, 3.0)));
  }
  passivity.restart();
  CHECK(calligraphy_test::allocations() == before);
}
