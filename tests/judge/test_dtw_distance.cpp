#include <calligraphy/judge/dtw_distance.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/judge/pen_path.hpp>

#include "../catch.hpp"

using namespace calligraphy;

namespace {

const PenPath bent = {{0.1, 0.2}, {0.5, 0.3}, {0.6, 0.9}};

/// Every segment in so many parts of unequal length.
PenPath divided(const PenPath& path, int parts) {
  PenPath result = {path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (int k = 1; k <= parts; ++k) {
      const double share = std::pow(static_cast<double>(k) / parts, 3);
      result.push_back(path[i - 1] + share * (path[i] - path[i - 1]));
    }
  }
  return result;
}

}  // namespace

TEST_CASE("the DTW distance of a path from itself is 0, however it is sampled", "[judge]") {
  CHECK(dtw_distance(bent, bent) == 0.0);
  CHECK(dtw_distance(bent, divided(bent, 90)) == Approx(0.0).margin(1e-14));
  const PenPath repeated = {bent[0], bent[0], bent[1], bent[1], bent[1], bent[2], bent[2]};
  CHECK(dtw_distance(repeated, bent) == Approx(0.0).margin(1e-14));
}

TEST_CASE("the DTW distance depends on neither the sampling nor the order of the paths", "[judge]") {
  const PenPath other = {{0.2, 0.1}, {0.3, 0.8}, {0.9, 0.7}};
  const double distance = dtw_distance(bent, other);
  CHECK(distance > 0.1);
  CHECK(dtw_distance(other, bent) == Approx(distance).epsilon(1e-12));
  CHECK(dtw_distance(divided(bent, 50), divided(other, 7)) == Approx(distance).epsilon(1e-12));
}

TEST_CASE("the DTW distance of a straight path shifted across its direction is the shift", "[judge]") {
  const PenPath path = {{0.0, 0.0}, {0.8, 0.6}}, shifted = {{-0.03, 0.04}, {0.77, 0.64}};
  CHECK(dtw_distance(path, shifted) == Approx(0.05).epsilon(1e-12));
}

TEST_CASE("the DTW distance of small cases is as computed by hand", "[judge]") {
  const PenPath dot = {{0.0, 0.0}}, along = {{0.0, 0.0}, {1.0, 0.0}};
  CHECK(dtw_distance(dot, PenPath{{0.3, 0.4}}) == Approx(0.5));
  // The points of the line are k / 63, those of the dot all 0. Every pair with the first of the line is free, and each
  // further point of the line is paired at least once, with weight 1: the sum of k / 63 is 32.
  CHECK(dtw_distance(dot, along) == Approx(32.0 / 128.0).epsilon(1e-12));
  // One step ahead, all points but the ends coincide: the two first ones cost 2 / 63, the two last ones, reached by a
  // step of weight 1, cost 1 / 63.
  const PenPath ahead = {{1.0 / 63.0, 0.0}, {64.0 / 63.0, 0.0}};
  CHECK(dtw_distance(along, ahead) == Approx(3.0 / 63.0 / 128.0).epsilon(1e-9));
}

TEST_CASE("the DTW distance sees direction", "[judge]") {
  const PenPath backwards(bent.rbegin(), bent.rend());
  CHECK(dtw_distance(bent, backwards) > 0.2);
}

TEST_CASE("a path without points or with one that is not finite has no DTW distance", "[judge]") {
  CHECK_THROWS_WITH(dtw_distance({}, bent), "one: a path without points");
  CHECK_THROWS_WITH(dtw_distance(bent, {}), "other: a path without points");
  const PenPath wrong = {{0.0, 0.0}, {0.0, std::numeric_limits<double>::infinity()}};
  CHECK_THROWS_WITH(dtw_distance(bent, wrong), "other[1] is not finite");
}
