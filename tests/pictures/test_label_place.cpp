#include "pictures/label_place.hpp"

#include <vector>

#include "../catch.hpp"

using namespace calligraphy;

TEST_CASE("labels of crowded points cover neither a point nor one another nor the edge", "[pictures]") {
  const svg::Box picture = {Point(0.0, 0.0), Point(300.0, 300.0)};
  const Point marker(5.0, 5.0), size(60.0, 11.0);
  std::vector<Point> points = {{2.0, 150.0}, {298.0, 150.0}};
  for (int i = 0; i < 6; ++i) points.emplace_back(140.0 + 12.0 * (i % 3), 140.0 + 13.0 * (i / 3));
  std::vector<svg::Box> taken;
  for (const Point& point : points) taken.push_back({point - marker, point + marker});
  for (const Point& point : points) {
    const svg::Box label = svg::place_label(point, size, picture, taken);
    CAPTURE(point.transpose(), label.low.transpose());
    CHECK((label.high - label.low - size).norm() < 1e-9);
    CHECK(svg::common_area(label, picture) == Approx(size.prod()));
    for (const svg::Box& other : taken) CHECK(svg::common_area(label, other) == Approx(0.0).margin(1e-9));
    CHECK((point.cwiseMax(label.low).cwiseMin(label.high) - point).norm() < 60.0);  // it is seen whose it is
    taken.push_back(label);
  }
}
