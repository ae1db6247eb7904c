// The four cases of ambiguous force: Wang 2006, sec. 6, Figs. 25 to 28.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/model/character_list.hpp>

#include "../pen_path.hpp"

using namespace calligraphy;
using calligraphy_test::beside;
using calligraphy_test::draw_line;
using calligraphy_test::path_of;

namespace {

const Placement at_origin{{0.0, 0.0}, 0.04};
constexpr double drawn_step = 0.0001;

Character stroke_of(int id, std::vector<Point> points) {
  const StrokeInput input{id, std::move(points)};
  return make_character(U'\u4E00', std::span(&input, 1));
}

struct Run {
  bool finished = false;
  double max_jump = 0.0;       ///< maximum, of the closest point from one update to the next [m]
  double furthest_back = 0.0;  ///< [m]
};

Run follow(const Character& character, const std::vector<Point>& path, const StrokeOptions& options = {}) {
  ActiveStroke active;
  active.load(strokes(character)[0], at_origin);
  Run run;
  StrokeContact last;
  for (std::size_t i = 0; i < path.size() && !run.finished; ++i) {
    const StrokeContact contact = active.update(path[i], options);
    run.finished = contact.finished;
    run.furthest_back = std::max(run.furthest_back, contact.backwards);
    if (i > 0) run.max_jump = std::max(run.max_jump, (contact.closest.point - last.closest.point).norm());
    last = contact;
  }
  return run;
}

}  // namespace

TEST_CASE("Fig. 25, sharp bend: the closest point stays on its own limb of a hairpin", "[collision]") {
  // Limbs 3.5 mm apart, the pen 2.5 mm towards the other limb: there the nearest point of the whole element lies.
  const Character hairpin = stroke_of(4, {{0.1, 0.5}, {1.3, 0.5}, {1.3, 0.6}, {0.1, 0.59}});
  const std::vector<Point> path = beside(path_of(strokes(hairpin)[0], at_origin, drawn_step), 0.0025);
  std::vector<Point> first_limb(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(path.size() / 3));
  const Run windowed = follow(hairpin, first_limb);
  CHECK(windowed.furthest_back == Approx(0.0).margin(1e-6));
  CHECK(windowed.max_jump < 3.0 * drawn_step);
  CHECK_FALSE(windowed.finished);
  // Searched on the whole element, as printed, the closest point is on the other limb at once.
  CHECK(follow(hairpin, first_limb, {.rules = Rules::wang2006}).finished);
  CHECK(follow(hairpin, path_of(strokes(hairpin)[0], at_origin, drawn_step)).finished);
}

TEST_CASE("Fig. 25, sharp bend: a pen on the other limb makes no progress on this one", "[collision]") {
  const Character hairpin = stroke_of(4, {{0.1, 0.5}, {1.3, 0.5}, {1.3, 0.6}, {0.1, 0.59}});
  ActiveStroke active;
  active.load(strokes(hairpin)[0], at_origin);
  active.update(active.start(), {});
  const StrokeContact jumped = active.update(at_origin.to_page({0.1, 0.59}), {});
  CHECK_FALSE(jumped.finished);
  CHECK(jumped.arc < 0.008 + 1e-4);
}

TEST_CASE("Fig. 26, corner: a pen that cuts or overshoots it continues on the second limb", "[collision]") {
  const Character corner = calligraphy_test::typical_character(16);
  const Stroke stroke = strokes(corner)[0];
  const Point start = at_origin.to_page(stroke.control_points[0]), turn = at_origin.to_page(stroke.control_points[1]),
              end = at_origin.to_page(stroke.control_points[2]);
  const Point along = (turn - start).normalized(), down = (end - turn).normalized();
  for (const double cut : {0.001, 0.003, 0.005}) {
    std::vector<Point> path = {start};
    draw_line(path, turn - cut * along, drawn_step);
    draw_line(path, turn + cut * down, drawn_step);
    draw_line(path, end, drawn_step);
    INFO("cut by " << cut << " m");
    CHECK(follow(corner, path).finished);
  }
  for (const double overshoot : {0.001, 0.003, 0.006}) {
    std::vector<Point> path = {start};
    draw_line(path, turn + overshoot * along, drawn_step);
    draw_line(path, turn + overshoot * (along + down), drawn_step);
    draw_line(path, end, drawn_step);
    INFO("overshot by " << overshoot << " m");
    CHECK(follow(corner, path).finished);
  }
}

TEST_CASE("Fig. 26, corner: a pen inside it continues on the second limb where both attract it equally",
          "[collision]") {
  const Character corner = calligraphy_test::typical_character(16);
  const Stroke stroke = strokes(corner)[0];
  const Point start = at_origin.to_page(stroke.control_points[0]), turn = at_origin.to_page(stroke.control_points[1]),
              end = at_origin.to_page(stroke.control_points[2]);
  const Point below(0.0, -1.0), left(-1.0, 0.0);
  for (const double inside : {0.0016, 0.002, 0.0025}) {  // the plane itself counts as crossed up to 1.5 mm before it
    std::vector<Point> path = {start + inside * below};
    draw_line(path, turn + inside * (below + left), drawn_step);
    draw_line(path, end + inside * left, drawn_step);
    ActiveStroke active;
    active.load(stroke, at_origin);
    double last = inside, max_change = 0.0;
    bool finished = false;
    for (std::size_t i = 0; i < path.size() && !finished; ++i) {
      const StrokeContact contact = active.update(path[i], {});
      max_change = std::max(max_change, std::abs(contact.closest.distance - last));
      last = contact.closest.distance;
      finished = contact.finished;
    }
    INFO("inside by " << inside << " m");
    CHECK(finished);
    CHECK(max_change < 2.0 * drawn_step);  // so the magnitude of the force does not step where its direction turns
  }
}

TEST_CASE("Fig. 26, corner: on its bisector the closest point belongs to one limb and does not alternate",
          "[collision]") {
  const Character corner = calligraphy_test::typical_character(16);
  ActiveStroke active;
  const Stroke stroke = strokes(corner)[0];
  active.load(stroke, at_origin);
  std::vector<Point> path = {active.start()};
  const Point turn = at_origin.to_page(stroke.control_points[1]);
  draw_line(path, turn, drawn_step);
  for (const Point& tip : path) active.update(tip, {});
  int changes = 0, element = active.update(turn, {}).element;
  for (int i = 0; i < 200; ++i) {
    const Point inside = turn + Point(-0.003, -0.003) + (i % 2 ? 0.0002 : -0.0002) * Point(1.0, -1.0);
    const StrokeContact contact = active.update(inside, {});
    changes += contact.element != element;
    element = contact.element;
  }
  CHECK(changes == 0);
}

TEST_CASE("Fig. 27, parallel strokes: only the active one attracts", "[collision]") {
  const Character* three = built_in_characters().find(U'三');
  REQUIRE(three != nullptr);
  const std::vector<Stroke> all = strokes(*three);
  ActiveStroke active;
  active.load(all[1], at_origin);
  for (const Point& tip : path_of(all[0], at_origin, drawn_step)) {  // the pen runs along the stroke above
    const StrokeContact contact = active.update(tip, {});
    const double to_active = nearest_point(active.element(0), tip).distance;
    REQUIRE(contact.closest.distance >= to_active - 1e-12);
    REQUIRE_FALSE(contact.finished);
  }
}

TEST_CASE("Fig. 28, crossing strokes: crossing the other stroke changes nothing", "[collision]") {
  const Character* ten = built_in_characters().find(U'十');
  REQUIRE(ten != nullptr);
  const std::vector<Stroke> all = strokes(*ten);
  ActiveStroke active;
  active.load(all[1], at_origin);  // the vertical stroke, across the finished horizontal one
  double max_force_arm = 0.0, last_arc = 0.0;
  int falls = 0;
  bool finished = false;
  for (const Point& tip : path_of(all[1], at_origin, drawn_step)) {
    const StrokeContact contact = active.update(tip, {});
    max_force_arm = std::max(max_force_arm, contact.closest.distance);
    falls += contact.arc < last_arc;
    last_arc = contact.arc;
    finished = finished || contact.finished;
    if (finished) break;
  }
  CHECK(finished);
  CHECK(falls == 0);
  CHECK(max_force_arm < 1e-9);
}
