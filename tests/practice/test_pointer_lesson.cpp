#include <calligraphy/practice/pointer_lesson.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <calligraphy/devices/device_profiles.hpp>

#include "../catch.hpp"
#include "../pen_path.hpp"
#include "pages.hpp"

namespace pointer_lesson_tests {

using namespace calligraphy;
using calligraphy_test::page_of;

namespace {

/// Moves a pointer, event by event, and calls advance() at the rate of a display.
class Hand {
 public:
  explicit Hand(double display_rate, std::string_view text = "三") : frame_(1.0 / display_rate) {
    LessonOptions options;
    const Capabilities device = device_profile("ideal");
    options.renderer = RendererOptions::for_device(device);
    options.strength = 0.6;
    lesson = std::make_unique<PointerLesson>(std::vector{page_of(text)}, device, options);
  }

  std::vector<Point> path(std::size_t stroke) const {
    const PlacedCharacter& placed = lesson->lesson().page().characters.front();
    return calligraphy_test::path_of(strokes(placed.character)[stroke], placed.placement, 1e-3);
  }

  void event(const Point& place, bool is_down, bool is_cancelled = false) {
    lesson->move(
        {.time = time_, .place = place, .is_down = is_down, .is_cancelled = is_cancelled, .kind = kind, .id = id});
    const double next = time_ + 0.008;
    for (double frame = std::ceil(time_ / frame_) * frame_; frame < next; frame += frame_) lesson->advance(frame);
    time_ = next;
  }

  void skip(double seconds) { time_ += seconds; }
  void wait(double seconds) {
    time_ += seconds;
    lesson->advance(time_);
  }

  /// The part of a stroke up to a share of its points.
  void write(std::size_t stroke, double share = 1.0, bool is_cancelled = false) {
    const std::vector<Point> points = path(stroke);
    const auto count = static_cast<std::size_t>(share * static_cast<double>(points.size()));
    if (kind != PointerKind::touch) event(points.front(), false);
    for (std::size_t i = 0; i < count; ++i) event(points[i], true);
    event(points[count - 1], false, is_cancelled);
    wait(0.5);
  }

  std::string events() {
    lesson->lesson().look();
    std::string text;
    for (LessonEvent event; lesson->lesson().take_event(event);) {
      text += std::string(text.empty() ? "" : ", ") + to_string(event.kind) + " " + std::to_string(event.stroke + 1);
      ticks.push_back(event.tick);
    }
    return text;
  }

  std::unique_ptr<PointerLesson> lesson;
  PointerKind kind = PointerKind::mouse;
  int id = 1;
  std::vector<std::uint64_t> ticks;

 private:
  double frame_;  ///< [s]
  double time_ = 10.0;
};

}  // namespace

TEST_CASE("a pointer's lesson depends on its events, not on when pictures are drawn", "[lesson]") {
  std::vector<std::uint64_t> ticks;
  for (const double display_rate : {1000.0, 60.0, 7.0}) {
    Hand hand(display_rate);
    hand.write(0, 0.5);
    hand.wait(20.0);  // a rest, of which nothing is spent
    for (std::size_t stroke = 0; stroke < 3; ++stroke) hand.write(stroke);
    hand.wait(1.0);
    CHECK(hand.events() == "restarted 1, begun 1, refused 1, begun 1, accepted 1, begun 2, accepted 2, begun 3, "
                           "accepted 3, finished 3");
    CHECK(hand.ticks.back() < 8000);
    if (ticks.empty()) ticks = hand.ticks;
    CHECK(hand.ticks == ticks);
    CHECK_FALSE(hand.lesson->is_busy());
  }
}

TEST_CASE("nothing is lost if a picture is drawn long after the writing", "[lesson]") {
  Hand hand(0.001);
  for (std::size_t stroke = 0; stroke < 3; ++stroke) {
    for (const Point& point : hand.path(stroke)) hand.event(point, true);
    hand.event(hand.path(stroke).back(), false);
    hand.skip(70.0);
  }
  hand.wait(1.0);
  CHECK(hand.events() == "restarted 1, begun 1, accepted 1, begun 2, accepted 2, begun 3, accepted 3, finished 3");
}

TEST_CASE("a command is carried out at rest, too, at the next picture", "[lesson]") {
  Hand hand(60.0);
  hand.write(0);
  hand.wait(5.0);
  hand.lesson->lesson().send({LessonCommandKind::skip});
  CHECK(hand.lesson->is_busy());
  hand.wait(0.016);
  CHECK(hand.lesson->lesson().look().due == 2);
  CHECK_FALSE(hand.lesson->is_busy());
}

TEST_CASE("a palm and a touch that the system takes are no misses, and a bounce writes on", "[lesson]") {
  Hand hand(60.0);
  hand.kind = PointerKind::touch;
  hand.write(0, 0.6, true);
  CHECK(hand.events() == "restarted 1, begun 1, ignored 1");
  const std::vector<Point> path = hand.path(0);
  for (std::size_t i = 0; i < path.size() / 2; ++i) hand.event(path[i], true);  // a palm, until a pen comes
  hand.kind = PointerKind::pen;
  hand.id = 2;
  hand.write(0);
  CHECK(hand.events() == "begun 1, ignored 1, begun 1, accepted 1");
  hand.kind = PointerKind::touch;
  hand.id = 3;
  hand.write(1);  // too soon after the pen
  CHECK(hand.events().empty());
  hand.kind = PointerKind::mouse;
  const std::vector<Point> second = hand.path(1);
  for (std::size_t i = 0; i < second.size(); ++i) hand.event(second[i], i == 0 || i != second.size() / 2);
  hand.event(second.back(), false);
  hand.wait(0.5);
  CHECK(hand.events() == "begun 2, accepted 2");
}

}  // namespace pointer_lesson_tests
