// How the bytes of a device are laid out, and what its counts mean: a description that a lab can write down.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy::phantom {

/// Where a number stands in a frame: some neighbouring bits of an integer of one to four bytes.
struct Field {
  int offset = 0;  ///< of the integer's first byte
  int bytes = 1;   ///< of the integer, 1 to 4
  int low_bit = 0;
  int bits = 8;
  bool big_endian = false;
  bool is_signed = false;  ///< two's complement of its bits
  bool inverted = false;   ///< every bit the other way round: a copy for checking, or a flag that is active low
};

/// A field of which only one value is right.
struct Constant {
  Field field;
  std::int64_t value = 0;
};

/// A bit by which the device tells a fault of its own.
struct FaultBit {
  DeviceFault fault = DeviceFault::runtime_error;
  Field field;
};

enum class ChecksumKind : std::uint8_t {
  sum,          ///< of the bytes, as many bits of it as the field has
  exclusive_or  ///< of the bytes
};

struct Checksum {
  ChecksumKind kind = ChecksumKind::sum;
  int first = 0;  ///< byte
  int last = 0;   ///< byte, counted in
  Field field;
};

/// A motor's digital-to-analogue converter.
struct DacField {
  Field field;
  std::int64_t zero = 0;  ///< the value that means no torque
};

enum class Framing : std::uint8_t {
  packet,  ///< one transfer is one frame
  serial   ///< a stream of frames A5 5A command length payload
};

/// One value for each joint: waist, shoulder, elbow.
template <class Value>
using PerJoint = std::array<Value, 3>;

/// A layout in both directions. docs/wire-profile.md describes the text format line by line.
struct WireProfile {
  std::string name;
  std::string source;
  std::string licence;

  double rate = 1000.0;  ///< reports a second [Hz]
  Framing framing = Framing::packet;
  std::uint8_t report_code = 0;   ///< of a report's frame, when the framing is serial
  std::uint8_t command_code = 0;  ///< of a command's frame, when the framing is serial

  std::size_t report_size = 0;  ///< device to host, without framing [bytes]
  PerJoint<Field> encoders;     ///< relative; they wrap at their width
  PerJoint<std::optional<Field>> encoder_copies;
  PerJoint<std::optional<Field>> gimbal;
  PerJoint<std::optional<Field>> gimbal_copies;
  std::vector<Field> buttons;
  std::optional<Field> docked;    ///< the pen is in the inkwell
  std::optional<Field> sequence;  ///< grows by one a report and wraps at its width
  std::vector<FaultBit> faults;
  std::vector<Constant> expected;
  std::optional<Checksum> report_checksum;

  std::size_t command_size = 0;  ///< host to device, without framing [bytes]
  PerJoint<std::optional<DacField>> dac;
  std::vector<Constant> constants;
  std::optional<Field> motors_on;  ///< torque only while it is set
  std::optional<Field> toggle;     ///< dead man: changes with every command, or the amplifier falls off
  std::optional<Field> dock_light;
  std::optional<Checksum> command_checksum;

  std::vector<std::vector<std::byte>> start;  ///< sent one after the other when the link is up
  std::vector<std::vector<std::byte>> stop;   ///< sent before it is let go

  std::optional<Eigen::Vector3d> counts_per_radian;  ///< negative where an encoder counts the other way
  std::optional<Eigen::Vector3d> docked_angles;      ///< of the joints in the inkwell [rad]
  std::optional<Eigen::Vector3d> torque_per_count;   ///< of the DAC; negative where it pulls the other way [N m]
  std::optional<Eigen::Vector3d> continuous_torque;  ///< that each motor bears for ever, at the joint [N m]
  std::optional<Eigen::Vector2d> gravity;            ///< torque that holds the upper arm level, and the forearm [N m]
};

/// The shipped profiles: `omni` (the published layout; its scales are not public) and `simulated`.
std::vector<std::string> wire_profile_names();

/// @throws ValueError naming the name and those that exist
const WireProfile& wire_profile(std::string_view name);
/// The file of a shipped profile, to begin one's own with. @throws ValueError as above
std::string_view wire_profile_text(std::string_view name);

/// Reads and validates the text format of docs/wire-profile.md. `name` is used in messages.
/// @throws FormatError naming the line and the value
WireProfile read_wire_profile(std::istream& in, std::string_view name);
/// @throws FileError when the file cannot be opened, FormatError as above
WireProfile read_wire_profile(const std::string& path);

/// @throws ValueError naming the field and the value: outside its frame, on another field, not a number
void validate(const WireProfile& profile);

/// The lines that are missing before positions, or forces, can be had from this profile; empty: none.
std::vector<std::string> missing_for_position(const WireProfile& profile);
std::vector<std::string> missing_for_force(const WireProfile& profile);

}  // namespace calligraphy::phantom
