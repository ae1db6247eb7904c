// Characters on the page.
#include "../catch.hpp"

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/placed_character.hpp>

using namespace calligraphy;

TEST_CASE("a placed character is scaled by its em and translated to its origin", "[model]") {
  const Placement place{{0.1, 0.2}, 0.05};
  CHECK(place.to_page({0, 0}) == Point(0.1, 0.2));
  CHECK(place.to_page({1, 1}).isApprox(Point(0.15, 0.25)));
  CHECK(place.to_page({0.5, 0.0}).isApprox(Point(0.125, 0.2)));
}

TEST_CASE("the bounding box of a character contains its control points and touches them on all sides", "[model]") {
  const Eigen::AlignedBox2d box = bounding_box({paper_example(), {{0.1, 0.2}, 0.04}});
  // From data/paper_example.txt: x from 0.08 to 0.90, y from 0.185 to 0.90 em.
  CHECK(box.min().isApprox(Point(0.1 + 0.08 * 0.04, 0.2 + 0.185 * 0.04)));
  CHECK(box.max().isApprox(Point(0.1 + 0.90 * 0.04, 0.2 + 0.90 * 0.04)));
}
