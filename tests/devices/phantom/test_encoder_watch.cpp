#include <cmath>
#include <cstdint>

#include "devices/phantom/encoder_watch.hpp"

#include "../../catch.hpp"
#include "profile_text.hpp"

using namespace calligraphy;
using namespace calligraphy::phantom;

namespace {

/// 1000 counts per radian, 16 bits, the third joint counting backwards; one report per millisecond.
struct Watched {
  EncoderWatch watch{calligraphy_test::parsed(calligraphy_test::minimal_profile).encoders, {1000.0, 1000.0, -1000.0}};
  PerJoint<std::int64_t> counts{65000, 0, 30000};

  EncoderWatch::Result move(std::int64_t a, std::int64_t b, std::int64_t c, bool even = true, double elapsed = 1e-3) {
    counts[0] = (counts[0] + a) & 0xFFFF;
    counts[1] = (counts[1] + b) & 0xFFFF;
    counts[2] = (counts[2] + c) & 0xFFFF;
    return watch.check(counts, elapsed, even);
  }
};

}  // namespace

TEST_CASE("angles start at zero and follow the counts across wraps, with their signs", "[phantom][encoders]") {
  Watched held;
  CHECK(held.move(0, 0, 0).used);
  CHECK(held.watch.angles() == Eigen::Vector3d::Zero());
  for (int i = 0; i < 1000; ++i) {
    const EncoderWatch::Result answer = held.move(7, -3, 5);
    REQUIRE(answer.used);
    REQUIRE(answer.fault == DeviceFault::none);
  }
  CHECK(held.watch.angles().isApprox(Eigen::Vector3d(7.0, -3.0, -5.0)));
  CHECK(held.watch.velocity().isApprox(Eigen::Vector3d(7.0, -3.0, -5.0)));
}

TEST_CASE("a joint may turn at 59 rad/s but not at 61, whatever the clock of the reports", "[phantom][encoders]") {
  for (const bool even : {false, true}) {
    Watched held;
    held.move(0, 0, 0, even);
    for (int speed = 1; speed <= 59; ++speed) {
      REQUIRE(held.move(1, speed, 1, even).fault == DeviceFault::none);
      REQUIRE(held.move(1, speed, 1, even).used);
    }
    const Eigen::Vector3d before = held.watch.angles();
    const EncoderWatch::Result answer = held.move(0, 61, 0, even);
    CHECK(answer.fault == DeviceFault::leaping_encoder);
    CHECK_FALSE(answer.used);
    CHECK(held.watch.angles() == before);
    // The next plausible report is used again, relative to the last used one.
    CHECK(held.move(0, 40, 0, even).used);
    CHECK(held.watch.angles().y() == Approx(before.y() + 0.101));
    CHECK(held.watch.interval() == Approx(2e-3));
  }
}

TEST_CASE("a speed may change by 20 rad/s plus rounding between reports, checked only with evenly spaced times",
          "[phantom][encoders]") {
  for (const bool even : {false, true}) {
    Watched held;
    held.move(0, 0, 0, even);
    held.move(1, 0, 0, even);
    CHECK(held.move(22, 0, 0, even).used);
    CHECK(held.move(-2, 0, 0, even).used == !even);
  }
  Watched late;
  late.move(0, 0, 0);
  late.move(1, 0, 0);
  CHECK(late.move(200, 0, 0, true, 6e-3).used);  // 33 rad/s on average over 6 ms is possible for a hand
}

TEST_CASE("after five jumps in a row the counts are considered lost", "[phantom][encoders]") {
  Watched held;
  held.move(0, 0, 0);
  held.move(5, 5, 5);
  CHECK_FALSE(held.move(5000, 0, 0).used);
  for (int i = 0; i < 3; ++i) REQUIRE_FALSE(held.move(0, 0, 0).lost_count);
  const EncoderWatch::Result answer = held.move(0, 0, 0);
  CHECK(answer.used);
  CHECK(answer.lost_count);
  CHECK(answer.fault == DeviceFault::leaping_encoder);
  CHECK(held.watch.angles() == Eigen::Vector3d::Zero());
  CHECK(held.move(3, 0, 0).fault == DeviceFault::none);
  CHECK(held.watch.angles().x() == Approx(3e-3));
}

TEST_CASE("a joint is stuck once another has travelled 2.5 rad in either direction, and not before",
          "[phantom][encoders]") {
  for (const int turn : {1'000'000, 300}) {  // reports until it reverses
    Watched held;
    held.move(0, 0, 0);
    int travelled = 0;
    DeviceFault fault = DeviceFault::none;
    for (int i = 0; fault == DeviceFault::none && i < 5000; ++i) {
      fault = held.move(0, i / turn % 2 == 0 ? 1 : -1, i % 2 == 0 ? 1 : 0).fault;
      ++travelled;
    }
    CHECK(fault == DeviceFault::stuck_encoder);
    CHECK(travelled > 2500);
    CHECK(travelled < 2700);
    CHECK(held.move(1, 0, 0).fault == DeviceFault::none);  // it moves, which resets the watch
    CHECK(held.move(0, 1, 0).fault == DeviceFault::none);
  }
}

TEST_CASE("after an interruption any movement is accepted, after a restart it is discarded", "[phantom][encoders]") {
  Watched held;
  held.move(0, 0, 0);
  held.move(5, 5, 5);
  held.watch.interrupt();
  CHECK(held.move(800, 0, 0).used);
  CHECK(held.watch.angles().x() == Approx(0.805));
  held.watch.restart();
  CHECK(held.move(20000, 0, 0).used);
  CHECK(held.watch.angles() == Eigen::Vector3d::Zero());
}

TEST_CASE("a restarted watch behaves like a new one", "[phantom][encoders]") {
  Watched used, fresh;
  used.move(0, 0, 0);
  for (int i = 0; i < 240; ++i) used.move(0, 10, 1);  // almost long enough for the first joint to count as stuck
  used.move(0, 20, 0);
  for (int i = 0; i < 4; ++i) CHECK_FALSE(used.move(i == 0 ? 5000 : 0, 0, 0).used);
  used.watch.restart();
  CHECK(used.watch.angles().isZero(0.0));
  CHECK(used.watch.velocity().isZero(0.0));
  CHECK(used.watch.interval() == 0.0);
  used.counts = fresh.counts;
  const auto same = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
    const EncoderWatch::Result first = used.move(a, b, c), second = fresh.move(a, b, c);
    return first.used == second.used && first.lost_count == second.lost_count && first.fault == second.fault &&
           used.watch.velocity() == fresh.watch.velocity() && used.watch.interval() == fresh.watch.interval() &&
           used.watch.angles() == fresh.watch.angles();
  };
  REQUIRE(same(0, 0, 0));
  REQUIRE(same(0, 5000, 0));   // one jump
  REQUIRE(same(0, -4940, 0));  // and back; the first speed is arbitrary
  for (int i = 0; i < 400; ++i) REQUIRE(same(i % 2, 10, 0));
  CHECK(used.move(0, 10, 0).fault == DeviceFault::stuck_encoder);
}
