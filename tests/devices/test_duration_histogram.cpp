#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/detail/duration_histogram.hpp>

#include "../catch.hpp"

using namespace calligraphy;

namespace {

/// The smallest value that at least this share does not exceed.
double true_percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

TEST_CASE("an empty histogram has a zero summary", "[servo]") {
  const DurationSummary summary = detail::DurationHistogram().summary();
  CHECK(summary.count == 0);
  CHECK(summary.p50 == 0.0);
  CHECK(summary.worst == 0.0);
}

TEST_CASE("percentiles are within 1/256 of the true ones at every scale of duration", "[servo]") {
  const double middle = GENERATE(1e-8, 1e-6, 1e-3, 0.5, 60.0);
  Random random(7);
  detail::DurationHistogram histogram;
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::round(std::min(middle * std::exp(0.7 * random.normal()), 900.0) * 1e9) * 1e-9;
    values.push_back(value);
    histogram.add(value);
  }
  const DurationSummary summary = histogram.summary();
  CAPTURE(middle);
  CHECK(summary.count == values.size());
  CHECK(std::abs(summary.p50 - true_percentile(values, 0.5)) <=
        detail::DurationHistogram::relative_error * true_percentile(values, 0.5) + 1e-12);
  CHECK(std::abs(summary.p99 - true_percentile(values, 0.99)) <=
        detail::DurationHistogram::relative_error * true_percentile(values, 0.99) + 1e-12);
  CHECK(std::abs(summary.p99_9 - true_percentile(values, 0.999)) <=
        detail::DurationHistogram::relative_error * true_percentile(values, 0.999) + 1e-12);
  CHECK(summary.worst == Approx(*std::max_element(values.begin(), values.end())).epsilon(1e-12));
}

TEST_CASE("every single duration is reported to within 1/256", "[servo]") {
  for (double value = 1e-9; value < 1000.0; value *= 1.013) {
    detail::DurationHistogram histogram;
    histogram.add(value);
    histogram.add(1000.0);  // so that the worst does not correct it
    histogram.add(value);
    const double told = histogram.summary().p50;
    CAPTURE(value, told);
    REQUIRE(std::abs(told - value) <= detail::DurationHistogram::relative_error * value + 0.51e-9);
  }
}

TEST_CASE("a percentile is a duration that at least its fraction of durations does not exceed", "[servo]") {
  detail::DurationHistogram histogram;
  for (const double value : {1e-3, 2e-3, 3e-3}) histogram.add(value);
  CHECK(histogram.summary().p50 == Approx(2e-3).epsilon(detail::DurationHistogram::relative_error));
  CHECK(histogram.summary().p99 == Approx(3e-3).epsilon(detail::DurationHistogram::relative_error));
}

TEST_CASE("invalid durations count as zero, and infinite ones in the last bucket", "[servo]") {
  detail::DurationHistogram histogram;
  for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), -1e300}) histogram.add(value);
  CHECK(histogram.summary().count == 4);
  CHECK(histogram.summary().worst == 0.0);
  histogram.add(std::numeric_limits<double>::infinity());
  histogram.add(1e300);
  CHECK(histogram.summary().count == 6);
  CHECK(histogram.summary().worst > 1e9);
  CHECK(histogram.summary().p99 > 1000.0);
}
