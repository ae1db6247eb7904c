// Samples the guidance about ambiguous places with nothing above the experiments.
#include <cstdio>

#include <calligraphy/experiments/force_field.hpp>

int main() {
  const auto figures = calligraphy::ambiguity_figures(8);
  std::printf("%zu figures\n", figures.size());
  return figures.empty() ? 1 : 0;
}
