#include <calligraphy/devices/phantom/wire_profile.hpp>

#include <array>
#include <cmath>
#include <utility>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "built_in.hpp"
#include "frame_field.hpp"

namespace calligraphy::phantom {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw ValueError(what); }

std::string numbered(const char* name, std::size_t index) {
  return std::string(name) + " " + std::to_string(index + 1);
}

/// Checks that the fields of a frame lie inside it and do not overlap.
class FrameCheck {
 public:
  FrameCheck(const char* frame, std::size_t size) : frame_(frame), size_(size), taken_(8 * size) {
    const std::string name = std::string(frame) + " size";
    require_within(name, static_cast<double>(size), "bytes", 1, max_frame_bytes);
  }

  void inside(const Field& field, const std::string& name) const {
    require_within(name + ": width", field.bytes, "bytes", 1, 4);
    require(field.bits >= 1, name + ": number of bits", field.bits, "", "at least 1");
    require(field.low_bit >= 0, name + ": lowest bit", field.low_bit, "", "at least 0");
    require(field.low_bit <= 8 * field.bytes - field.bits, name + ": highest bit", field.low_bit + (field.bits - 1.0),
            "", "below " + std::to_string(8 * field.bytes));
    const bool is_inside =
        field.offset >= 0 && static_cast<std::size_t>(field.offset) + static_cast<std::size_t>(field.bytes) <= size_;
    require(is_inside, name + ": offset", field.offset, "",
            "such that the field fits into the " + std::to_string(size_) + " bytes of the " + frame_);
  }

  void alone(const Field& field, const std::string& name) {
    inside(field, name);
    for (int bit = field.low_bit; bit < field.low_bit + field.bits; ++bit) {
      std::string& owner = taken_[bit_of_frame(field, bit)];
      if (!owner.empty()) refuse(name + " overlaps " + owner + " in the " + frame_);
      owner = name;
    }
  }

  /// Checks a field that must have one bit and overlap no other field.
  void flag(const Field& field, const std::string& name) {
    alone(field, name);
    require(field.bits == 1, name + ": number of bits", field.bits, "", "1");
  }

  void checksum(const Checksum& checksum, const std::string& name) {
    alone(checksum.field, name);
    if (checksum.first < 0 || checksum.last < checksum.first || static_cast<std::size_t>(checksum.last) >= size_) {
      refuse(name + ": bytes " + std::to_string(checksum.first) + ".." + std::to_string(checksum.last) +
             " are outside the " + frame_);
    }
    const int first = checksum.field.offset, last = first + checksum.field.bytes - 1;
    if (first <= checksum.last && last >= checksum.first) refuse(name + " covers its own bytes");
    require(checksum.kind != ChecksumKind::exclusive_or || checksum.field.bits == 8, name + ": number of bits",
            checksum.field.bits, "", "8 for xor");
  }

  void constant(const Constant& constant, const std::string& name) const {
    inside(constant.field, name);
    in_range(constant.field, constant.value, name + ": value");
  }

  static void in_range(const Field& field, std::int64_t value, const std::string& name) {
    const auto [least, most] = range(field);
    require_within(name, static_cast<double>(value), "", static_cast<double>(least), static_cast<double>(most));
  }

 private:
  static std::size_t bit_of_frame(const Field& field, int bit) {
    const int byte = field.big_endian ? field.bytes - 1 - bit / 8 : bit / 8;
    return static_cast<std::size_t>(8 * (field.offset + byte) + bit % 8);
  }

  const char* frame_;
  std::size_t size_;
  std::vector<std::string> taken_;  ///< name of the field at each bit of the frame
};

void validate_report(const WireProfile& profile) {
  FrameCheck check("report", profile.report_size);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const Field& encoder = profile.encoders[joint];
    const std::string name = numbered("encoder", joint);
    check.alone(encoder, name);
    require(encoder.bits >= 8, name + ": number of bits", encoder.bits, "", "at least 8");
    const auto pair = [&](const std::optional<Field>& copy, const Field* of, const std::string& copy_name) {
      if (!copy) return;
      check.alone(*copy, copy_name);
      if (of == nullptr) refuse(copy_name + " copies a field that is not defined");
      if (copy->bits != of->bits || copy->is_signed != of->is_signed) {
        refuse(copy_name + ": number of bits or signedness differs from that of the field it copies");
      }
    };
    pair(profile.encoder_copies[joint], &encoder, numbered("encoder-copy", joint));
    const std::optional<Field>& gimbal = profile.gimbal[joint];
    if (gimbal) check.alone(*gimbal, numbered("gimbal", joint));
    pair(profile.gimbal_copies[joint], gimbal ? &*gimbal : nullptr, numbered("gimbal-copy", joint));
  }
  require(profile.buttons.size() <= 32, "buttons", static_cast<double>(profile.buttons.size()), "", "at most 32");
  for (std::size_t i = 0; i < profile.buttons.size(); ++i) check.flag(profile.buttons[i], numbered("button", i));
  if (profile.docked) check.flag(*profile.docked, "docked");
  if (profile.sequence) {
    check.alone(*profile.sequence, "sequence");
    require(profile.sequence->bits >= 4, "sequence: number of bits", profile.sequence->bits, "", "at least 4");
  }
  for (std::size_t i = 0; i < profile.faults.size(); ++i) {
    const FaultBit& bit = profile.faults[i];
    check.flag(bit.field, numbered("fault", i) + " (" + to_string(bit.fault) + ")");
  }
  for (std::size_t i = 0; i < profile.expected.size(); ++i) {
    check.alone(profile.expected[i].field, numbered("expect", i));
    check.constant(profile.expected[i], numbered("expect", i));
  }
  if (profile.report_checksum) check.checksum(*profile.report_checksum, "report-checksum");
}

void validate_command(const WireProfile& profile) {
  const bool has_dac = profile.dac[0] || profile.dac[1] || profile.dac[2];
  if (profile.command_size == 0) {  // a read-only device
    if (has_dac || profile.motors_on || profile.toggle || profile.dock_light || !profile.constants.empty() ||
        profile.command_checksum) {
      refuse("command size is 0, but command fields are defined");
    }
    return;
  }
  FrameCheck check("command", profile.command_size);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    if (!profile.dac[joint]) continue;
    const DacField& dac = *profile.dac[joint];
    const std::string name = numbered("dac", joint);
    check.alone(dac.field, name);
    FrameCheck::in_range(dac.field, dac.zero, name + ": zero");
    if (torque_range(dac) < 1) refuse(name + ": zero leaves no range for torque in both directions");
  }
  for (std::size_t i = 0; i < profile.constants.size(); ++i) {
    check.constant(profile.constants[i], numbered("constant", i));
  }
  if (profile.motors_on) check.flag(*profile.motors_on, "motors-on");
  if (profile.toggle) check.flag(*profile.toggle, "toggle");
  if (profile.dock_light) check.flag(*profile.dock_light, "dock-light");
  if (profile.command_checksum) check.checksum(*profile.command_checksum, "command-checksum");
}

/// Checks each value, if there are any; NaN fails too.
template <class Values>
void require_sizes(const std::optional<Values>& values, const char* name, const char* unit, double least, double most,
                   const char* domain) {
  if (!values) return;
  for (const double value : *values) {
    require(std::abs(value) >= least && std::abs(value) <= most, name, value, unit, domain);
  }
}

}  // namespace

void validate(const WireProfile& profile) {
  if (profile.name.empty()) refuse("a wire profile needs a name");
  require_within("rate", profile.rate, "Hz", 1.0, 100e3);
  validate_report(profile);
  validate_command(profile);
  if (profile.framing == Framing::serial && (profile.report_size > 255 || profile.command_size > 255)) {
    refuse("serial frames hold at most 255 bytes; the report has " + std::to_string(profile.report_size) +
           ", the command " + std::to_string(profile.command_size));
  }
  const std::size_t most = profile.framing == Framing::serial ? 256 : max_frame_bytes;
  for (const bool is_start : {true, false}) {
    const auto& packets = is_start ? profile.start : profile.stop;
    for (std::size_t i = 0; i < packets.size(); ++i) {
      if (!packets[i].empty() && packets[i].size() <= most) continue;
      refuse(numbered(is_start ? "start" : "stop", i) + " has " + std::to_string(packets[i].size()) +
             " bytes, must have 1 to " + std::to_string(most));
    }
  }
  require_sizes(profile.counts_per_radian, "counts-per-radian", "", 1.0, 1e9, "from 1 to 1e+09 in size");
  require_sizes(profile.docked_angles, "docked-angles", "rad", 0.0, 6.3, "at most 6.3 in size");
  require_sizes(profile.torque_per_count, "torque-per-count", "N m", 1e-12, 10.0, "from 1e-12 to 10 in size");
  if (profile.continuous_torque) {
    for (const double torque : *profile.continuous_torque)
      require_within("continuous-torque", torque, "N m", 1e-6, 100);
  }
  require_sizes(profile.gravity, "gravity", "N m", 0.0, 10.0, "at most 10 in size");
}

std::vector<std::string> missing_for_position(const WireProfile& profile) {
  std::vector<std::string> missing;
  if (!profile.counts_per_radian) missing.emplace_back("counts-per-radian");
  if (!profile.docked_angles) missing.emplace_back("docked-angles");
  return missing;
}

std::vector<std::string> missing_for_force(const WireProfile& profile) {
  std::vector<std::string> missing = missing_for_position(profile);
  if (profile.command_size == 0) missing.emplace_back("command");
  for (std::size_t joint = 0; joint < 3; ++joint) {
    if (!profile.dac[joint]) missing.push_back(numbered("dac", joint));
  }
  if (!profile.torque_per_count) missing.emplace_back("torque-per-count");
  return missing;
}

std::vector<std::string> wire_profile_names() { return {"omni", "simulated"}; }

std::string_view wire_profile_text(std::string_view name) {
  if (name == "omni") return built_in::wire_profile_omni;
  if (name == "simulated") return built_in::wire_profile_simulated;
  std::string known;
  for (const std::string& other : wire_profile_names()) known += (known.empty() ? "" : ", ") + other;
  throw ValueError("wire profile \"" + std::string(name) + "\" does not exist; available: " + known);
}

const WireProfile& wire_profile(std::string_view name) {
  const auto parsed = [](std::string_view shipped) {
    std::istringstream in{std::string(wire_profile_text(shipped))};
    return read_wire_profile(in, "data/profiles/" + std::string(shipped) + ".txt");
  };
  static const WireProfile omni = parsed("omni");
  static const WireProfile simulated = parsed("simulated");
  wire_profile_text(name);  // throws for an unknown name
  return name == "omni" ? omni : simulated;
}

}  // namespace calligraphy::phantom
