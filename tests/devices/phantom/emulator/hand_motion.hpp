// The hand that holds an emulated device.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include <calligraphy/devices/simulated_device.hpp>

namespace calligraphy_test {

class HandMotion {
 public:
  virtual ~HandMotion() = default;

  /// Start position, device axes [m].
  virtual Eigen::Vector3d start() const = 0;

  /// Receives the position of the tip and returns the intended motion for the next `seconds`.
  virtual calligraphy::Intention next(const Eigen::Vector3d& tip, double seconds) = 0;
};

/// Circles in the x-y plane with a radius of 20 mm, twice per second.
class CirclingHand final : public HandMotion {
 public:
  Eigen::Vector3d start() const override { return at(0.0); }
  calligraphy::Intention next(const Eigen::Vector3d&, double seconds) override {
    const Eigen::Vector3d from = at(time_);
    time_ += seconds;
    return {from, (at(time_) - from) / seconds};
  }

 private:
  static Eigen::Vector3d at(double time) {
    constexpr double turns = 2.0 * 2.0 * 3.14159265358979323846;  // [rad/s]
    return {0.02 * std::cos(turns * time), 0.02 * std::sin(turns * time), 0.02};
  }
  double time_ = 0.0;
};

}  // namespace calligraphy_test
