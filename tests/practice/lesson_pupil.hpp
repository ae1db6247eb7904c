// A pen that moves as a test prescribes, in a lesson.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/practice/lesson.hpp>

#include "../pen_path.hpp"

namespace calligraphy_test {

class Pupil {
 public:
  explicit Pupil(calligraphy::Lesson& lesson) : lesson_(lesson) {}

  std::function<void()> on_tick = [] {};
  std::optional<Point> beside_hand;  ///< the lesson is told that the hand is this far from the pen [m]
  double speed = 0.1;     ///< [m/s]

  const calligraphy::HapticTick& at(const Point& place, double z) {
    calligraphy::DeviceState state;
    state.time = 1e-3 * static_cast<double>(ticks);
    state.position = {place.x(), place.y(), z};
    ++ticks;
    place_ = place;
    height_ = z;
    calligraphy::LessonHand hand;
    hand.place = place + beside_hand.value_or(Point(0.0, 0.0));
    const calligraphy::HapticTick& tick = lesson_.update(state, beside_hand ? &hand : nullptr);
    on_tick();
    return tick;
  }

  void wait(double seconds) {
    for (int i = 0; i < seconds * 1e3; ++i) at(place_, height_);
  }

  void go(const Point& to, double z) {
    const Point from = place_;
    const double height = height_;
    const int count = static_cast<int>(std::ceil(std::hypot((to - from).norm(), z - height) / (1e-3 * speed)));
    for (int i = 1; i <= count; ++i) at(from + (to - from) * i / count, height + (z - height) * i / count);
  }

  /// Begins and ends in the air, long enough for what becomes of it to be known.
  void write(const std::vector<Point>& path) {
    go(path.front(), 0.005);
    for (const Point& point : path) go(point, -0.001);
    go(path.back(), 0.005);
    wait(0.3);
  }

  /// A stroke of the first character of the lesson's page.
  std::vector<Point> path(std::size_t stroke) const {
    const calligraphy::PlacedCharacter& placed = lesson_.page().characters.front();
    return path_of(strokes(placed.character)[stroke], placed.placement, 1e-4);
  }

  std::vector<Point> backwards(std::size_t stroke) const {
    const std::vector<Point> forwards = path(stroke);
    return {forwards.rbegin(), forwards.rend()};
  }

  /// All that has happened since the last call: "refused backwards 1, accepted 1, skipped 2".
  std::string events() {
    lesson_.look();
    std::string text;
    calligraphy::LessonEvent event;
    while (lesson_.take_event(event)) {
      text += std::string(text.empty() ? "" : ", ") + to_string(event.kind);
      if (event.reason != calligraphy::RefusalReason::none) text += std::string(" ") + to_string(event.reason);
      text += " " + std::to_string(event.stroke + 1);
    }
    return text;
  }

  std::uint64_t ticks = 0;

 private:
  calligraphy::Lesson& lesson_;
  Point place_ = Point(0.08, 0.06);
  double height_ = 0.005;  ///< [m]
};

}  // namespace calligraphy_test
