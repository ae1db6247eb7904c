#include <calligraphy/practice/mean_interval.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

namespace calligraphy {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// From here on the normal quantile is within 2e-6 of Student's, and the sums below would be long.
constexpr std::size_t almost_normal = 1'000'000;
constexpr double normal_quantile = 1.959963984540054;

/// The probability that Student's t lies within +-sqrt(dof) tan(angle) (Abramowitz and Stegun, 26.7.3 and 26.7.4).
double probability_within(double angle, std::size_t dof) {
  const double cosine = std::cos(angle), square = cosine * cosine;
  const bool odd = dof % 2 == 1;
  double term = odd ? cosine : 1.0, sum = dof == 1 ? 0.0 : term;
  for (std::size_t k = odd ? 3 : 2; k < dof; k += 2) {
    term *= square * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  return odd ? 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
}

}  // namespace

double student_t(std::size_t degrees_of_freedom) {
  if (degrees_of_freedom == 0) return not_known;
  if (degrees_of_freedom >= almost_normal) return normal_quantile;
  double low = 0.0, high = 0.5 * std::numbers::pi;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (probability_within(middle, degrees_of_freedom) < 0.95 ? low : high) = middle;
  }
  return std::sqrt(static_cast<double>(degrees_of_freedom)) * std::tan(0.5 * (low + high));
}

MeanInterval mean_interval(std::span<const DrawnValue> drawn) {
  std::vector<DrawnValue> values(drawn.begin(), drawn.end());
  std::erase_if(values, [](const DrawnValue& each) { return std::isnan(each.value); });
  MeanInterval result{not_known, not_known, values.size(), 0, drawn.size() - values.size()};
  if (values.empty()) return result;
  const auto count = static_cast<double>(values.size());
  result.mean = 0.0;
  for (const DrawnValue& each : values) result.mean += each.value / count;
  std::map<std::uint64_t, double> deviations;
  for (const DrawnValue& each : values) deviations[each.draw] += each.value - result.mean;
  result.draws = deviations.size();
  if (result.draws < 2) return result;
  double squares = 0.0;
  for (const auto& [draw, deviation] : deviations) squares += deviation * deviation;
  const auto draws = static_cast<double>(result.draws);
  const double standard_error = std::sqrt(draws / (draws - 1.0) * squares) / count;
  result.half_width = student_t(result.draws - 1) * standard_error;
  return result;
}

}  // namespace calligraphy
