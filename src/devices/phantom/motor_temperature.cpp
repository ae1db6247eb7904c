#include "motor_temperature.hpp"

#include <algorithm>
#include <cmath>

namespace calligraphy::phantom {
namespace {

constexpr double winding_time = 12.0;   // [s]
constexpr double housing_time = 612.0;  // [s]
constexpr double winding_share = 3.1 / (3.1 + 14.0);

}  // namespace

MotorTemperature::MotorTemperature(const Eigen::Vector3d& continuous, const Eigen::Vector3d& peak)
    : continuous_(continuous), peak_(peak) {}

void MotorTemperature::advance(const Eigen::Vector3d& torque, double seconds) noexcept {
  const Eigen::Vector3d heat = torque.cwiseQuotient(continuous_).cwiseAbs2();
  winding_ += -std::expm1(-seconds / winding_time) * (heat - winding_);
  housing_ += -std::expm1(-seconds / housing_time) * (heat - housing_);
}

Eigen::Vector3d MotorTemperature::of_motors() const noexcept {
  return winding_share * winding_ + (1.0 - winding_share) * housing_;
}

double MotorTemperature::allowed_share(const Eigen::Vector3d& torque) const noexcept {
  const Eigen::Vector3d temperature = of_motors();
  double share = 1.0;
  for (Eigen::Index motor = 0; motor < 3; ++motor) {
    if (temperature[motor] <= warm) continue;
    const double left = std::max(1.0 - temperature[motor], 0.0) / (1.0 - warm);
    const double allowed = peak_[motor] * std::sqrt(left);
    if (std::abs(torque[motor]) > allowed) share = std::min(share, allowed / std::abs(torque[motor]));
  }
  return share;
}

}  // namespace calligraphy::phantom
