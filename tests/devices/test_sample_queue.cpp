#include <cstdint>
#include <thread>

#include <calligraphy/devices/sample_queue.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"

using namespace calligraphy;

namespace {

/// Larger than an atomic write of the processor, so that a torn copy would be detected.
struct Numbered {
  std::uint64_t number = 0;
  std::uint64_t again[15] = {};

  static Numbered of(std::uint64_t number) {
    Numbered result;
    result.number = number;
    for (std::uint64_t& copy : result.again) copy = number;
    return result;
  }
  bool whole() const {
    for (const std::uint64_t copy : again) {
      if (copy != number) return false;
    }
    return true;
  }
};

}  // namespace

TEST_CASE("a queue returns values in the order in which they were pushed", "[servo]") {
  SampleQueue<int> queue(4);
  int value = 0;
  CHECK_FALSE(queue.pop(value));
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 3; ++i) CHECK(queue.push(10 * round + i));
    for (int i = 0; i < 3; ++i) {
      REQUIRE(queue.pop(value));
      CHECK(value == 10 * round + i);
    }
    CHECK_FALSE(queue.pop(value));
  }
  CHECK(queue.dropped() == 0);
}

TEST_CASE("a full queue drops and counts the new value and keeps the old ones", "[servo]") {
  SampleQueue<int> queue(3);
  CHECK(queue.capacity() == 4);
  for (int i = 0; i < 4; ++i) CHECK(queue.push(i));
  CHECK_FALSE(queue.push(4));
  CHECK_FALSE(queue.push(5));
  CHECK(queue.dropped() == 2);
  int value = -1;
  REQUIRE(queue.pop(value));
  CHECK(value == 0);
  CHECK(queue.push(6));
  for (const int expected : {1, 2, 3, 6}) {
    REQUIRE(queue.pop(value));
    CHECK(value == expected);
  }
  CHECK_FALSE(queue.pop(value));
}

TEST_CASE("a queue allocates on construction only", "[servo]") {
  SampleQueue<Numbered> queue(100);
  const std::size_t before = calligraphy_test::allocations();
  Numbered value;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    queue.push(Numbered::of(i));
    if (i % 3 == 0) queue.pop(value);
  }
  const std::size_t after = calligraphy_test::allocations();
  CHECK(after == before);
}

TEST_CASE("an invalid capacity is rejected", "[servo]") {
  CHECK_THROWS_AS(SampleQueue<int>(0), ValueError);
  CHECK_THROWS_AS(SampleQueue<int>((std::size_t{1} << 24) + 1), ValueError);
  CHECK(SampleQueue<int>(1).capacity() == 1);
}

TEST_CASE("between two threads every value is popped intact and in order, or counted as dropped", "[servo]") {
  constexpr std::uint64_t count = 300'000;
  SampleQueue<Numbered> queue(64);
  std::thread producer([&] {
    for (std::uint64_t i = 1; i <= count; ++i) {
      queue.push(Numbered::of(i));
      if (i % 64 == 0) std::this_thread::yield();
    }
    while (!queue.push(Numbered::of(count + 1))) std::this_thread::yield();
  });
  std::uint64_t popped = 0;
  std::uint64_t last = 0;
  bool whole = true;
  bool in_order = true;
  Numbered value;
  while (last != count + 1) {
    if (!queue.pop(value)) {
      std::this_thread::yield();
      continue;
    }
    ++popped;
    whole = whole && value.whole();
    in_order = in_order && value.number > last;
    last = value.number;
  }
  producer.join();
  CHECK(whole);
  CHECK(in_order);
  // Failed attempts to push the last value are counted, too.
  CHECK(popped + queue.dropped() >= count + 1);
  CHECK(popped <= count + 1);
}
