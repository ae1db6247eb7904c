#include "packet_codec.hpp"

#include <algorithm>
#include <utility>

#include "frame_field.hpp"

namespace calligraphy::phantom {
namespace {

DeviceFault size_fault(std::size_t size, std::size_t expected) noexcept {
  if (size == 0) return DeviceFault::empty_frame;
  if (size < expected) return DeviceFault::short_frame;
  return size > expected ? DeviceFault::overlong_frame : DeviceFault::none;
}

std::int64_t sum_of(const Checksum& checksum, std::span<const std::byte> frame) noexcept {
  std::uint32_t sum = 0;
  for (int i = checksum.first; i <= checksum.last; ++i) {
    const auto byte = std::to_integer<std::uint32_t>(frame[static_cast<std::size_t>(i)]);
    sum = checksum.kind == ChecksumKind::sum ? sum + byte : sum ^ byte;
  }
  return sum & field_mask(checksum.field);
}

/// Compares signed fields by their bits, too.
bool is_right(const Checksum& checksum, std::span<const std::byte> frame) noexcept {
  const auto found = static_cast<std::uint32_t>(static_cast<std::uint64_t>(read_field(checksum.field, frame)));
  return (found & field_mask(checksum.field)) == static_cast<std::uint32_t>(sum_of(checksum, frame));
}

bool differs(const std::optional<Field>& copy, std::int64_t value, std::span<const std::byte> frame) noexcept {
  return copy && read_field(*copy, frame) != value;
}

void write_if(const std::optional<Field>& field, std::int64_t value, std::span<std::byte> frame) noexcept {
  if (field) write_field(*field, value, frame);
}

}  // namespace

bool is_readable(DeviceFault fault) noexcept {
  return fault != DeviceFault::empty_frame && fault != DeviceFault::short_frame &&
         fault != DeviceFault::overlong_frame && fault != DeviceFault::corrupted_frame;
}

PacketCodec::PacketCodec(WireProfile profile) : profile_(std::move(profile)) { validate(profile_); }

RawSample PacketCodec::decode_report(std::span<const std::byte> frame) const noexcept {
  RawSample sample;
  sample.fault = size_fault(frame.size(), profile_.report_size);
  if (sample.fault != DeviceFault::none) return sample;
  bool corrupted = profile_.report_checksum && !is_right(*profile_.report_checksum, frame);
  for (const Constant& constant : profile_.expected) {
    corrupted = corrupted || read_field(constant.field, frame) != constant.value;
  }
  for (std::size_t joint = 0; joint < 3; ++joint) {
    sample.encoders[joint] = read_field(profile_.encoders[joint], frame);
    corrupted = corrupted || differs(profile_.encoder_copies[joint], sample.encoders[joint], frame);
    if (!profile_.gimbal[joint]) continue;
    sample.gimbal[joint] = read_field(*profile_.gimbal[joint], frame);
    corrupted = corrupted || differs(profile_.gimbal_copies[joint], sample.gimbal[joint], frame);
  }
  if (corrupted) {
    sample = {};
    sample.fault = DeviceFault::corrupted_frame;
    return sample;
  }
  for (std::size_t i = 0; i < profile_.buttons.size(); ++i) {
    if (read_field(profile_.buttons[i], frame) != 0) sample.buttons |= std::uint32_t{1} << i;
  }
  sample.docked = profile_.docked && read_field(*profile_.docked, frame) != 0;
  if (profile_.sequence) sample.sequence = static_cast<std::uint32_t>(read_field(*profile_.sequence, frame));
  for (const FaultBit& bit : profile_.faults) {
    if (sample.fault == DeviceFault::none && read_field(bit.field, frame) != 0) sample.fault = bit.fault;
  }
  return sample;
}

std::size_t PacketCodec::encode_command(const RawCommand& command, std::span<std::byte> frame) const noexcept {
  if (frame.size() < profile_.command_size) return 0;
  frame = frame.first(profile_.command_size);
  std::ranges::fill(frame, std::byte{0});
  for (const Constant& constant : profile_.constants) write_field(constant.field, constant.value, frame);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    if (!profile_.dac[joint]) continue;
    const DacField& dac = *profile_.dac[joint];
    const std::int64_t most = phantom::torque_range(dac);
    write_field(dac.field, dac.zero + std::clamp(command.torque[joint], -most, most), frame);
  }
  write_if(profile_.motors_on, command.motors_on, frame);
  write_if(profile_.toggle, command.toggle, frame);
  write_if(profile_.dock_light, command.dock_light, frame);
  if (profile_.command_checksum) {
    write_field(profile_.command_checksum->field, sum_of(*profile_.command_checksum, frame), frame);
  }
  return frame.size();
}

RawCommand PacketCodec::decode_command(std::span<const std::byte> frame) const noexcept {
  RawCommand command;
  command.fault = size_fault(frame.size(), profile_.command_size);
  if (command.fault != DeviceFault::none) return command;
  if (profile_.command_checksum && !is_right(*profile_.command_checksum, frame)) {
    command.fault = DeviceFault::corrupted_frame;
    return command;
  }
  for (std::size_t joint = 0; joint < 3; ++joint) {
    if (!profile_.dac[joint]) continue;
    command.torque[joint] = read_field(profile_.dac[joint]->field, frame) - profile_.dac[joint]->zero;
  }
  const auto flag = [&](const std::optional<Field>& field) { return field && read_field(*field, frame) != 0; };
  command.motors_on = flag(profile_.motors_on);
  command.toggle = flag(profile_.toggle);
  command.dock_light = flag(profile_.dock_light);
  return command;
}

std::size_t PacketCodec::encode_report(const RawSample& sample, std::span<std::byte> frame) const noexcept {
  if (frame.size() < profile_.report_size) return 0;
  frame = frame.first(profile_.report_size);
  std::ranges::fill(frame, std::byte{0});
  for (const Constant& constant : profile_.expected) write_field(constant.field, constant.value, frame);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    write_field(profile_.encoders[joint], sample.encoders[joint], frame);
    write_if(profile_.encoder_copies[joint], sample.encoders[joint], frame);
    write_if(profile_.gimbal[joint], sample.gimbal[joint], frame);
    write_if(profile_.gimbal_copies[joint], sample.gimbal[joint], frame);
  }
  for (std::size_t i = 0; i < profile_.buttons.size(); ++i) {
    write_field(profile_.buttons[i], sample.buttons >> i & 1, frame);
  }
  write_if(profile_.docked, sample.docked, frame);
  write_if(profile_.sequence, sample.sequence, frame);
  for (const FaultBit& bit : profile_.faults) write_field(bit.field, sample.fault == bit.fault, frame);
  if (profile_.report_checksum) {
    write_field(profile_.report_checksum->field, sum_of(*profile_.report_checksum, frame), frame);
  }
  return frame.size();
}

PerJoint<std::int64_t> PacketCodec::torque_range() const noexcept {
  PerJoint<std::int64_t> counts{};
  for (std::size_t joint = 0; joint < 3; ++joint) {
    if (profile_.dac[joint]) counts[joint] = phantom::torque_range(*profile_.dac[joint]);
  }
  return counts;
}

}  // namespace calligraphy::phantom
