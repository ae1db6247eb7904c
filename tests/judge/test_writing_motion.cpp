#include <cmath>
#include <vector>

#include <calligraphy/judge/writing_motion.hpp>

#include "../catch.hpp"

using namespace calligraphy;

TEST_CASE("the motion of several pen-downs sums them up", "[judge]") {
  const double nan = std::nan("");
  const std::vector<PenKinematics> pen_downs = {
      {2.0, 0.5, 0.03, 0.06, 0.3, 1, -1.5}, {3.0, 0.01, 0.0, nan, nan, 0, nan}, {3.5, 1.5, 0.07, 0.05, 0.2, 3, -2.5}};
  const WritingMotion motion = writing_motion(pen_downs);
  CHECK(motion.duration == 3.0);
  CHECK(motion.time_on_paper == Approx(2.01));
  CHECK(motion.time_in_air == Approx(0.99));
  CHECK(motion.pen_ups == 2);
  CHECK(motion.path_length == Approx(0.1));
  CHECK(motion.mean_speed == Approx(0.1 / 2.01));
  CHECK(motion.peak_speed == 0.3);
  CHECK(motion.velocity_peaks == 4);
  CHECK(motion.smoothness == -2.0);
}

TEST_CASE("without a pen-down there is no motion to measure", "[judge]") {
  const WritingMotion motion = writing_motion({});
  CHECK(motion.duration == 0.0);
  CHECK(motion.pen_ups == 0);
  for (const double value : {motion.mean_speed, motion.peak_speed, motion.smoothness}) CHECK(std::isnan(value));
}
