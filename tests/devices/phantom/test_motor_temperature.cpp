#include <cmath>

#include "devices/phantom/motor_temperature.hpp"

#include "../../catch.hpp"

using namespace calligraphy::phantom;

namespace {

const Eigen::Vector3d continuous(0.1, 0.2, 0.3);
const Eigen::Vector3d peak(0.4, 0.8, 1.2);

}  // namespace

TEST_CASE("a motor heats with the square of its torque, winding first, and cools again", "[phantom][heat]") {
  MotorTemperature motors(continuous, peak);
  CHECK(motors.warmest() == 0.0);
  const Eigen::Vector3d torque(0.1, -0.4, 0.0);
  motors.advance(torque, 30.0);
  // Two first-order lags of 12 s and 612 s, their shares 3.1 and 14 of 17.1.
  const double rise = (3.1 * (1.0 - std::exp(-30.0 / 12.0)) + 14.0 * (1.0 - std::exp(-30.0 / 612.0))) / 17.1;
  CHECK(motors.of_motors().x() == Approx(rise).epsilon(1e-12));
  CHECK(motors.of_motors().y() == Approx(4.0 * rise).epsilon(1e-12));
  CHECK(motors.of_motors().z() == 0.0);
  CHECK(motors.warmest() == motors.of_motors().y());
  MotorTemperature same(continuous, peak);
  for (int i = 0; i < 30000; ++i) same.advance(torque, 1e-3);
  CHECK(same.of_motors().x() == Approx(rise).epsilon(1e-9));  // however time is cut
  motors.advance(Eigen::Vector3d::Zero(), 6000.0);
  CHECK(motors.warmest() < 1e-3);
  MotorTemperature for_ever(continuous, peak);
  for_ever.advance(continuous, 1e5);
  CHECK(for_ever.warmest() == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("a motor commanded at its peak for hours never reaches 1, and keeps its continuous torque to 1 %",
          "[phantom][heat]") {
  MotorTemperature motors(continuous, peak);
  CHECK(motors.allowed_share(peak) == 1.0);
  double share = 1.0;
  for (int i = 0; i < 4 * 3600 * 10; ++i) {
    share = motors.allowed_share(peak);
    motors.advance(share * peak, 0.1);
    REQUIRE(motors.warmest() < 1.0);
  }
  CHECK(share * peak.x() == Approx(0.1).epsilon(0.01));
  CHECK(motors.warmest() > 0.98);
}

TEST_CASE("the permitted fraction is that of the warmest motor and never increases a torque", "[phantom][heat]") {
  MotorTemperature motors(continuous, peak);
  motors.advance({0.1, 0.0, 0.0}, 1400.0);
  REQUIRE(motors.of_motors().x() > MotorTemperature::warm);
  CHECK(motors.allowed_share({0.0, 0.8, 1.2}) == 1.0);
  CHECK(motors.allowed_share({0.01, 0.8, 1.2}) == 1.0);
  const double share = motors.allowed_share(peak);
  CHECK(share < 1.0);
  CHECK(motors.allowed_share(2.0 * peak) == Approx(share / 2.0));
  CHECK(motors.allowed_share(share * peak) == Approx(1.0));
}
