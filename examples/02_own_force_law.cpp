// Your own force law on a simulated device: how far does the hand press into a virtual wall?
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/simulated_device.hpp>

namespace {

/// A wall below z = 0: a spring and a damper that never pull [N]. The velocity is an estimate, as on most devices; a
/// Servo also estimates that of a backend which has none, so that it is never NaN.
Eigen::Vector3d wall(const calligraphy::DeviceState& state) {
  const double penetration = -state.position.z();
  if (penetration <= 0.0) return Eigen::Vector3d::Zero();
  return {0.0, 0.0, std::max(0.0, 800.0 * penetration - 2.0 * state.velocity.z())};
}

}  // namespace

int main() {
  using namespace calligraphy;
  const GripImpedance firm{0.15, 5.0, 500.0};
  SimulatedDevice device(device_profile("desktop"), firm, {0.0, 0.0, 0.01});
  device.set_intention({{0.0, 0.0, -0.005}, Eigen::Vector3d::Zero()});  // the hand aims 5 mm inside

  double deepest = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {  // one second of virtual time at 1 kHz
    device.write(wall(device.read()));
    device.advance(1e-3);
    deepest = std::max(deepest, -device.true_position().z());
  }
  const double rest = -device.true_position().z();
  std::printf("deepest %.2f mm, at rest %.2f mm\n", 1e3 * deepest, 1e3 * rest);
  const double expected = 0.005 * 500.0 / (500.0 + 800.0);  // hand and wall as two springs
  return std::abs(rest - expected) < 2e-4 ? 0 : 1;          // dry friction may stop it slightly short of it
}
