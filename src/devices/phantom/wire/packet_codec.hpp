// Frames to numbers and back, for the host and for the emulated device alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <calligraphy/devices/phantom/wire_profile.hpp>

namespace calligraphy::phantom {

/// What a report says, in counts of the device.
struct RawSample {
  PerJoint<std::int64_t> encoders{};  ///< as wide as their fields: they wrap
  PerJoint<std::int64_t> gimbal{};    ///< 0 where the profile has none
  std::uint32_t buttons = 0;          ///< one bit per button
  bool docked = false;
  std::uint32_t sequence = 0;  ///< 0 when the profile has none
  /// corrupted_frame, short_frame, overlong_frame or empty_frame: nothing else of this sample counts; or what the
  /// device says of itself, the sample being good.
  DeviceFault fault = DeviceFault::none;
};

/// What a command says.
struct RawCommand {
  PerJoint<std::int64_t> torque{};  ///< counts above and below the DAC's zero
  bool motors_on = false;
  bool toggle = false;
  bool dock_light = false;
  DeviceFault fault = DeviceFault::none;  ///< of a frame that was decoded: no command at all
};

/// Whether the frame was one: the fault is then none or the device's own.
bool is_readable(DeviceFault fault) noexcept;

/// Both directions of a profile. Never allocates after construction, and takes any bytes.
class PacketCodec {
 public:
  /// @throws ValueError when the profile is not valid
  explicit PacketCodec(WireProfile profile);

  const WireProfile& profile() const noexcept { return profile_; }

  RawSample decode_report(std::span<const std::byte> frame) const noexcept;
  /// Torque beyond the range of a DAC is cut to it. The number of bytes; 0 when `frame` is too small for them.
  std::size_t encode_command(const RawCommand& command, std::span<std::byte> frame) const noexcept;

  /// The device's side, for emulators.
  RawCommand decode_command(std::span<const std::byte> frame) const noexcept;
  std::size_t encode_report(const RawSample& sample, std::span<std::byte> frame) const noexcept;

  /// Torque that every DAC can give both ways, per joint [counts]; 0 without a DAC.
  PerJoint<std::int64_t> torque_range() const noexcept;

 private:
  WireProfile profile_;
};

}  // namespace calligraphy::phantom
