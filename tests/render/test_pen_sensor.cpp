// What the pen sensor makes of samples: which are believed, what touches the paper, and what moved.
#include "../catch.hpp"

#include <cmath>
#include <limits>

#include <calligraphy/devices/device_profiles.hpp>

#include "render/pen_sensor.hpp"
#include "../hard_cases.hpp"

namespace pen_sensor_tests {

using namespace calligraphy;
using Eigen::Vector3d;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Sampled {
  PenSensor sensor;
  DeviceState sample;

  /// Of a pen that leaps.
  explicit Sampled(RendererOptions options = {}, const MotionMapping& mapping = {})
      : sensor((options.servo_rate = 1000.0, options.limits.max_acceleration = HUGE_VAL, options), mapping, {}) {}

  /// The next sample, 1 ms after the one before.
  const PenState& at(const Vector3d& position) {
    sample.position = position;
    sample.time += 0.001;
    return sensor.update(sample, {0, 0, 0});
  }
  const PenState& with(DeviceStatus status) {
    sample.status = status;
    const PenState& pen = at(sample.position);
    sample.status = DeviceStatus::ok;
    return pen;
  }
};

}  // namespace

TEST_CASE("the pen is where the mapping says, and its tip on the paper as long as the device is below it", "[render]") {
  MotionMapping mapping;
  mapping.rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  mapping.offset = {0.1, 0.2, 0.0};
  mapping.scale = 2.0;
  RendererOptions options;
  options.limits.max_speed = 100.0;
  Sampled pen(options, mapping);
  const PenState& above = pen.at({0.01, 0.02, 0.03});
  CHECK(above.device_point.isApprox(Vector3d(0.16, 0.22, 0.04)));
  CHECK(above.tip == above.device_point);
  CHECK(above.penetration == 0.0);
  const PenState& below = pen.at({0.01, -0.001, 0.03});
  CHECK(below.penetration == Approx(0.002));
  CHECK(below.tip.isApprox(Vector3d(0.16, 0.22, 0.0)));
}

TEST_CASE("a position that is not finite or farther than 1 km is a bad sample, in every coordinate", "[render]") {
  for (const double value : {not_a_number, HUGE_VAL, -HUGE_VAL, 1001.0, -1001.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      Sampled pen;
      pen.at({0, 0, 0});
      Vector3d position(0, 0, 0);
      position[axis] = value;
      CAPTURE(value, axis);
      CHECK(pen.at(position).status == TickStatus::bad_sample);
      CHECK(pen.at({0, 0, 0}).status == TickStatus::ok);
    }
  }
}

TEST_CASE("a pen in a hand is believed at every rate, and a sample off its course is not, wherever it is", "[render]") {
  calligraphy_test::Sequence random(3);
  for (const double rate : {100.0, 500.0, 1000.0, 3000.0, 10'000.0}) {
    for (const double scale : {0.5, 1.0, 3.0}) {
      for (const Capabilities& device : device_profiles()) {
        RendererOptions options;
        options.servo_rate = rate;
        MotionMapping mapping;
        mapping.scale = scale;
        PenSensor sensor(options, mapping, device);
        const double noise = 5.0 * std::max(device.encoder_step, 30e-6);
        // A hand that scribbles with up to 1 m/s and 90 m/s^2, in three directions.
        const double amplitude = 1.0 / 90.0 / std::sqrt(3.0), frequency = 90.0;
        Vector3d phase(random.between(0, 6), random.between(0, 6), random.between(0, 6)), shown(0, 0, 0);
        DeviceState sample;
        int refused = 0, believed = 0, last_event = 0, repeat = 0;
        for (int i = 0; i < 2000; ++i) {
          sample.time = i / rate;
          const double time = sample.time + random.between(-0.15, 0.15) / rate;  // a loop that does not know it is late
          const bool may_err = i > last_event + 5;
          // Unflagged; at high rates a velocity is mostly the encoder's and says little of where the pen is after three.
          if (may_err && random.next() < 0.05) repeat = static_cast<int>(random.between(1.0, rate > 1000.0 ? 2.0 : 4.0));
          const bool repeats = repeat > 0 && i > 0;
          if (repeats) --repeat;
          const Vector3d place = amplitude * (frequency * time + phase.array()).sin();
          if (!repeats) {
            const int clicking = static_cast<int>(random.between(0, 30));
            for (int axis = 0; axis < 3; ++axis) {
              const double click = axis == clicking ? 1.0 : 0.0;  // an encoder's, to and fro
              shown[axis] = device.encoder_step * (std::round(place[axis] / device.encoder_step) + click);
              if (device.encoder_step == 0.0) shown[axis] = place[axis];
            }
          }
          sample.position = shown;
          refused += sensor.update(sample, {0, 0, 0}).status != TickStatus::ok;
          if (repeats) last_event = i;
          if (!may_err || repeats || random.next() > 0.05) continue;
          // In place of the next one: beyond the way of 2.5 periods and what acceleration and noise add.
          last_event = ++i;
          sample.time = i / rate;
          const double beyond = noise + device.encoder_step + 2.5 / rate + 4.0 * 100.0 / (rate * rate);
          sample.position = shown + Vector3d(random.between(-1, 1), random.between(-1, 1), 0.1).normalized() *
                                        std::max(beyond, random.between(0, 0.1));
          believed += sensor.update(sample, {0, 0, 0}).status != TickStatus::bad_sample;
        }
        CAPTURE(rate, scale, device.name);
        CHECK(refused <= 2);  // of 2,000, where all of it comes at once, and a click
        CHECK(believed == 0);
      }
    }
  }
}

TEST_CASE("a tick of a nanosecond gives a pen no velocity that makes a jump plausible", "[render]") {
  RendererOptions options;
  options.servo_rate = 1000.0;
  PenSensor sensor(options, {}, {});
  DeviceState sample;
  const auto status_at = [&](double x, double elapsed) {
    sample.position.x() = x;
    sample.time += elapsed;
    return sensor.update(sample, {0, 0, 0}).status;
  };
  for (int i = 0; i < 20; ++i) status_at(0.0, 0.001);
  CHECK(status_at(1e-4, 1e-9) == TickStatus::ok);
  CHECK(status_at(4.5e-3, 0.001) == TickStatus::bad_sample);
}

TEST_CASE("a sensor that stands still while the force changes is dead where that is asked for, and lives once it moves",
          "[render]") {
  Capabilities device;
  device.coulomb_friction = 0.1;
  for (const bool asked : {false, true}) {
    RendererOptions options;
    options.servo_rate = 1000.0;
    if (asked) options.limits.max_standstill = 0.5;
    for (const double change : {0.89, -0.89, 0.91, -0.91}) {  // 0.5 N and four times the friction
      PenSensor sensor(options, {}, device);
      const double none = not_a_number;
      for (const bool says_so : {false, true}) {
        DeviceState sample;
        sample.position.x() = says_so ? 0.0001 : 0.0;
        int faults = 0;
        for (int i = 0; i < 2000; ++i) {
          const Vector3d force(0, i < 1000 || i > 1300 ? 1.0 : 1.0 + change, 0);
          sample.time += 0.001;
          sample.force = says_so ? force : Vector3d(none, none, none);
          faults += sensor.update(sample, force).status == TickStatus::bad_sample;
        }
        CAPTURE(asked, change, says_so);
        CHECK(faults == Approx(asked && std::abs(change) > 0.9 ? 500 : 0).margin(1));
        sample.position.x() += 1e-9;
        CHECK(sensor.update(sample, {0, 0, 0}).status == TickStatus::ok);
      }
    }
  }
}

TEST_CASE("the force is held for 4 ms of stale samples, and not for a fault", "[render]") {
  Sampled pen;
  pen.at({0, 0, -0.001});
  for (int i = 1; i <= 6; ++i) CHECK(pen.with(DeviceStatus::stale).holds_force == (i <= 4));
  CHECK(pen.at({0, 0, -0.001}).status == TickStatus::ok);
  CHECK_FALSE(pen.with(DeviceStatus::fault).holds_force);
}

TEST_CASE("after a gap the pen has not moved as far as the force is concerned, and moves on from there", "[render]") {
  Sampled pen;
  for (int i = 0; i < 12; ++i) pen.at({0, 0, 0});  // at first the force follows by its rate alone
  CHECK(pen.at({0.001, 0, 0}).motion().isApprox(Vector3d(0.001, 0, 0)));
  pen.with(DeviceStatus::stale);
  const PenState& after = pen.at({0.003, 0, 0});
  CHECK(after.motion() == Vector3d(0, 0, 0));
  CHECK(after.velocity_change() == Vector3d(0, 0, 0));
  const PenState& next = pen.at({0.004, 0, 0});
  CHECK(next.motion().isApprox(Vector3d(0.001, 0, 0)));
  CHECK(next.velocity_change().norm() > 0.0);
}

TEST_CASE("a pen unseen for more than 4 ms has no velocity, and the force follows it by its rate for 10 ms", "[render]") {
  for (const bool flagged : {false, true}) {
    Sampled pen;
    for (int i = 0; i < 20; ++i) pen.at({0, 0, 0});
    if (flagged) {
      for (int i = 0; i < 5; ++i) pen.with(DeviceStatus::stale);
    } else {
      pen.sample.time += 0.005;
    }
    CHECK(pen.at({0.005, 0, 0}).velocity == Vector3d(0, 0, 0));
    int unsure = 1;
    while (pen.at({0.005 + 1e-5 * unsure, 0, 0}).motion() == Vector3d(0, 0, 0)) ++unsure;
    CAPTURE(flagged);
    CHECK(unsure == Approx(10).margin(1));
  }
}

TEST_CASE("a bounce is contact but not on the paper, and what is higher or longer is neither", "[render]") {
  const RendererOptions options;  // lifted at 3 mm, or after 50 ms above 0.5 mm
  Sampled pen(options);
  CHECK_FALSE(pen.at({0, 0, 0.0002}).contact);
  CHECK(pen.at({0, 0, -0.0001}).contact);
  CHECK(pen.at({0, 0, 0.0004}).on_paper);
  for (int i = 1; i <= 49; ++i) {
    const PenState& bounce = pen.at({0, 0, 0.001});
    CHECK(bounce.contact);
    CHECK_FALSE(bounce.on_paper);
  }
  pen.at({0, 0, 0.001});
  CHECK_FALSE(pen.at({0, 0, 0.001}).contact);
  CHECK(pen.at({0, 0, -0.0001}).contact);
  CHECK_FALSE(pen.at({0, 0, 0.0031}).contact);
}

TEST_CASE("a pause is counted in ticks only where energy is accounted for", "[render]") {
  for (const bool accounts : {false, true}) {
    RendererOptions options;
    if (accounts) options.energy.budget = 0.1;
    Sampled pen(options);
    pen.at({0, 0, 0});
    pen.sample.time += 0.004;
    CHECK(pen.at({0, 0, 0}).ticks == (accounts ? 5 : 1));
    CHECK(pen.at({0, 0, 0}).ticks == 1);
  }
}

TEST_CASE("a restarted sensor knows nothing of the pen before", "[render]") {
  Sampled pen;
  pen.at({0, 0, -0.001});
  pen.at({0.5, 0, -0.001});  // too far: rejected
  for (int i = 0; i < 20; ++i) pen.at({0, 0, -0.001});
  pen.sensor.restart();
  const PenState& fresh = pen.at({0.3, 0, 0.001});
  CHECK(fresh.status == TickStatus::ok);
  CHECK_FALSE(fresh.contact);
  CHECK(fresh.motion() == Vector3d(0, 0, 0));
  CHECK(fresh.velocity == Vector3d(0, 0, 0));
  CHECK(pen.at({0.301, 0, 0.001}).motion() == Vector3d(0, 0, 0));
}

}  // namespace pen_sensor_tests
