// A PhantomDevice on an emulated arm that a simulated hand holds, stepped in virtual time.
#pragma once

#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>

#include "../../temporary_directory.hpp"
#include "emulated_arm.hpp"

namespace calligraphy_test {

inline PhantomOptions simulated_options(const std::string& model = "touch") {
  PhantomOptions options;
  options.wire_profile = "simulated";
  options.model = model;
  return options;
}

/// Path of a file that is deleted at exit.
inline std::string changed_profile(const std::string& line, const std::string& by) {
  static const TemporaryDirectory directory;
  static int files = 0;
  std::ifstream shipped(std::string(CALLIGRAPHY_SOURCE_DIR) + "/data/profiles/simulated.txt");
  std::string text((std::istreambuf_iterator<char>(shipped)), std::istreambuf_iterator<char>());
  text.replace(text.find(line), line.size(), by);
  const std::string name = std::to_string(++files) + ".txt";
  directory.write(name, text);
  return (directory.path() / name).string();
}

inline const PhantomOptions& with_profile(PhantomOptions& options, const std::string& path) {
  options.wire_profile = path;
  return options;
}

struct HeldPhantom {
  explicit HeldPhantom(const PhantomOptions& options = simulated_options(),
                       const std::optional<WireProfile>& profile = wire_profile("simulated"),
                       const GripImpedance& grip = {0.1, 3.0, 300.0})
      : arm(profile ? *profile : read_wire_profile(options.wire_profile), options.model, device_profile(options.model),
            grip),
        device(std::make_unique<MemoryLink>(arm.wire), options, [this] { return now; }) {}

  /// The simulated profile with one line changed.
  HeldPhantom(const std::string& line, const std::string& by, PhantomOptions options = simulated_options())
      : HeldPhantom(with_profile(options, changed_profile(line, by)), std::nullopt) {}

  double now = 100.0;  ///< [s]; a clock starts at an arbitrary time
  EmulatedArm arm;
  PhantomDevice device;

  /// One millisecond of the device, its report, and the delay until the host reads it.
  void tick() {
    now += 1e-3;
    arm.step();
  }

  /// One iteration of a plain loop without a guard other than the device's own.
  template <class Law>
  DeviceState turn(Law&& law) {
    tick();
    const DeviceState state = device.read();
    device.write(law(state));
    return state;
  }

  DeviceState turn() {
    return turn([](const DeviceState&) { return Eigen::Vector3d(Eigen::Vector3d::Zero()); });
  }

  /// The hand moves the tip there in a straight line, without force.
  void carry(const Eigen::Vector3d& to, double seconds = 1.0) {
    const Eigen::Vector3d from = arm.tip.true_position();
    arm.tip.set_intention({from, (to - from) / seconds});
    const int ticks = static_cast<int>(seconds * 1000.0);
    for (int i = 0; i < ticks; ++i) turn();
    arm.move_hand(to);
    for (int i = 0; i < 300; ++i) turn();
  }

  /// 50 ms in the inkwell, then to a position near the centre of the workspace.
  void bring_up(const Eigen::Vector3d& to = {0.01, 0.02, 0.01}) {
    for (int i = 0; i < 50; ++i) turn();
    arm.docked = false;
    carry(to);
  }
};

}  // namespace calligraphy_test
