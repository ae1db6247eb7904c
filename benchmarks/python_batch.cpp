// The C++ loop that python_overhead.py compares batched calls with: prints ns per query.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <calligraphy/collision/nearest_point.hpp>

int main(int count_of_arguments, char** arguments) {
  using namespace calligraphy;
  if (count_of_arguments != 3) return 2;
  const std::size_t count = std::strtoul(arguments[1], nullptr, 10);
  const std::string method = arguments[2];
  NearestPointOptions options;
  options.method = method == "exact"     ? NearestPointMethod::exact
                   : method == "sampled" ? NearestPointMethod::sampled
                                         : NearestPointMethod::wang2006;
  const std::vector<Point> curve = {{0.0, 0.0}, {0.01, 0.02}, {0.02, -0.01}, {0.03, 0.005}};
  const StrokeElement element = prepare_element(curve);
  std::vector<Point> queries;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 0.7 * static_cast<double>(i);
    const double radius = 0.005 + 0.01 * static_cast<double>((i * 37) % 1000) / 1000.0;
    queries.push_back({0.015 + radius * std::cos(angle), 0.004 + radius * std::sin(angle)});
  }
  const std::size_t rounds = std::max<std::size_t>(1, 200000 / count);
  double best = 1e9;
  for (int repeat = 0; repeat < 7; ++repeat) {
    const std::clock_t began = std::clock();
    for (std::size_t round = 0; round < rounds; ++round) {
      std::vector<NearestPoint> results(count);  // like a caller who keeps the results
      nearest_points(element, queries, results, options);
      if (!std::isfinite(results.back().distance)) return 1;
    }
    const double spent = 1e9 * static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;  // processor time [ns]
    best = std::min(best, spent / static_cast<double>(rounds * count));
  }
  std::printf("%.2f\n", best);
  return 0;
}
