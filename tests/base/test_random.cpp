#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <calligraphy/base/random.hpp>

#include "../catch.hpp"

using calligraphy::Random;

// Expected values: those published for splitmix64, and those of a Python program written from the header's description.

TEST_CASE("the engine is splitmix64", "[random]") {
  Random random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u}) {
    CHECK(random.bits() == expected);
  }
}

TEST_CASE("draws have the bits of the specified algorithm", "[random]") {
  Random uniform(1);
  for (const double expected : {0x1.22145bd91204bp-1, 0x1.7dd71b42cb1ddp-1, 0x1.f12745ddf664ap-1}) {
    CHECK(uniform.next() == expected);
  }
  Random normal(1);
  for (const double expected :
       {0x1.f211cad73696fp-1, -0x1.a559e5ba56e2cp+1, 0x1.9f82748344ac1p-1, 0x1.4a627fc037888p-2}) {
    CHECK(normal.normal() == expected);
  }
  Random digits(1);
  for (const std::uint64_t expected : {5u, 9u, 0u, 5u, 1u, 8u, 5u, 3u, 0u, 0u}) CHECK(digits.index(10) == expected);
  Random keyed(2006, {3, -1, 0});
  CHECK(keyed.bits() == 0x31d47207dbeb2b90u);
  CHECK(keyed.bits() == 0x2d865ffa9bf499f2u);
}

TEST_CASE("shuffling follows Fisher and Yates and keeps all values", "[random]") {
  std::array<int, 10> order;
  std::iota(order.begin(), order.end(), 0);
  Random random(1);
  shuffle(order, random);
  CHECK(order == std::array{4, 2, 8, 1, 9, 3, 0, 6, 7, 5});
  std::array<int, 24> seen{};
  for (int i = 0; i < 24'000; ++i) {
    std::array<int, 4> few{0, 1, 2, 3};
    shuffle(few, random);
    std::array<int, 4> rank{};
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) rank[a] += few[b] < few[a];
    }
    ++seen[static_cast<std::size_t>(6 * rank[0] + 2 * rank[1] + rank[2])];
  }
  for (const int count : seen) CHECK(std::abs(count - 1000) < 5 * 31);  // five standard deviations
}

TEST_CASE("all indices are equally likely, however large the count", "[random]") {
  // Of 2^64 values the lowest 2^62 would be drawn twice as often for this count.
  constexpr std::uint64_t count = 3ull << 62;
  Random random(5);
  int low = 0;
  for (int i = 0; i < 30'000; ++i) {
    const std::uint64_t draw = random.index(count);
    REQUIRE(draw < count);
    low += draw < count / 3;
  }
  CHECK(std::abs(low - 10'000) < 5 * 82);
  CHECK(random.index(1) == 0);
  CHECK(random.index(0) == 0);
}

TEST_CASE("uniform draws stay within their interval and fill it evenly", "[random]") {
  Random random(3);
  double sum = 0.0, square = 0.0;
  constexpr int count = 1'000'000;
  for (int i = 0; i < count; ++i) {
    const double draw = random.between(-1.0, 3.0);
    REQUIRE(draw >= -1.0);
    REQUIRE(draw <= 3.0);
    sum += draw;
    square += draw * draw;
  }
  CHECK(sum / count == Approx(1.0).margin(5.0 * std::sqrt(16.0 / 12.0 / count)));
  CHECK(square / count == Approx(1.0 + 16.0 / 12.0).epsilon(0.01));
}

TEST_CASE("normal draws have the moments and the tails of the normal distribution", "[random]") {
  constexpr int count = 4'000'000;
  Random random(20060704);
  double sum = 0.0, square = 0.0, cube = 0.0, fourth = 0.0, lagged = 0.0, before = 0.0;
  std::array<int, 5> beyond{};
  std::vector<double> draws;
  for (int i = 0; i < count; ++i) {
    const double draw = random.normal();
    sum += draw;
    square += draw * draw;
    cube += draw * draw * draw;
    fourth += draw * draw * draw * draw;
    lagged += draw * before;
    before = draw;
    for (std::size_t sigma = 1; sigma <= 5; ++sigma) beyond[sigma - 1] += std::abs(draw) > static_cast<double>(sigma);
    if (i < 100'000) draws.push_back(draw);
  }
  // Variances of the sample moments: 1, 2, 15, 96 and 1 over the count; five standard deviations.
  const double root = std::sqrt(static_cast<double>(count));
  CHECK(std::abs(sum / count) < 5.0 * 1.0 / root);
  CHECK(std::abs(square / count - 1.0) < 5.0 * std::sqrt(2.0) / root);
  CHECK(std::abs(cube / count) < 5.0 * std::sqrt(15.0) / root);
  CHECK(std::abs(fourth / count - 3.0) < 5.0 * std::sqrt(96.0) / root);
  CHECK(std::abs(lagged / count) < 5.0 / root);
  for (std::size_t sigma = 1; sigma <= 5; ++sigma) {
    const double expected = count * std::erfc(static_cast<double>(sigma) / std::sqrt(2.0));
    CAPTURE(sigma, beyond[sigma - 1], expected);
    CHECK(std::abs(beyond[sigma - 1] - expected) < 5.0 * std::sqrt(expected));
  }
  // Kolmogorov and Smirnov: 1.95 / sqrt(n) is exceeded by one sample in a thousand.
  std::sort(draws.begin(), draws.end());
  double largest = 0.0;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(draws.size());
    largest = std::max(largest, std::abs(0.5 * std::erfc(-draws[i] / std::sqrt(2.0)) - share));
  }
  CHECK(largest < 1.95 / std::sqrt(static_cast<double>(draws.size())));
}

TEST_CASE("each list of keys has an independent sequence", "[random]") {
  std::vector<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    first.push_back(Random(seed).bits());
    for (int a = -1; a < 8; ++a) {
      first.push_back(Random(seed, {a}).bits());
      for (int b = -1; b < 8; ++b) first.push_back(Random(seed, {a, b}).bits());
    }
  }
  std::sort(first.begin(), first.end());
  CHECK(std::adjacent_find(first.begin(), first.end()) == first.end());
  CHECK(Random(7, {1, 2}).bits() == Random(7, {1, 2}).bits());
}
