#include <cstdint>

#include "devices/phantom/sequence_watch.hpp"

#include "../../catch.hpp"

using namespace calligraphy;
using namespace calligraphy::phantom;

TEST_CASE("a sequence continues across its wrap", "[phantom][sequence]") {
  SequenceWatch watch(8);
  for (unsigned i = 250; i < 1000; ++i) {
    const SequenceWatch::Result answer = watch.check(i & 0xFF);
    REQUIRE(answer.fresh);
    REQUIRE(answer.steps == 1);
    REQUIRE(answer.fault == DeviceFault::none);
  }
}

TEST_CASE("two lost reports in a row are tolerated, three are a fault", "[phantom][sequence]") {
  for (const unsigned lost : {0u, 1u, 2u, 3u, 100u}) {
    SequenceWatch watch(32);
    watch.check(7);
    const SequenceWatch::Result answer = watch.check(8 + lost);
    CHECK(answer.fresh);
    CHECK(answer.steps == 1 + static_cast<std::int64_t>(lost));
    CHECK(answer.fault == (lost < 3 ? DeviceFault::none : DeviceFault::lost_frames));
    CHECK(watch.check(9 + lost).steps == 1);
  }
}

TEST_CASE("losing one in sixty is tolerated indefinitely, one in forty is not", "[phantom][sequence]") {
  const auto faults = [](unsigned period) {
    SequenceWatch watch(32);
    int found = 0;
    for (unsigned i = 1; i < 20000; ++i) {
      if (i % period != 0) found += watch.check(i).fault != DeviceFault::none;
    }
    return found;
  };
  CHECK(faults(60) == 0);
  CHECK(faults(40) > 0);
}

TEST_CASE("a repeated report is dropped, and the third in a row or one that runs backwards is a fault",
          "[phantom][sequence]") {
  SequenceWatch watch(16);
  watch.check(100);
  for (int i = 0; i < 2; ++i) {
    const SequenceWatch::Result answer = watch.check(100);
    CHECK_FALSE(answer.fresh);
    CHECK(answer.fault == DeviceFault::none);
  }
  for (int i = 0; i < 5; ++i) CHECK(watch.check(100).fault == DeviceFault::repeated_frames);
  CHECK(watch.check(101).fault == DeviceFault::none);
  CHECK(watch.check(101).fault == DeviceFault::none);  // the first of another row
  CHECK_FALSE(watch.check(101).fresh);
  CHECK(watch.check(102).fault == DeviceFault::none);
  const SequenceWatch::Result back = watch.check(99);
  CHECK_FALSE(back.fresh);
  CHECK(back.fault == DeviceFault::repeated_frames);
  CHECK(watch.check(100).fresh);  // a device that has begun anew is followed
  watch.restart();
  CHECK(watch.check(5).fault == DeviceFault::none);
}
