// Force terms, Wang 2006, sec. 5, eq. (8), (9), and the wrong-way resistance of sec. 2.2, Fig. 4.
#include "../catch.hpp"

#include <calligraphy/render/force_terms.hpp>

using namespace calligraphy;

TEST_CASE("eq. (8) pulls the tip to its closest point", "[render]") {
  const Point tip(0.003, 0.004), closest(0.0, 0.0);
  CHECK(attraction_force(400.0, tip, closest).isApprox(Point(-1.2, -1.6)));
  CHECK(attraction_force(400.0, tip, closest).dot(closest - tip) > 0.0);
  CHECK(attraction_force(400.0, closest, closest) == Point(0, 0));
  CHECK(attraction_force(0.0, tip, closest) == Point(0, 0));
}

TEST_CASE("eq. (9) pushes out of the paper in proportion to the penetration, and only below the surface", "[render]") {
  CHECK(normal_force(400.0, 0.002) == Approx(0.8));
  CHECK(normal_force(400.0, 0.0) == 0.0);
  CHECK(normal_force(400.0, -0.002) == 0.0);
}

TEST_CASE("Fig. 4: writing backwards is resisted along the stroke, beyond a dead band and up to a limit", "[render]") {
  const Point tangent(0.6, 0.8);
  CHECK(wrong_way_force(200.0, 1.0, 0.002, 0.0, tangent) == Point(0, 0));
  CHECK(wrong_way_force(200.0, 1.0, 0.002, 0.002, tangent) == Point(0, 0));
  CHECK(wrong_way_force(200.0, 1.0, 0.002, 0.005, tangent).isApprox(0.6 * tangent));
  CHECK(wrong_way_force(200.0, 1.0, 0.002, 0.007, tangent).isApprox(tangent));
  CHECK(wrong_way_force(200.0, 1.0, 0.002, 5.0, tangent).isApprox(tangent));
  CHECK(wrong_way_force(0.0, 1.0, 0.002, 5.0, tangent) == Point(0, 0));
  CHECK(wrong_way_force(200.0, 1.0, 0.002, 0.005, Point(0, 0)) == Point(0, 0));  // a point has no direction
}
