// A Phantom on an emulated bus: the arm with the simulated device's physics at its tip, and its firmware.
#pragma once

#include <algorithm>
#include <mutex>

#include <calligraphy/devices/device_profiles.hpp>

#include "../emulated_arm.hpp"
#include "emulated_device.hpp"

namespace calligraphy_test {

/// Uses the wire profile `simulated`. The motors are off until the profile's start command has arrived, while the
/// enable bit of the newest command is clear, when the dead-man bit has not changed for 20 ms, and as soon as the
/// device is unplugged.
class EmulatedPhantom {
 public:
  EmulatedPhantom(TestBed& bed, const UsbIdentity& identity, const GripImpedance& grip,
                  const std::string& model = "touch")
      : bus(bed, identity), arm(wire_profile("simulated"), model, device_profile(model), grip) {
    arm.started = false;
    bus.on_packet([this](std::span<const std::byte> packet) {
      const std::lock_guard<std::mutex> alone(mutex);
      if (std::ranges::equal(packet, arm.codec.profile().start.front())) {
        arm.started = true;
        ++starts;
      }
      if (packet.size() == arm.codec.profile().command_size) arm.wire->newest.assign(packet.begin(), packet.end());
    });
  }

  EmulatedDevice bus;
  std::mutex mutex;  ///< of the arm: packets come in the test bed's thread
  EmulatedArm arm;

  /// One millisecond of physics, then a report, which `tamper` of the arm may change or drop.
  void step() {
    Bytes report;
    {
      const std::lock_guard<std::mutex> alone(mutex);
      arm.advance();
      report = arm.report();
      if (!arm.started && silent_until_started) return;
    }
    if (arm.tamper && !arm.tamper(report)) return;
    Octets octets(report.size());
    std::transform(report.begin(), report.end(), octets.begin(),
                   [](std::byte byte) { return std::to_integer<std::uint8_t>(byte); });
    bus.push(octets);
    ++pushed;
  }

  void unplug(UnplugOrder order) {
    bus.unplug(order);
    reset_itself();
  }

  /// Resets the device as its own watchdog or a power dip does: it stays on the bus, and its encoders keep counting.
  void reset_itself() {
    const std::lock_guard<std::mutex> alone(mutex);
    arm.wire->newest.clear();
    arm.started = false;
  }

  int times_started() {
    const std::lock_guard<std::mutex> alone(mutex);
    return starts;
  }

  Eigen::Vector3d motor_force() {
    const std::lock_guard<std::mutex> alone(mutex);
    return arm.motor_force();
  }

  Eigen::Vector3d commanded_force() {
    const std::lock_guard<std::mutex> alone(mutex);
    return arm.commanded_force();
  }

  std::uint64_t pushed = 0;
  bool silent_until_started = false;

 private:
  int starts = 0;
};

}  // namespace calligraphy_test
