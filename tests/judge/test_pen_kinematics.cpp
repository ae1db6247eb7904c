#include <calligraphy/judge/pen_kinematics.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <calligraphy/base/error.hpp>

#include "../catch.hpp"

using namespace calligraphy;

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
const Point slanted(std::cos(0.3), std::sin(0.3));

/// A straight stroke of minimum jerk (Flash and Hogan 1985), from where and when the samples end.
void draw_minimum_jerk(PenStroke& samples, double length, double duration, int steps) {
  const TimedPoint from = samples.empty() ? TimedPoint{} : samples.back();
  for (int i = samples.empty() ? 0 : 1; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    const double share = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    samples.push_back({from.point + share * length * slanted, from.time + s * duration});
  }
}

PenStroke minimum_jerk(double length, double duration, int steps) {
  PenStroke samples;
  draw_minimum_jerk(samples, length, duration, steps);
  return samples;
}

/// Straight at 0.4 per second, at these times.
PenStroke uniform(const std::vector<double>& times) {
  PenStroke samples;
  for (const double time : times) samples.push_back({Point(0.1, 0.7) + 0.4 * time * slanted, time});
  return samples;
}

PenStroke scaled(PenStroke samples, double size) {
  for (TimedPoint& sample : samples) sample.point = size * sample.point + Point(3.0, -2.0);
  return samples;
}

}  // namespace

TEST_CASE("a stroke of minimum jerk has one velocity peak of 1.875 times its mean speed", "[judge]") {
  struct Case {
    double duration, smoothness;
  };
  // Smoothness by NumPy, from the definition: bindings/python/tests/test_pen_kinematics.py, sparc().
  for (const Case& each : {Case{0.3, -1.4049006475}, Case{0.5, -1.4072705639}, Case{1.0, -1.4061884311},
                         Case{60.0, -1.3958696374}}) {
    CAPTURE(each.duration);
    const PenKinematics measured = pen_kinematics(minimum_jerk(0.5, each.duration, 200));
    CHECK(measured.duration == Approx(each.duration));
    CHECK(measured.path_length == Approx(0.5));
    CHECK(measured.mean_speed == Approx(0.5 / each.duration));
    // The low pass takes sigma^2 / 2 times the second derivative of the speed at its peak, which is -30 L / T^3; half a
    // step of the grid next to the peak takes less.
    const double lost = 0.5 * 0.01325 * 0.01325 * 30.0 * 0.5 / std::pow(each.duration, 3);
    CHECK(measured.peak_speed == Approx(1.875 * 0.5 / each.duration - lost).epsilon(2e-3));
    CHECK(measured.velocity_peaks == 1);
    CHECK(measured.smoothness == Approx(each.smoothness).epsilon(1e-9));
  }
}

TEST_CASE("coarse samples rounded to a thousandth of the em leave a fluent stroke one velocity peak", "[judge]") {
  for (const double duration : {0.4, 0.8, 1.2}) {
    CAPTURE(duration);
    PenStroke samples = minimum_jerk(0.4, duration, static_cast<int>(std::lround(duration / 0.04)));
    for (TimedPoint& sample : samples) sample.point = (1000.0 * sample.point).array().round() / 1000.0;
    CHECK(pen_kinematics(samples).velocity_peaks == 1);
  }
}

TEST_CASE("two strokes in one pen-down have two velocity peaks and are less smooth", "[judge]") {
  PenStroke samples = minimum_jerk(0.5, 0.5, 100);
  draw_minimum_jerk(samples, 0.5, 0.5, 100);
  CHECK(pen_kinematics(samples).velocity_peaks == 2);
  CHECK(pen_kinematics(samples).smoothness == Approx(-2.2365430369).epsilon(1e-9));
  draw_minimum_jerk(samples, 0.2, 0.4, 100);
  CHECK(pen_kinematics(samples).velocity_peaks == 3);
}

TEST_CASE("a velocity peak stands out by 5 percent of the peak speed", "[judge]") {
  // Slow waves of the speed, 1 - depth cos(2 pi t), which pass the filter almost unchanged: four maxima within 4 s.
  const auto peaks = [](double depth) {
    PenStroke samples;
    for (int i = 0; i <= 800; ++i) {
      const double time = i / 200.0;
      samples.push_back({(time - depth * std::sin(turn * time) / turn) * slanted, time});
    }
    return pen_kinematics(samples).velocity_peaks;
  };
  CHECK(peaks(0.02) == 1);
  CHECK(peaks(0.024) == 1);  // 0.048 of 1.024, which is 4.7 %
  CHECK(peaks(0.028) == 4);  // 0.056 of 1.028
}

TEST_CASE("smoothness and velocity peaks depend neither on the size nor on the place of the writing", "[judge]") {
  PenStroke samples = minimum_jerk(0.5, 0.4, 37);
  draw_minimum_jerk(samples, 0.3, 0.3, 20);
  const PenKinematics measured = pen_kinematics(samples);
  for (const double size : {0.04, 1000.0}) {
    const PenKinematics other = pen_kinematics(scaled(samples, size));
    CHECK(other.smoothness == Approx(measured.smoothness).epsilon(1e-10));
    CHECK(other.velocity_peaks == measured.velocity_peaks);
    CHECK(other.path_length == Approx(size * measured.path_length));
    CHECK(other.mean_speed == Approx(size * measured.mean_speed));
    CHECK(other.peak_speed == Approx(size * measured.peak_speed));
  }
}

TEST_CASE("a uniform motion has exactly its speed, however it is sampled", "[judge]") {
  for (const auto& times : {std::vector{0.0, 0.4},
                            {1.0, 1.0131, 1.2, 1.2003, 1.4},
                            {0.3, 0.3, 0.4, 0.4, 0.4, 0.7},
                            {7.0, 7.05001},
                            {0.0, 7000.0}}) {
    CAPTURE(times);
    const PenKinematics measured = pen_kinematics(uniform(times));
    CHECK(measured.path_length == Approx(0.4 * (times.back() - times.front())).epsilon(1e-10));
    CHECK(measured.mean_speed == Approx(0.4).epsilon(1e-10));
    CHECK(measured.peak_speed == Approx(0.4).epsilon(1e-9));
    CHECK(measured.velocity_peaks == 1);
    CHECK(measured.smoothness < -1.0);
  }
}

TEST_CASE("a tremor above the band of the hand is filtered out, one within is not", "[judge]") {
  const auto shaking = [](double frequency) {
    PenStroke samples;
    for (int i = 0; i <= 1000; ++i) {
      const double time = i / 1000.0;
      samples.push_back({Point(0.0, 0.01 * std::sin(turn * frequency * time)), time});
    }
    return pen_kinematics(samples);
  };
  CHECK(shaking(10.0).peak_speed == Approx(0.01 * turn * 10.0 * std::sqrt(0.5)).epsilon(0.03));  // -3 dB
  CHECK(shaking(2.0).peak_speed == Approx(0.01 * turn * 2.0 * std::pow(0.5, 0.5 * 0.04)).epsilon(0.01));
  // The speed of 7 Hz to and fro has 14 Hz, beyond the spectrum that counts for smoothness (by NumPy, as above).
  CHECK(shaking(7.0).smoothness == Approx(-2.3733573383).epsilon(1e-9));
  CHECK(shaking(40.0).peak_speed < 0.02 * 0.01 * turn * 40.0);
}

TEST_CASE("of samples with the same time the last counts", "[judge]") {
  const PenStroke samples = minimum_jerk(0.5, 0.4, 20);
  PenStroke repeated;
  for (const TimedPoint& sample : samples) {
    repeated.push_back({sample.point + Point(0.5, 0.3), sample.time});
    repeated.push_back(sample);
  }
  CHECK(pen_kinematics(repeated).path_length == pen_kinematics(samples).path_length);
  CHECK(pen_kinematics(repeated).smoothness == pen_kinematics(samples).smoothness);
}

TEST_CASE("a pen-down that is too short has no speed, and a pen at rest no smoothness", "[judge]") {
  const auto unmeasured = [](const PenKinematics& measured) {
    return std::isnan(measured.mean_speed) && std::isnan(measured.peak_speed) && measured.velocity_peaks == 0 &&
           std::isnan(measured.smoothness);
  };
  CHECK(unmeasured(pen_kinematics({})));
  CHECK(pen_kinematics({}).path_length == 0.0);
  CHECK(unmeasured(pen_kinematics(uniform({3.0}))));
  CHECK(unmeasured(pen_kinematics(PenStroke{{{0.1, 0.2}, 3.0}, {{0.4, 0.2}, 3.0}})));
  for (const double duration : {1e-300, 0.001, 0.0499}) {
    CAPTURE(duration);
    const PenKinematics measured = pen_kinematics(PenStroke{{{0.1, 0.2}, 0.0}, {{0.4, 0.2}, duration}});
    CHECK(unmeasured(measured));
    CHECK(measured.duration == duration);
    CHECK(measured.path_length == Approx(0.3));
  }
  const PenKinematics rest = pen_kinematics(PenStroke{{{0.1, 0.2}, 0.0}, {{0.1, 0.2}, 0.3}, {{0.1, 0.2}, 0.7}});
  CHECK(rest.mean_speed == 0.0);
  CHECK(rest.peak_speed == 0.0);
  CHECK(rest.velocity_peaks == 0);
  CHECK(std::isnan(rest.smoothness));
}

TEST_CASE("a pause of hours within a pen-down is measured with few points", "[judge]") {
  PenStroke samples = minimum_jerk(0.5, 0.5, 50);
  samples.push_back({samples.back().point, 86'000.0});
  const PenKinematics measured = pen_kinematics(samples);
  CHECK(measured.duration == 86'000.0);
  CHECK(measured.path_length == Approx(0.5));
  CHECK(measured.velocity_peaks == 1);
}

TEST_CASE("a sample that is not finite or earlier than the one before is refused by its number", "[judge]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  PenStroke samples = uniform({0.0, 0.1, 0.2});
  samples[1].time = 0.3;
  CHECK_THROWS_WITH(pen_kinematics(samples), "pen_down[2]: its time is before the previous one");
  samples[1].time = nan;
  CHECK_THROWS_WITH(pen_kinematics(samples), "pen_down[1] is not finite");
  samples = uniform({0.0, 0.1, infinity});
  CHECK_THROWS_AS(pen_kinematics(samples), ValueError);
  samples = uniform({0.0, 0.1, 0.2});
  samples[0].point.y() = nan;
  CHECK_THROWS_WITH(pen_kinematics(samples), "pen_down[0] is not finite");
}
