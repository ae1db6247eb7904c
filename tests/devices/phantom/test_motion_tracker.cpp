// The tracker with single reports, without a link; test_phantom_device.cpp tests it through a device.
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>

#include "devices/phantom/motion_tracker.hpp"

#include "../../catch.hpp"

using namespace calligraphy;
using namespace calligraphy::phantom;

namespace {

WireProfile profile_with(bool sequence) {
  WireProfile profile = wire_profile("simulated");  // 2425 counts per radian, the second joint counting backwards
  if (!sequence) profile.sequence.reset();
  return profile;
}

/// Reports of an arm whose counts are set by the test, 1 ms apart by default.
struct Tracked {
  explicit Tracked(bool sequence = true, double velocity_cutoff = 1000.0)
      : profile(profile_with(sequence)), tracker(profile, linkage("touch"), velocity_cutoff) {}

  WireProfile profile;
  MotionTracker tracker;
  double now = 0.0;
  RawSample sample;

  MotionTracker::Result report(std::int64_t waist = 0, std::int64_t shoulder = 0, std::int64_t elbow = 0,
                               double elapsed = 1e-3) {
    now += elapsed;
    ++sample.sequence;
    sample.encoders[0] = (sample.encoders[0] + waist) & 0xFFFF;
    sample.encoders[1] = (sample.encoders[1] + shoulder) & 0xFFFF;
    sample.encoders[2] = (sample.encoders[2] + elbow) & 0xFFFF;
    return tracker.take(sample, now);
  }
  void rest(int reports) {
    for (int i = 0; i < reports; ++i) report();
  }
  bool calibrated() const { return tracker.motion().calibrated; }
  void calibrate_in_the_inkwell() {
    sample.docked = true;
    rest(20);
    sample.docked = false;
  }
};

}  // namespace

TEST_CASE("a pen is calibrated by twenty reports at rest in the inkwell, not by fewer", "[phantom][tracker]") {
  Tracked held;
  held.sample.docked = true;
  held.rest(19);
  CHECK_FALSE(held.calibrated());
  held.rest(1);
  CHECK(held.calibrated());
  CHECK(held.tracker.motion().joints.isApprox(*held.profile.docked_angles));
}

TEST_CASE("a pen that moves in the inkwell, or leaves it, is not at rest there", "[phantom][tracker]") {
  Tracked held;
  held.sample.docked = true;
  held.rest(15);
  SECTION("by more than 2 mrad") {
    held.report(6);  // 2.5 mrad
    held.rest(18);
    CHECK_FALSE(held.calibrated());
    held.rest(1);
    CHECK(held.calibrated());
  }
  SECTION("by less it is") {
    held.report(4);  // 1.6 mrad
    held.rest(4);
    CHECK(held.calibrated());
  }
  SECTION("for a moment") {
    held.sample.docked = false;
    held.rest(1);
    held.sample.docked = true;
    held.rest(19);
    CHECK_FALSE(held.calibrated());
    held.rest(1);
    CHECK(held.calibrated());
  }
}

TEST_CASE("rest in the inkwell before lost counts or a lost link does not count", "[phantom][tracker]") {
  Tracked held;
  held.sample.docked = true;
  held.rest(15);
  SECTION("lost counts") {
    held.report(1000);  // a jump
    held.rest(4);       // the counts do not return: the fifth report restarts the counts, and is the first at rest
  }
  SECTION("lost link") {
    held.tracker.restart(GENERATE(false, true));
    held.rest(1);
  }
  held.rest(18);
  CHECK_FALSE(held.calibrated());
  held.rest(1);
  CHECK(held.calibrated());
}

TEST_CASE("a pen that stays in the inkwell is calibrated once and moves from there", "[phantom][tracker]") {
  Tracked held;
  held.calibrate_in_the_inkwell();
  held.sample.docked = true;
  for (int i = 0; i < 100; ++i) held.report(i % 50 == 0 ? 1 : 0);  // too little to count as movement
  CHECK(held.tracker.motion().joints.x() == Approx((*held.profile.docked_angles)[0] + 2.0 / 2425.0));
}

TEST_CASE("given joint angles apply from there, wherever the encoders are", "[phantom][tracker]") {
  Tracked held;
  held.rest(1);
  for (int i = 0; i < 30; ++i) held.report(20, -10, 5);
  const Joints told(0.1, 0.7, 0.5);
  held.tracker.calibrate(told);
  CHECK(held.calibrated());
  held.report(0, -24, 0);
  CHECK(held.tracker.motion().joints.isApprox(Joints(told + Joints(0, 24.0 / 2425.0, 0))));
}

TEST_CASE("joints may read 0.1 rad beyond their limits, but not 0.2", "[phantom][tracker]") {
  for (const double beyond : {0.1, 0.2}) {
    Tracked held;
    held.calibrate_in_the_inkwell();
    held.tracker.calibrate({0.98 + beyond, 0.8, 0.8});
    CAPTURE(beyond);
    CHECK(held.report().fault == (beyond > 0.15 ? DeviceFault::outside_workspace : DeviceFault::none));
  }
}

TEST_CASE("an impossible pose is reported only when calibrated, and after faults of the link", "[phantom][tracker]") {
  Tracked held;
  held.rest(1);
  for (int i = 0; i < 200; ++i) REQUIRE(held.report(20).fault == DeviceFault::none);  // 1.65 rad, if it were known
  held.tracker.calibrate({1.65, 0.8, 0.8});
  CHECK(held.report().fault == DeviceFault::outside_workspace);
  held.sample.sequence += 5;
  CHECK(held.report().fault == DeviceFault::lost_frames);
}

TEST_CASE("without sequence numbers the arrival time of reports counts", "[phantom][tracker]") {
  for (const bool sequence : {false, true}) {
    Tracked held(sequence);
    held.rest(5);
    for (int i = 0; i < 50; ++i) REQUIRE(held.report(10, 0, 0, 2e-3).fault == DeviceFault::none);
    // 10 counts in the 2 ms between two arrivals, or in the 1 ms between two reports.
    const double joint = 10.0 / 2425.0 / (sequence ? 1e-3 : 2e-3);
    const Eigen::Vector3d expected = tip_jacobian(linkage("touch"), held.tracker.motion().joints).col(0) * joint;
    CAPTURE(sequence);
    CHECK((held.tracker.motion().velocity - expected).norm() < 1e-3 * expected.norm());
  }
}

TEST_CASE("counts that were lost do not look like a velocity", "[phantom][tracker]") {
  Tracked held(true, 50.0);
  held.rest(1);
  held.tracker.calibrate({0.2, 0.5, 0.3});
  for (int i = 0; i < 100; ++i) held.report(10);
  REQUIRE(held.tracker.motion().velocity.norm() > 0.1);
  held.report(5000);  // a jump
  held.rest(4);       // the counts do not return: the fifth report restarts them from zero
  REQUIRE_FALSE(held.calibrated());
  CHECK(held.tracker.motion().velocity.isZero(0.0));
  held.rest(1);
  CHECK(held.tracker.motion().velocity.isZero(0.0));
}

TEST_CASE("without sequence numbers neither simultaneous reports nor an uneven clock look like a jump",
          "[phantom][tracker]") {
  Tracked held(false);
  held.rest(5);
  held.report(5);
  const MotionTracker::Result burst = held.report(5, 0, 0, 0.0);
  CHECK(burst.fresh);
  CHECK(burst.fault == DeviceFault::none);
  for (int i = 0; i < 20; ++i) {  // 28 rad/s, then as if 56 rad/s
    REQUIRE(held.report(68).fault == DeviceFault::none);
    REQUIRE(held.report(68, 0, 0, 0.5e-3).fault == DeviceFault::none);
  }
}

TEST_CASE("after an interruption no earlier state is left, unless the encoders have kept counting",
          "[phantom][tracker]") {
  const bool keep = GENERATE(false, true);
  Tracked held;
  held.rest(1);
  held.tracker.calibrate({0.2, 0.5, 0.3});
  for (int i = 0; i < 30; ++i) held.report(20);
  const Joints before = held.tracker.motion().joints;
  held.sample.docked = true;
  held.rest(10);
  held.sample.sequence = 7;  // the device restarts its count
  held.tracker.restart(keep);
  CHECK(held.calibrated() == keep);
  const MotionTracker::Result first = held.report(1000);
  CHECK(first.fault == DeviceFault::none);
  CHECK(first.lost == 0);
  CHECK(held.tracker.motion().joints.isApprox(keep ? Joints(before + Joints(1000.0 / 2425.0, 0, 0))
                                                   : *held.profile.docked_angles));
  if (keep) return;
  CHECK(held.tracker.motion().velocity.isZero(0.0));
  held.rest(18);  // together with the previous ten they would be more than enough
  CHECK_FALSE(held.calibrated());
  held.rest(1);
  CHECK(held.calibrated());
}
