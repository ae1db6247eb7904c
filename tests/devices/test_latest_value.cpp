#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <utility>

#include <calligraphy/devices/latest_value.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"

using namespace calligraphy;

namespace {

/// Two halves that belong together. While one is copied and the other is not yet, `meanwhile` is what the other thread
/// does.
struct Halves {
  int first = 0, second = 0;
  static inline std::function<void()> meanwhile;

  Halves() = default;
  explicit Halves(int number) : first(number), second(number) {}
  Halves(const Halves&) = default;
  Halves& operator=(const Halves& other) {
    first = other.first;
    if (const auto act = std::exchange(meanwhile, nullptr)) act();
    second = other.second;
    return *this;
  }
};

}  // namespace

TEST_CASE("the newest value is given once, and what was not taken in time is overwritten", "[servo]") {
  LatestValue<int> latest;
  int value = -1;
  CHECK_FALSE(latest.take(value));
  CHECK(value == -1);
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 4; ++i) latest.publish(10 * round + i);
    REQUIRE(latest.take(value));
    CHECK(value == 10 * round + 3);
    CHECK_FALSE(latest.take(value));
    CHECK(value == 10 * round + 3);
  }
}

TEST_CASE("a value is whole, whatever the other thread does while it is copied", "[servo]") {
  LatestValue<Halves> latest;
  Halves value;
  latest.publish(Halves(1));
  Halves::meanwhile = [&] {
    for (int i = 2; i < 6; ++i) latest.publish(Halves(i));
  };
  REQUIRE(latest.take(value));
  CHECK(value.first == 1);
  CHECK(value.second == 1);
  REQUIRE(latest.take(value));
  CHECK(value.first == 5);
  CHECK(value.second == 5);

  Halves::meanwhile = [&] { CHECK_FALSE(latest.take(value)); };
  latest.publish(Halves(6));
  CHECK(value.second == 5);
  latest.publish(Halves(7));
  Halves::meanwhile = [&] {
    REQUIRE(latest.take(value));
    CHECK(value.first == 7);
    CHECK(value.second == 7);
  };
  latest.publish(Halves(8));
  REQUIRE(latest.take(value));
  CHECK(value.second == 8);
}

TEST_CASE("publishing and taking a value take no memory", "[servo]") {
  LatestValue<std::array<double, 64>> latest;
  std::array<double, 64> value{};
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 100; ++i) {
    latest.publish(value);
    latest.take(value);
  }
  const std::size_t after = calligraphy_test::allocations();
  CHECK(after == before);
}

TEST_CASE("the newest value is whole, and never older than the one before", "[servo][threads]") {
  struct Value {
    std::array<std::uint64_t, 16> copies{};
  };
  LatestValue<Value> latest;
  constexpr std::uint64_t last = 200'000;
  std::jthread writer([&] {
    for (std::uint64_t i = 1; i <= last; ++i) {
      Value value;
      value.copies.fill(i);
      latest.publish(value);
    }
  });
  Value value;
  std::uint64_t before = 0;
  bool whole = true, in_order = true;
  while (before < last) {
    if (!latest.take(value)) {
      std::this_thread::yield();
      continue;
    }
    for (const std::uint64_t copy : value.copies) whole = whole && copy == value.copies[0];
    in_order = in_order && value.copies[0] > before;
    before = value.copies[0];
  }
  CHECK(whole);
  CHECK(in_order);
  CHECK_FALSE(latest.take(value));
}
