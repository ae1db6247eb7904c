#include <limits>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;
using calligraphy_test::characters;

TEST_CASE("every square lies on its page and no two overlap", "[practice]") {
  const PageLayout layout;
  const auto pages = lay_out(characters("永北京航空天大学和年中国书法"), layout);
  std::size_t placed = 0;
  for (const PracticePage& page : pages) {
    placed += page.characters.size();
    for (std::size_t i = 0; i < page.characters.size(); ++i) {
      const Placement& place = page.characters[i].placement;
      CHECK(place.origin.x() >= 0.0);
      CHECK(place.origin.y() >= 0.0);
      CHECK(place.origin.x() + place.em <= page.width);
      CHECK(place.origin.y() + place.em <= page.height);
      for (std::size_t j = 0; j < i; ++j) {
        const Point apart = (place.origin - page.characters[j].placement.origin).cwiseAbs();
        CHECK(apart.maxCoeff() >= layout.em);
      }
    }
  }
  CHECK(placed == 14);
}

TEST_CASE("characters run left to right and top to bottom, in the order of the text", "[practice]") {
  const auto page = lay_out(characters("永北京航")).front();
  CHECK(page.characters[0].character.code == U'永');
  CHECK(page.characters[0].placement.origin.x() < page.characters[1].placement.origin.x());
  CHECK(page.characters[0].placement.origin.y() == page.characters[1].placement.origin.y());
  CHECK(page.characters[3].placement.origin.y() < page.characters[0].placement.origin.y());
}

TEST_CASE("a single character is centred on its page", "[practice]") {
  const auto page = lay_out(characters("永")).front();
  const Placement& place = page.characters[0].placement;
  CHECK(place.origin.x() + 0.5 * place.em == Approx(0.5 * page.width));
  CHECK(place.origin.y() + 0.5 * place.em == Approx(0.5 * page.height));
}

TEST_CASE("a page fills the workspace along the axes that its mapping uses, times the motion scale", "[practice]") {
  const Capabilities& omni = device_profile("omni");  // 160 x 120 x 70 mm
  const PageLayout upright = workspace_layout(omni);
  CHECK(upright.width == 0.16);
  CHECK(upright.height == 0.12);
  CHECK(upright.em == PageLayout().em);
  CHECK(upright.gap == PageLayout().gap);
  const PageLayout twice = workspace_layout(omni, upright_page(1.0, 1.0, 2.0));
  CHECK(twice.width == 0.32);
  CHECK(twice.height == 0.24);
  const PageLayout flat = workspace_layout(omni, desk_page(1.0, 1.0));
  CHECK(flat.width == 0.16);
  CHECK(flat.height == 0.07);
  CHECK(flat.em == PageLayout().em);
}

TEST_CASE("every corner of a page that fills the workspace lies on its faces", "[practice]") {
  const Capabilities& omni = device_profile("omni");
  for (const double scale : {0.5, 1.0, 3.0}) {
    for (MotionMapping (*page)(double, double, double) : {upright_page, desk_page}) {
      const PageLayout layout = workspace_layout(omni, page(0.0, 0.0, scale));
      const Eigen::Vector3d corner = page(layout.width, layout.height, scale).to_device({layout.width, 0.0, 0.0});
      CHECK(corner.x() == Approx(0.5 * omni.workspace.x()));
      if (page == upright_page) CHECK(corner.y() == Approx(-0.5 * omni.workspace.y()));
      if (page == desk_page) CHECK(corner.z() == Approx(0.5 * omni.workspace.z()));  // towards the user
    }
  }
}

TEST_CASE("where no square of the usual size fits, one smaller square does", "[practice]") {
  const PageLayout layout = workspace_layout(device_profile("omni"), desk_page(0.0, 0.0, 0.5));  // 80 x 35 mm
  CHECK(layout.em < PageLayout().em);
  CHECK(layout.em > 0.02);
  CHECK(lay_out(characters("永"), layout).size() == 1);
}

TEST_CASE("a page as large as its squares and gaps holds them, and one a millionth smaller does not", "[practice]") {
  const auto one = characters("永");
  for (const double em : {0.04, 0.037, 0.1, 1.0 / 3.0}) {
    for (int tenths = 0; tenths <= 10; ++tenths) {
      for (std::size_t count = 1; count <= 30; ++count) {
        CAPTURE(em, tenths, count);
        const double gap = 0.1 * tenths, all = static_cast<double>(count);
        const std::vector<Character> text(count, one.front());
        PageLayout layout{(all + gap * (all + 1.0)) * em, (1.0 + 2.0 * gap) * em, em, gap * em};
        REQUIRE(lay_out(text, layout).size() == 1);
        std::swap(layout.width, layout.height);
        REQUIRE(lay_out(text, layout).size() == 1);
        layout.height *= 1.0 - 1e-6;
        if (count > 1) REQUIRE(lay_out(text, layout).size() == 2);
      }
    }
  }
}

TEST_CASE("characters in braces are laid out as a list of them is", "[practice]") {
  const std::vector<Character> list = characters("永北");
  const PageLayout layout{0.05, 0.05, 0.04, 0.004};
  const auto pages = lay_out({list[0], list[1]}, layout);
  REQUIRE(pages.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(page_id(pages[i]) == page_id(lay_out(list, layout)[i]));
}

TEST_CASE("an empty text gives no page", "[practice]") { CHECK(lay_out({}).empty()); }

TEST_CASE("a layout that cannot hold a character is rejected", "[practice]") {
  const auto one = characters("永");
  PageLayout layout;
  SECTION("too large a square") { layout.em = 0.2; }
  SECTION("a negative width") { layout.width = -0.1; }
  SECTION("a height that is not a number") { layout.height = std::numeric_limits<double>::quiet_NaN(); }
  SECTION("an infinite gap") { layout.gap = std::numeric_limits<double>::infinity(); }
  SECTION("an em of zero") { layout.em = 0.0; }
  SECTION("an em whose strokes have lengths near the smallest numbers") { layout = {5e-324, 5e-324, 5e-324, 0.0}; }
  SECTION("an em whose strokes have no finite length") { layout = {1e200, 1e200, 1e200, 0.0}; }
  CHECK_THROWS_AS(lay_out(one, layout), ValueError);
}
