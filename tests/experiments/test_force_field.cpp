// Force fields around real strokes, and the cases of ambiguity in Figs. 25 to 28 of Wang 2006.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/experiments/force_field.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "../catch.hpp"
#include "../special_values.hpp"

using namespace calligraphy;

namespace {

const StrokeOptions as_printed = {.nearest = RendererOptions::wang2006().nearest, .rules = Rules::wang2006};

using calligraphy_test::not_a_number;

PlacedCharacter placed(char32_t code) { return {*built_in_characters().find(code), {}}; }

/// One horizontal line of 32 mm, 20 mm up.
PlacedCharacter straight_line() {
  const StrokeInput line{1, {{0.1, 0.5}, {0.9, 0.5}}};
  return {make_character(U'\u4E00', std::span(&line, 1)), {}};
}

const ForceFieldFigure& figure(const std::string& name) {
  static const std::vector<ForceFieldFigure> figures = ambiguity_figures(48);
  return *std::find_if(figures.begin(), figures.end(), [&](const ForceFieldFigure& each) { return each.name == name; });
}

const ForceField& nearest_stroke(const std::string& name) { return figure(name).panels.at(0).field; }
const ForceField& printed(const std::string& name) { return figure(name).panels.at(1).field; }
const ForceField& usual(const std::string& name) { return figure(name).panels.at(2).field; }

double nearest_jump(const ForceField& field) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const ForceJump& jump : field.jumps) nearest = std::min(nearest, jump.from_stroke);
  return nearest;
}

double distance_to(const PlacedCharacter& character, std::size_t stroke, const Point& point) {
  double distance = std::numeric_limits<double>::infinity();
  for (const StrokeElement& element : place_elements(strokes(character.character)[stroke], character.placement)) {
    distance = std::min(distance, nearest_point(element, point).distance);
  }
  return distance;
}

}  // namespace

TEST_CASE("beside a line the force is stiffness times distance, towards it", "[force field]") {
  ForceFieldOptions options;
  options.columns = 8;
  options.stiffness = 500.0;
  const ForceField field = guidance_field(straight_line(), 0, 0.5, {0.018, 0.0165}, 0.004, options);
  REQUIRE(field.forces.size() == 64);
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const Point place = field.place(column, row);
      CHECK(place.isApprox(Point(0.01825 + 0.0005 * column, 0.01675 + 0.0005 * row)));
      CHECK(std::abs(field.force(column, row).x()) < 1e-9);
      CHECK(field.force(column, row).y() == Approx(500.0 * (0.02 - place.y())).margin(1e-9));
    }
  }
  CHECK(field.max_force() == Approx(500.0 * 0.00325));
  CHECK(field.jumps.empty());
}

TEST_CASE("the default field of one line has no jump, the printed one jumps at its boundary", "[force field]") {
  ForceFieldOptions options;
  options.columns = 40;
  options.min_jump = 0.01;
  CHECK(guidance_field(straight_line(), 0, 0.5, {0.0, 0.0}, 0.04, options).jumps.empty());
  options.stroke = as_printed;
  const ForceField field = guidance_field(straight_line(), 0, 0.5, {0.0, 0.0}, 0.04, options);
  REQUIRE_FALSE(field.jumps.empty());
  // Sec. 4.3.1 (a)-(d): the half disc around the start, with the stroke's length as radius, and the feature plane.
  const Point start(0.004, 0.02);
  for (const ForceJump& jump : field.jumps) {
    const Point middle = 0.5 * (jump.begin + jump.end) - start;
    INFO(middle.x() << " " << middle.y());
    const double off = std::min({std::abs(middle.x()), std::abs(middle.norm() - 0.032), std::abs(middle.x() - 0.032)});
    CHECK(off < 1e-4);
    CHECK(jump.size == Approx(options.stiffness * std::abs(middle.y())).margin(options.stiffness * 0.001));  // a cell
  }
}

TEST_CASE("without an active stroke the force jumps where two strokes are equidistant", "[force field]") {
  const std::string name = GENERATE("parallel", "crossed");
  const PlacedCharacter& character = figure(name).placed;
  REQUIRE_FALSE(nearest_stroke(name).jumps.empty());
  for (const ForceJump& jump : nearest_stroke(name).jumps) {
    for (const Point& point : {jump.begin, jump.end}) {
      std::vector<double> distances;
      for (std::size_t i = 0; i < strokes(character.character).size(); ++i) {
        distances.push_back(distance_to(character, i, point));
      }
      std::sort(distances.begin(), distances.end());
      CHECK(distances[1] - distances[0] < 2e-4);  // where four lines meet they are joined within a cell
    }
    CHECK(jump.size <= 2.0 * 600.0 * 0.012);
    CHECK_FALSE(jump.passes_feature);
  }
}

TEST_CASE("Figs. 27 and 28: with the default rules parallel and crossed strokes cause no jump", "[force field]") {
  const std::string name = GENERATE("parallel", "crossed");
  CHECK(usual(name).jumps.empty());
  CHECK(usual(name).max_force() > 1.0);
}

TEST_CASE("Fig. 26: with the default rules the force jumps only where the corner is passed", "[force field]") {
  REQUIRE_FALSE(usual("corner").jumps.empty());
  for (const ForceJump& jump : usual("corner").jumps) CHECK(jump.passes_feature);
  CHECK(figure("corner").panels.at(2).fades_in);
  CHECK_FALSE(figure("corner").panels.at(1).fades_in);
}

TEST_CASE("Fig. 25: in a strong bend the default force is continuous within 2.5 mm of the stroke", "[force field]") {
  CHECK(nearest_jump(usual("bend")) > 0.0025);
  CHECK(nearest_jump(printed("bend")) < 0.0005);
}

TEST_CASE("at its current progress the pen is held by its own stroke, as printed and by default", "[force field]") {
  const std::string name = GENERATE("bend", "corner", "parallel", "crossed");
  const ForceFieldFigure& shown = figure(name);
  ForceFieldOptions options;
  options.columns = 5;
  if (GENERATE(true, false)) options.stroke = as_printed;
  constexpr double edge = 1e-4;
  const Point corner = shown.pen - Point(0.5 * edge, 0.5 * edge);
  const ForceField field = guidance_field(shown.placed, shown.stroke, shown.progress, corner, edge, options);
  CHECK(field.max_force() > 0.0);
  // Subdivision as printed may stop half a millimetre away; the previous element is many millimetres away.
  CHECK(field.max_force() < (is_printed(options.stroke.rules) ? 1.0 : options.stiffness * edge));
}

TEST_CASE("with the rules as printed the force jumps on the stroke itself", "[force field]") {
  const std::string name = GENERATE("bend", "corner", "parallel", "crossed");
  CHECK(nearest_jump(printed(name)) < 1.5 * printed(name).edge / printed(name).columns);
  CHECK(printed(name).max_force() > 2.0 * usual(name).max_force());
}

TEST_CASE("a field with parameters out of their domain is rejected", "[force field]") {
  const PlacedCharacter three = placed(U'\u4E09');
  const auto field = [&](int stroke, double progress, const Point& corner, double edge, auto change) {
    ForceFieldOptions options;
    options.columns = 4;
    change(options);
    return guidance_field(three, stroke, progress, corner, edge, options);
  };
  const auto as_it_is = [](ForceFieldOptions&) {};
  CHECK_NOTHROW(field(2, 1.0, {0.0, 0.0}, 0.04, as_it_is));
  CHECK_THROWS_AS(field(3, 0.5, {0.0, 0.0}, 0.04, as_it_is), ValueError);
  CHECK_THROWS_AS(field(-1, 0.5, {0.0, 0.0}, 0.04, as_it_is), ValueError);
  for (const double bad : {-0.1, 1.1, not_a_number}) {
    CHECK_THROWS_AS(field(0, bad, {0.0, 0.0}, 0.04, as_it_is), ValueError);
  }
  for (const double bad : {0.0, -0.04, not_a_number, std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(field(0, 0.5, {0.0, 0.0}, bad, as_it_is), ValueError);
  }
  CHECK_THROWS_AS(field(0, 0.5, {0.0, not_a_number}, 0.04, as_it_is), ValueError);
  CHECK_THROWS_AS(field(0, 0.5, {0.0, 0.0}, 0.04, [](ForceFieldOptions& o) { o.columns = 1; }), ValueError);
  CHECK_THROWS_AS(field(0, 0.5, {0.0, 0.0}, 0.04, [](ForceFieldOptions& o) { o.stiffness = -1.0; }), ValueError);
  CHECK_THROWS_AS(field(0, 0.5, {0.0, 0.0}, 0.04, [](ForceFieldOptions& o) { o.min_jump = 0.0; }), ValueError);
  CHECK_THROWS_AS(force_field_picture({}), ValueError);
}

TEST_CASE("a field reports its progress, and an exception from the callback ends it", "[force field]") {
  const PlacedCharacter three = placed(U'\u4E09');
  ForceFieldOptions options;
  options.columns = 8;
  std::vector<double> shares;
  options.progress = [&shares](double share) { shares.push_back(share); };
  const ForceField told = guidance_field(three, 0, 0.5, {0.0, 0.0}, 0.04, options);
  CHECK(shares.size() == 17);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  CHECK(shares.front() == 0.0);
  CHECK(shares.back() == 1.0);
  options.progress = nullptr;
  CHECK(guidance_field(three, 0, 0.5, {0.0, 0.0}, 0.04, options).forces == told.forces);
  for (const double enough : {0.25, 0.75}) {
    options.progress = [enough](double share) {
      if (share >= enough) throw Error("enough");
    };
    CHECK_THROWS_AS(guidance_field(three, 0, 0.5, {0.0, 0.0}, 0.04, options), Error);
  }
}

TEST_CASE("a picture of a field shows its panels, strokes, arrows and jumps, and stays small", "[force field]") {
  const std::vector<ForceFieldFigure> figures = ambiguity_figures();
  REQUIRE(figures.size() == 4);
  for (const ForceFieldFigure& each : figures) {
    INFO(each.name);
    const std::string text = force_field_picture(each);
    CHECK(text.size() < 150'000);
    pugi::xml_document document;
    REQUIRE(document.load_string(text.c_str()));
    const auto count = [&document](const char* path) { return document.select_nodes(path).size(); };
    CHECK(count("/svg/g[@class='field']") == 3);
    CHECK(count("//path[@class='active']") == 3);
    CHECK(count("//path[@class='other']") == 3 * (strokes(each.placed.character).size() - 1));
    CHECK(count("//path[@class='arrows']") == 3);
    CHECK(count("//circle[@class='pen']") == 4);  // one in the key
    const bool jumps_by_default = each.name == "bend";
    CHECK(count("//path[@class='jumps']") == (jumps_by_default ? 3 : 2));
    CHECK(count("//path[@class='passages']") == (each.name == "corner" ? 1 : 0));
  }
}
