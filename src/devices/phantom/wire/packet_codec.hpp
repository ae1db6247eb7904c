// Decodes and encodes frames, for the host and for emulated devices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <calligraphy/devices/phantom/wire_profile.hpp>

namespace calligraphy::phantom {

/// Contents of a report, in counts.
struct RawSample {
  PerJoint<std::int64_t> encoders{};  ///< wrap at the width of their fields
  PerJoint<std::int64_t> gimbal{};    ///< 0 if the profile has none
  std::uint32_t buttons = 0;          ///< one bit per button
  bool docked = false;
  std::uint32_t sequence = 0;  ///< 0 if the profile has none
  /// corrupted_frame, short_frame, overlong_frame or empty_frame: the sample is invalid. Any other fault was reported
  /// by the device in a valid sample.
  DeviceFault fault = DeviceFault::none;
};

/// Contents of a command.
struct RawCommand {
  PerJoint<std::int64_t> torque{};  ///< counts above and below the DAC's zero
  bool motors_on = false;
  bool toggle = false;
  bool dock_light = false;
  DeviceFault fault = DeviceFault::none;  ///< set when decoding an invalid frame
};

/// Whether the frame was valid: no fault, or only one reported by the device.
bool is_readable(DeviceFault fault) noexcept;

/// Codec for both directions of a profile. Accepts arbitrary bytes and does not allocate after construction.
class PacketCodec {
 public:
  /// @throws ValueError when the profile is invalid
  explicit PacketCodec(WireProfile profile);

  const WireProfile& profile() const noexcept { return profile_; }

  RawSample decode_report(std::span<const std::byte> frame) const noexcept;
  /// Clamps each torque to the range of its DAC. Returns the number of bytes; 0 if `frame` is too small.
  std::size_t encode_command(const RawCommand& command, std::span<std::byte> frame) const noexcept;

  /// The device side, for emulators.
  RawCommand decode_command(std::span<const std::byte> frame) const noexcept;
  std::size_t encode_report(const RawSample& sample, std::span<std::byte> frame) const noexcept;

  /// Torque that each DAC can output in both directions [counts]; 0 without a DAC.
  PerJoint<std::int64_t> torque_range() const noexcept;

 private:
  WireProfile profile_;
};

}  // namespace calligraphy::phantom
