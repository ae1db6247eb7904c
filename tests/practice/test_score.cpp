#include <cmath>

#include <calligraphy/collision/stroke_element.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/practice/score.hpp>

#include "../catch.hpp"
#include "pages.hpp"

using namespace calligraphy;
using calligraphy_test::page_of;

namespace {

/// A pen moved directly through a renderer: no device, no writer, so that the ground truth is known.
class Pen {
 public:
  explicit Pen(const PracticePage& page)
      : page_(page),
        mapping_(upright_page(page.width, page.height)),
        renderer_(page.characters, mapping_, device_profile("ideal")) {
    rest();
  }

  /// Draws a stroke of a character of the page, shifted, at 0.1 mm per tick, then lifts the pen.
  void draw(int character, int stroke, const Point& shift = Point::Zero(), bool backwards = false) {
    const PlacedCharacter& placed = page_.characters[static_cast<std::size_t>(character)];
    const Stroke truth = strokes(placed.character)[static_cast<std::size_t>(stroke)];
    std::vector<Point> path;
    for (const StrokeElement& element : place_elements(truth, placed.placement)) {
      const int steps = std::max(2, static_cast<int>(element.length() / 1e-4));
      for (int s = 0; s <= steps; ++s) {
        path.push_back(shift + element.point(element.parameter_at(element.length() * s / steps)));
      }
    }
    if (backwards) std::reverse(path.begin(), path.end());
    draw(path);
  }

  void draw(const std::vector<Point>& path) {
    hover(path.front());
    for (const Point& point : path) step({point.x(), point.y(), -1e-4});
    hover(path.back());
  }

  std::vector<CharacterScore> scores() const { return score_page(page_, recording_); }

 private:
  void rest() { hover({0.5 * page_.width, 0.5 * page_.height}); }
  void hover(const Point& point) {
    for (int i = 0; i < 100; ++i) step({point.x(), point.y(), 0.005});
  }
  void step(const Eigen::Vector3d& point) {
    DeviceState state;
    state.time = static_cast<double>(recording_.samples.size()) * 1e-3 * 100;  // slow enough for any motion in the air
    state.position = mapping_.to_device(point);
    const HapticTick& tick = renderer_.update(state);
    recording_.samples.push_back({tick.time, tick.device_point, tick.pen_tip, tick.page_force, tick.state, tick.events,
                                  tick.status, tick.character, tick.stroke, 0.0F});
  }

  PracticePage page_;
  MotionMapping mapping_;
  HapticRenderer renderer_;
  Recording recording_;
};

}  // namespace

TEST_CASE("a perfect copy has no error, no mistake and full fidelity", "[practice]") {
  Pen pen(page_of("永"));
  for (int stroke = 0; stroke < 5; ++stroke) pen.draw(0, stroke);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_completed == 5);
  CHECK(result.mistakes.empty());
  CHECK(result.rms_error < 1e-7);
  CHECK(result.fidelity == Approx(1.0).epsilon(1e-4));
}

TEST_CASE("a heng drawn 1 mm too high has a lateral error of 1 mm", "[practice]") {
  const PracticePage page = page_of("一");
  const Point along = strokes(page.characters[0].character)[0].control_points[1] -
                      strokes(page.characters[0].character)[0].control_points[0];
  const Point across = 1e-3 * Point(-along.y(), along.x()).normalized();
  Pen pen(page);
  pen.draw(0, 0, across);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_completed == 1);
  CHECK(result.rms_error == Approx(1e-3).epsilon(1e-9));
  CHECK(result.max_error == Approx(1e-3).epsilon(1e-9));
  CHECK(result.contour == Approx(std::exp(-0.5)).epsilon(1e-6));  // 1 mm of an em of 40 mm, against 5 %
}

TEST_CASE("the score of a stroke begins where the pen is put down, before the stroke is recognised", "[practice]") {
  const PracticePage page = page_of("一");
  const PlacedCharacter& placed = page.characters[0];
  const std::vector<Stroke> drawn = strokes(placed.character);
  const auto points = drawn[0].control_points;
  const Point start = placed.placement.to_page(points[0]), end = placed.placement.to_page(points[1]);
  const Point along = (end - start).normalized(), left(-along.y(), along.x());
  Pen pen(page);
  std::vector<Point> path;
  for (double way = 0.0; way < 0.003; way += 1e-4) path.push_back(start + (0.003 - way) * left);  // down to the start
  for (double way = 0.0; way <= (end - start).norm(); way += 1e-4) path.push_back(start + way * along);
  pen.draw(path);
  const CharacterScore result = pen.scores().front();
  CHECK(result.strokes_completed == 1);
  CHECK(result.max_error == Approx(0.003).epsilon(1e-6));
}

TEST_CASE("a stroke written out of order is an order mistake that names both strokes", "[practice]") {
  Pen pen(page_of("永"));
  pen.draw(0, 4);
  for (int stroke = 0; stroke < 5; ++stroke) pen.draw(0, stroke);
  const CharacterScore result = pen.scores().front();
  REQUIRE(result.order_mistakes() == 1);
  CHECK(result.direction_mistakes() == 0);
  CHECK(result.mistakes[0].stroke == 0);
  CHECK(result.mistakes[0].reason.find("stroke 5") != std::string::npos);
  CHECK(result.mistakes[0].reason.find("stroke 1") != std::string::npos);
  CHECK(result.external_sequence == Approx(5.0 / 6.0));
  CHECK(result.internal_sequence == 1.0);
}

TEST_CASE("a stroke written twice is an order mistake", "[practice]") {
  Pen pen(page_of("永"));
  pen.draw(0, 0);
  pen.draw(0, 1);
  pen.draw(0, 1);
  for (int stroke = 2; stroke < 5; ++stroke) pen.draw(0, stroke);
  const CharacterScore result = pen.scores().front();
  REQUIRE(result.order_mistakes() == 1);
  CHECK(result.mistakes[0].reason.find("again") != std::string::npos);
  CHECK(result.strokes_completed == 5);
}

TEST_CASE("every stroke of every built-in character, written backwards, is a direction mistake and not accepted",
          "[practice]") {
  for (const Character& character : built_in_characters().characters) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    const auto drawn = strokes(character);
    for (int stroke = 0; stroke < character.stroke_count(); ++stroke) {
      const auto& points = drawn[static_cast<std::size_t>(stroke)].control_points;
      if ((points.front() - points.back()).norm() < 0.1) continue;  // a ring ends where it begins
      CAPTURE(encode_utf8(character.code), stroke);
      Pen pen(page);
      for (int i = 0; i < stroke; ++i) pen.draw(0, i);
      pen.draw(0, stroke, Point::Zero(), true);
      for (int i = stroke; i < character.stroke_count(); ++i) pen.draw(0, i);
      const CharacterScore result = pen.scores().front();
      CHECK(result.strokes_completed == character.stroke_count());
      CHECK(result.direction_mistakes() == 1);
      CHECK(result.order_mistakes() == 0);
    }
  }
}

TEST_CASE("a partly written page scores what was written and zero for the rest", "[practice]") {
  Pen pen(page_of("永北"));
  for (int stroke = 0; stroke < 5; ++stroke) pen.draw(0, stroke);
  pen.draw(1, 0);
  const auto results = pen.scores();
  REQUIRE(results.size() == 2);
  CHECK(results[0].strokes_completed == 5);
  CHECK(results[1].strokes_completed == 1);
  CHECK(results[1].contour == Approx(0.2).epsilon(1e-3));
}

TEST_CASE("an empty recording scores zero", "[practice]") {
  const PracticePage page = page_of("永");
  const auto results = score_page(page, Recording());
  REQUIRE(results.size() == 1);
  CHECK(results[0].strokes_completed == 0);
  CHECK(results[0].fidelity == 0.0);
}
