// Fits a stroke to a path, using only the importers and the components below them.
#include <cstdio>
#include <vector>

#include <calligraphy/importers/stroke_fit.hpp>

int main() {
  const std::vector<calligraphy::Point> path{{0.1, 0.5}, {0.5, 0.51}, {0.9, 0.52}};
  const calligraphy::FittedStroke fitted = calligraphy::fit_stroke(path);
  std::printf("typical stroke %d, error %g em\n", fitted.stroke.id, fitted.error);
  return fitted.error < 0.02 ? 0 : 1;
}
