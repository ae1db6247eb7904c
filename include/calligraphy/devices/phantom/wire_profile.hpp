// Wire profile: the layout of a device's packets and its scale factors, read from a text file.
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

/// Location of a number in a frame: contiguous bits of an integer of one to four bytes.
struct Field {
  int offset = 0;           ///< offset of the first byte of the integer, from 0
  int bytes = 1;            ///< length of the integer, 1 to 4
  int low_bit = 0;          ///< lowest bit within the integer; 0: the least significant one
  int bits = 8;             ///< number of bits
  bool big_endian = false;  ///< the first byte of the integer is the most significant one
  bool is_signed = false;   ///< two's complement over `bits`
  bool inverted = false;    ///< all bits inverted: a complement for checking, or an active-low flag
};

/// A field with a fixed value.
struct Constant {
  Field field;             ///< where it is
  std::int64_t value = 0;  ///< what it holds
};

/// A bit by which the device reports a fault.
struct FaultBit {
  DeviceFault fault = DeviceFault::runtime_error;  ///< fault that it stands for
  Field field;                                     ///< nonzero while the fault lasts
};

/// How a checksum is computed.
enum class ChecksumKind : std::uint8_t {
  sum,          ///< sum of the bytes, truncated to the width of the field
  exclusive_or  ///< exclusive or of the bytes
};

/// A checksum over part of a frame.
struct Checksum {
  ChecksumKind kind = ChecksumKind::sum;  ///< how it is computed
  int first = 0;                          ///< first byte that it covers
  int last = 0;                           ///< last byte that it covers, inclusive
  Field field;                            ///< where it is
};

/// A motor's digital-to-analogue converter.
struct DacField {
  Field field;            ///< location of its value in a command
  std::int64_t zero = 0;  ///< the value for zero torque
};

/// How frames are delimited.
enum class Framing : std::uint8_t {
  packet,  ///< one transfer is one frame
  serial   ///< a stream of frames: A5 5A code length payload
};

/// One value per joint: waist, shoulder, elbow.
template <class Value>
using PerJoint = std::array<Value, 3>;

/// Packet layout in both directions, and scale factors. docs/wire-profile.md describes the text format.
struct WireProfile {
  std::string name;     ///< of the device or the layout, for messages
  std::string source;   ///< where the layout comes from
  std::string licence;  ///< licence of that source

  double rate = 1000.0;               ///< report rate [Hz]
  Framing framing = Framing::packet;  ///< framing of both directions
  std::uint8_t report_code = 0;       ///< code of report frames, with serial framing
  std::uint8_t command_code = 0;      ///< code of command frames, with serial framing

  std::size_t report_size = 0;                    ///< device to host, without framing [bytes]
  PerJoint<Field> encoders;                       ///< incremental; they wrap at their width
  PerJoint<std::optional<Field>> encoder_copies;  ///< redundant; if one disagrees, the report is corrupted
  PerJoint<std::optional<Field>> gimbal;          ///< potentiometers of the pen, read only for checking
  PerJoint<std::optional<Field>> gimbal_copies;   ///< redundant, likewise
  std::vector<Field> buttons;                     ///< nonzero while pressed; the first is bit 0 of DeviceState::buttons
  std::optional<Field> docked;                    ///< the pen is in the inkwell
  std::optional<Field> sequence;                  ///< incremented with each report; wraps at its width
  std::vector<FaultBit> faults;                   ///< faults that a report can contain
  std::vector<Constant> expected;                 ///< if one differs, the report is corrupted
  std::optional<Checksum> report_checksum;        ///< if it differs, the report is corrupted

  std::size_t command_size = 0;           ///< host to device, without framing [bytes]
  PerJoint<std::optional<DacField>> dac;  ///< motor torques
  std::vector<Constant> constants;        ///< written first into every command; the other fields overwrite it
  std::optional<Field> motors_on;         ///< motor enable bit
  std::optional<Field> toggle;      ///< dead-man bit: changes with each command; otherwise the amplifiers switch off
  std::optional<Field> dock_light;  ///< light of the inkwell, kept off
  std::optional<Checksum> command_checksum;  ///< computed for every command

  std::vector<std::vector<std::byte>> start;  ///< sent in order whenever the link comes up
  std::vector<std::vector<std::byte>> stop;   ///< sent in order before the device is released

  std::optional<Eigen::Vector3d> counts_per_radian;  ///< encoder scale; negative if it counts against its joint
  std::optional<Eigen::Vector3d> docked_angles;      ///< joint angles in the inkwell [rad]
  std::optional<Eigen::Vector3d> torque_per_count;   ///< DAC scale; negative if the motor acts against its joint [N m]
  std::optional<Eigen::Vector3d> continuous_torque;  ///< torque that a motor sustains indefinitely, at the joint [N m]
  std::optional<Eigen::Vector2d> gravity;            ///< torques that hold the upper arm and the forearm level [N m]
};

/// Names of the built-in profiles: `omni` (the published layout; its scale factors are not public) and `simulated`.
std::vector<std::string> wire_profile_names();

/// A built-in profile. @throws ValueError naming the unknown profile and the available ones
const WireProfile& wire_profile(std::string_view name);
/// The text of a built-in profile, as a starting point for your own. @throws ValueError as above
std::string_view wire_profile_text(std::string_view name);

/// Reads and validates a profile in the text format of docs/wire-profile.md. `name` is used in error messages.
/// @throws FormatError naming the line and the value
WireProfile read_wire_profile(std::istream& in, std::string_view name);
/// Reads a file in this format. @throws FileError when it cannot be opened, FormatError as above
WireProfile read_wire_profile(const std::string& path);

/// Checks a profile for contradictions that no packet could satisfy. @throws ValueError naming the field and the value,
/// for example one outside its frame, overlapping another, or not a number
void validate(const WireProfile& profile);

/// Statements missing from the profile for computing positions; empty if none.
std::vector<std::string> missing_for_position(const WireProfile& profile);
/// Statements missing from the profile for computing forces; empty if none.
std::vector<std::string> missing_for_force(const WireProfile& profile);

}  // namespace calligraphy::phantom
