#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/duration_histogram.hpp>

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

TEST_CASE("an empty histogram has no figures", "[servo]") {
  const DurationFigures figures = DurationHistogram().figures();
  CHECK(figures.count == 0);
  CHECK(figures.p50 == 0.0);
  CHECK(figures.worst == 0.0);
}

TEST_CASE("percentiles are within a 256th of the true ones at every size of duration", "[servo]") {
  const double middle = GENERATE(1e-8, 1e-6, 1e-3, 0.5, 60.0);
  Random random(7);
  DurationHistogram histogram;
  std::vector<double> values;
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::round(std::min(middle * std::exp(0.7 * random.normal()), 900.0) * 1e9) * 1e-9;
    values.push_back(value);
    histogram.add(value);
  }
  const DurationFigures figures = histogram.figures();
  CAPTURE(middle);
  CHECK(figures.count == values.size());
  CHECK(std::abs(figures.p50 - true_percentile(values, 0.5)) <=
        DurationHistogram::relative_error * true_percentile(values, 0.5) + 1e-12);
  CHECK(std::abs(figures.p99 - true_percentile(values, 0.99)) <=
        DurationHistogram::relative_error * true_percentile(values, 0.99) + 1e-12);
  CHECK(std::abs(figures.p99_9 - true_percentile(values, 0.999)) <=
        DurationHistogram::relative_error * true_percentile(values, 0.999) + 1e-12);
  CHECK(figures.worst == Approx(*std::max_element(values.begin(), values.end())).epsilon(1e-12));
}

TEST_CASE("every single duration is told within a 256th", "[servo]") {
  for (double value = 1e-9; value < 1000.0; value *= 1.013) {
    DurationHistogram histogram;
    histogram.add(value);
    histogram.add(1000.0);  // so that the worst does not correct it
    histogram.add(value);
    const double told = histogram.figures().p50;
    CAPTURE(value, told);
    REQUIRE(std::abs(told - value) <= DurationHistogram::relative_error * value + 0.51e-9);
  }
}

TEST_CASE("a percentile is a duration that at least its share does not exceed", "[servo]") {
  DurationHistogram histogram;
  for (const double value : {1e-3, 2e-3, 3e-3}) histogram.add(value);
  CHECK(histogram.figures().p50 == Approx(2e-3).epsilon(DurationHistogram::relative_error));
  CHECK(histogram.figures().p99 == Approx(3e-3).epsilon(DurationHistogram::relative_error));
}

TEST_CASE("durations that are none count as zero, and endless ones in the last bucket", "[servo]") {
  DurationHistogram histogram;
  for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), -1e300}) histogram.add(value);
  CHECK(histogram.figures().count == 4);
  CHECK(histogram.figures().worst == 0.0);
  histogram.add(std::numeric_limits<double>::infinity());
  histogram.add(1e300);
  CHECK(histogram.figures().count == 6);
  CHECK(histogram.figures().worst > 1e9);
  CHECK(histogram.figures().p99 > 1000.0);
}
