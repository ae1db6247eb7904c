#include <calligraphy/practice/mean_interval.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <calligraphy/base/random.hpp>

#include "../catch.hpp"

using namespace calligraphy;

TEST_CASE("the quantile of Student's t is that of the printed tables", "[practice]") {
  // Abramowitz and Stegun, table 26.10, 1 - A = 0.05.
  const struct {
    std::size_t dof;
    double value;
  } printed[] = {{1, 12.706}, {2, 4.303},  {3, 3.182},  {4, 2.776},  {5, 2.571},  {9, 2.262},
                 {10, 2.228}, {19, 2.093}, {30, 2.042}, {60, 2.000}, {120, 1.980}};
  for (const auto& each : printed) {
    CAPTURE(each.dof);
    CHECK(student_t(each.dof) == Approx(each.value).margin(5.1e-4));
  }
  CHECK(std::isnan(student_t(0)));
  CHECK(student_t(999'999) == Approx(1.959964).margin(5e-6));
  CHECK(student_t(1'000'000) == Approx(1.959964).margin(5e-6));
}

TEST_CASE("an interval is clustered by the independent draws", "[practice]") {
  // Worked by hand: mean 6, clusters {1, 3}, {5, 7}, {8, 12} with means 2, 6, 10. Their standard deviation is 4, so the
  // standard error is 4 / sqrt(3) and the half width t(2) = 4.3027 times that, 9.9366.
  const std::vector<DrawnValue> drawn = {{1.0, 7}, {5.0, 8}, {8.0, 900}, {3.0, 7}, {7.0, 8}, {12.0, 900}};
  const MeanInterval clustered = mean_interval(drawn);
  CHECK(clustered.mean == Approx(6.0));
  CHECK(clustered.half_width == Approx(9.9366).epsilon(1e-4));
  CHECK(clustered.values == 6);
  CHECK(clustered.draws == 3);
}

TEST_CASE("values that were not measured are left out and counted", "[practice]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<DrawnValue> some = {{1.0, 7}, {nan, 8}, {3.0, 8}, {nan, 9}};
  const MeanInterval of_some = mean_interval(some);
  CHECK(of_some.mean == Approx(2.0));
  CHECK(of_some.half_width == Approx(12.706).epsilon(1e-4));  // t(1) times a standard error of 1
  CHECK(of_some.values == 2);
  CHECK(of_some.draws == 2);
  CHECK(of_some.missing == 2);
  const std::vector<DrawnValue> none = {{nan, 1}};
  CHECK(std::isnan(mean_interval(none).mean));
  CHECK(mean_interval(none).missing == 1);
}

TEST_CASE("clusters of unequal size weigh by their values", "[practice]") {
  // By hand: values 0, 0, 0 in one draw and 4 in another: mean 1, sums of deviations -3 and 3, standard error
  // sqrt(2 / 1 * (9 + 9)) / 4 = 1.5, half width t(1) = 12.7062 times that.
  const std::vector<DrawnValue> drawn = {{0.0, 1}, {0.0, 1}, {0.0, 1}, {4.0, 2}};
  const MeanInterval clustered = mean_interval(drawn);
  CHECK(clustered.mean == Approx(1.0));
  CHECK(clustered.half_width == Approx(19.0593).epsilon(1e-4));
}

TEST_CASE("with one value per draw the interval is the usual one", "[practice]") {
  // By hand: 2, 4, 4, 6: mean 4, variance 8 / 3, standard error sqrt(2 / 3), t(3) = 3.18245.
  const std::vector<DrawnValue> drawn = {{2.0, 1}, {4.0, 2}, {4.0, 3}, {6.0, 4}};
  CHECK(mean_interval(drawn).half_width == Approx(2.59846).epsilon(1e-5));
}

TEST_CASE("one draw shows nothing: the half width is not a number", "[practice]") {
  const MeanInterval one = mean_interval(std::vector<DrawnValue>{{2.0, 1}, {4.0, 1}});
  CHECK(one.mean == 3.0);
  CHECK(std::isnan(one.half_width));
  const MeanInterval none = mean_interval({});
  CHECK(std::isnan(none.mean));
  CHECK(std::isnan(none.half_width));
}

TEST_CASE("of intervals of clustered values 95 % contain the true mean", "[practice]") {
  // 10 draws of 5 values each that share a normal deviate. Taken as 50 independent values, fewer than 70 % would.
  constexpr int trials = 4000;
  int clustered = 0, as_if_independent = 0;
  Random random(20);
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<DrawnValue> values, separate;
    for (std::uint64_t draw = 0; draw < 10; ++draw) {
      const double shared = random.normal();
      for (int i = 0; i < 5; ++i) {
        values.push_back({1.0 + shared + 0.3 * random.normal(), draw});
        separate.push_back({values.back().value, values.size()});
      }
    }
    const auto contains = [](const MeanInterval& interval) {
      return std::abs(interval.mean - 1.0) < interval.half_width;
    };
    clustered += contains(mean_interval(values));
    as_if_independent += contains(mean_interval(separate));
  }
  CHECK(clustered == Approx(0.95 * trials).margin(4.0 * std::sqrt(0.05 * 0.95 * trials)));
  CHECK(as_if_independent < 0.7 * trials);
}
