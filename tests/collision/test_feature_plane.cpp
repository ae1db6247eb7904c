// Feature planes, Wang 2006, sec. 4.3, eq. (6).
#include "../catch.hpp"

#include <cmath>

#include <calligraphy/collision/detail/feature_plane.hpp>

using namespace calligraphy;

namespace {

detail::FeaturePlane plane_of(std::vector<Point> points) { return detail::end_plane(prepare_element(points)); }

}  // namespace

TEST_CASE("a feature point has been passed where V_t . V_f of eq. (6) is positive", "[collision]") {
  const detail::FeaturePlane plane = plane_of({{0, 0}, {3, 4}});
  CHECK(plane.point == Point(3, 4));
  CHECK(plane.normal.isApprox(Point(0.6, 0.8)));
  CHECK(plane.signed_distance({3, 4}) == 0.0);
  CHECK(plane.signed_distance({3 + 0.6, 4 + 0.8}) == Approx(1.0));
  CHECK(plane.signed_distance({3 - 0.6, 4 - 0.8}) == Approx(-1.0));
  CHECK(plane.signed_distance({3 - 8, 4 + 6}) == Approx(0.0).margin(1e-12));  // on the plane, however far
}

TEST_CASE("the plane of a curve is perpendicular to its end tangent, also where the derivative vanishes",
          "[collision]") {
  CHECK(plane_of({{0, 0}, {1, 0}, {2, 1}, {2, 2}}).normal.isApprox(Point(0, 1)));
  CHECK(plane_of({{0, 0}, {1, 0}, {2, 2}, {2, 2}}).normal.isApprox(Point(1, 2).normalized()));
  CHECK(plane_of({{0, 0}, {2, 1}, {2, 1}, {2, 1}}).normal.isApprox(Point(2, 1).normalized()));
  CHECK(plane_of({{0, 0}, {0, 1}, {1, 1}, {1, 1}, {1, 1}}).normal.isApprox(Point(1, 0)));
}

TEST_CASE("the plane of a point has no sides", "[collision]") {
  const detail::FeaturePlane plane = plane_of({{1, 1}, {1, 1}});
  CHECK(plane.normal == Point(0, 0));
  CHECK(plane.signed_distance({5, -7}) == 0.0);
}
