#include <cmath>
#include <numbers>
#include <string>

#include <calligraphy/practice/hint_text.hpp>

#include "../catch.hpp"

using namespace calligraphy;

namespace {

Point way(double degrees, double length) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return length * Point(std::cos(angle), std::sin(angle));
}

}  // namespace

TEST_CASE("a hint says how far the start is and in which of eight directions", "[practice]") {
  const char* const directions[] = {"to the right", "to the upper right", "straight up",   "to the upper left",
                                    "to the left",  "to the lower left",  "straight down", "to the lower right"};
  for (int i = 0; i < 8; ++i) {
    for (const double aside : {-22.0, 0.0, 22.0}) {
      for (const double turn : {-360.0, 0.0}) {
        CAPTURE(i, aside, turn);
        CHECK(hint_text(WritingHint::too_far, way(45.0 * i + aside + turn, 0.0123)) ==
              std::string("too far from the start: 12 mm ") + directions[i]);
      }
    }
  }
  CHECK(hint_text(WritingHint::at_end, {-0.03, 0.0}) == "at the stroke's end: the start is 30 mm to the left");
  CHECK(hint_text(WritingHint::in_middle, {0.0, -0.0008}) ==
        "in the middle of the stroke: the start is 1 mm straight down");
  CHECK(hint_text(WritingHint::another_stroke, {0.0001, 0.0}) ==
        "another stroke's start: that of the one due is 1 mm to the right");
}

TEST_CASE("a hint that leads nowhere else names no direction", "[practice]") {
  const Point anywhere(0.01, 0.01);
  CHECK(hint_text(WritingHint::none, anywhere).empty());
  CHECK(hint_text(WritingHint::write, anywhere) == "write on");
  CHECK(hint_text(WritingHint::wrong_direction, anywhere) == "wrong direction");
  CHECK(hint_text(WritingHint::off_stroke, anywhere) == "too far from the stroke");
  CHECK(hint_text(WritingHint::lift_first, anywhere) == "lift the pen first");
  CHECK(hint_text(WritingHint::warm_motors, anywhere) == "the motors are warm: less force");
  CHECK(hint_text(WritingHint::lifted_early, anywhere) == "lifted early? go on, or write it again");
  CHECK(hint_text(WritingHint::too_far, {std::nan(""), 0.0}) == "too far from the start");
}

TEST_CASE("a hint is told in the language asked for", "[practice]") {
  const Language chinese("zh");
  CHECK(hint_text(WritingHint::none, {0.01, 0.01}, chinese).empty());
  CHECK(hint_text(WritingHint::lift_first, {0.01, 0.01}, chinese) == "先提笔");
  CHECK(hint_text(WritingHint::too_far, {-0.0085, 0.0085}, chinese) == "离起点太远：起点在左上方 12 毫米处");
  CHECK(hint_text(WritingHint::too_far, {std::nan(""), 0.0}, chinese) == "离起点太远");
}
