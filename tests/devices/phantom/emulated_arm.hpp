// The far end of a link for tests in virtual time: the arm of a Phantom with the simulated device's physics at its tip,
// behind the bytes of a wire profile, and a link in memory between it and the host.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/LU>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/phantom/kinematics.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "devices/phantom/link/link.hpp"
#include "devices/phantom/wire/packet_codec.hpp"
#include "devices/phantom/wire/serial_framing.hpp"

namespace calligraphy_test {

using namespace calligraphy;
using namespace calligraphy::phantom;

using Bytes = std::vector<std::byte>;

/// State shared by the two ends of an in-memory link; owned by the test.
struct Wire {
  LinkListener* listener = nullptr;
  Bytes newest;                 ///< last packet sent, as seen by the device
  std::vector<Bytes> commands;  ///< in order
  std::atomic<std::uint64_t> sent = 0;
  bool takes_packets = true;
  bool fails_commands = false;
  std::string refusal;  ///< if not empty, open() throws it
  std::vector<std::string> warnings;
  std::function<void(LinkListener&)> at_the_end;  ///< events that a link reports until its thread has ended
};

class MemoryLink final : public Link {
 public:
  explicit MemoryLink(std::shared_ptr<Wire> wire) : wire_(std::move(wire)) { wire_->newest.reserve(512); }
  ~MemoryLink() override {
    if (wire_->at_the_end) wire_->at_the_end(*wire_->listener);
    wire_->listener = nullptr;
  }

  void open(LinkListener& listener) override {
    if (!wire_->refusal.empty()) throw DeviceError(wire_->refusal);
    wire_->listener = &listener;
    listener.changed(DeviceFault::none);
  }
  bool send(std::span<const std::byte> packet) noexcept override {
    if (!wire_->takes_packets) return false;
    wire_->newest.assign(packet.begin(), packet.end());  // within the reserved capacity
    ++wire_->sent;
    return true;
  }
  void command(std::span<const std::byte> packet) override {
    if (wire_->fails_commands) throw DeviceError("command refused");
    wire_->commands.emplace_back(packet.begin(), packet.end());
  }
  void cut_force() noexcept override {
    const std::span<const std::byte> packet = wire_->listener->stop_packet();
    if (!packet.empty()) send(packet);
  }
  LinkCounts counts() const noexcept override { return {0, wire_->sent, 0, 0, 1}; }
  const std::vector<std::string>& warnings() const noexcept override { return wire_->warnings; }
  const std::string& description() const noexcept override { return description_; }
  const std::string& serial() const noexcept override { return description_; }

 private:
  std::shared_ptr<Wire> wire_;
  std::string description_ = "a link in memory";
};

/// An emulated arm on a link; each step() sends one report.
class EmulatedArm {
 public:
  EmulatedArm(const WireProfile& profile, const std::string& model, const Capabilities& physics,
              const GripImpedance& grip)
      : codec(profile),
        arm(linkage(model)),
        wire(std::make_shared<Wire>()),
        tip(physics, grip, tip_position(arm, *profile.docked_angles) - arm.centre),
        model_(model) {}

  PacketCodec codec;
  const Linkage& arm;
  std::shared_ptr<Wire> wire;
  SimulatedDevice tip;
  bool docked = true;
  bool started = true;  ///< false: the motors stay off, whatever is commanded
  std::uint32_t buttons = 0;
  DeviceFault own_fault = DeviceFault::none;
  std::uint32_t sequence = 0;
  PerJoint<std::int64_t> count_offset{};  ///< encoder counts in the inkwell
  /// May change a frame before it is sent; if it returns false, the frame is not sent.
  std::function<bool(Bytes&)> tamper;

  /// Moves the hand to a position during the next steps.
  void move_hand(const Eigen::Vector3d& position) { tip.set_intention({position, Eigen::Vector3d::Zero()}); }

  Joints joints() const { return inverse_kinematics(arm, tip.true_position() + arm.centre).joints; }

  /// Present torque of the motors: zero if they are off, or if the dead-man bit has not changed for 20 ms.
  Eigen::Vector3d motor_force() {
    return started && still_for_ <= 20 ? commanded_force() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

  /// What the motors would do without these two precautions: zero if they are off.
  Eigen::Vector3d commanded_force() {
    const RawCommand command = last_command();
    if (!command.motors_on) return Eigen::Vector3d::Zero();
    Eigen::Vector3d torque;
    for (std::size_t i = 0; i < 3; ++i) {
      torque[static_cast<Eigen::Index>(i)] = static_cast<double>(command.torque[i]);
    }
    torque = torque.cwiseProduct(*codec.profile().torque_per_count);
    return tip_jacobian(arm, joints()).transpose().inverse() * torque;
  }

  RawCommand last_command() const {
    if (wire->newest.empty()) return {};
    if (codec.profile().framing == Framing::serial) return codec.decode_command(std::span(wire->newest).subspan(4));
    return codec.decode_command(wire->newest);
  }

  /// One millisecond of the physics, without a report.
  void advance() {
    const RawCommand command = last_command();
    still_for_ = command.toggle == last_toggle_ ? still_for_ + 1 : 0;
    last_toggle_ = command.toggle;
    tip.write(motor_force());
    tip.advance(1e-3);
    ++sequence;
  }

  /// The report of this moment.
  Bytes report() const {
    RawSample sample;
    const Joints turned = joints() - *codec.profile().docked_angles;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      sample.encoders[i] = std::llround(turned[joint] * (*codec.profile().counts_per_radian)[joint]) + count_offset[i];
      sample.encoders[i] &= 0xFFFF;
    }
    sample.docked = docked;
    sample.buttons = buttons;
    sample.sequence = sequence;
    sample.fault = own_fault;
    Bytes payload(codec.profile().report_size);
    codec.encode_report(sample, payload);
    if (codec.profile().framing == Framing::packet) return payload;
    Bytes frame(payload.size() + 4);
    write_serial_frame(codec.profile().report_code, payload, frame);
    return frame;
  }

  void step() {
    advance();
    Bytes frame = report();
    if (tamper && !tamper(frame)) return;
    if (wire->listener != nullptr) wire->listener->received(frame);
  }

 private:
  std::string model_;
  bool last_toggle_ = false;
  int still_for_ = 0;
};

}  // namespace calligraphy_test
