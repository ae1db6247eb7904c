// The text format of wire profiles; docs/wire-profile.md describes it.
#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/file.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

#include "base/charconv.hpp"
#include "base/line_reader.hpp"

namespace calligraphy::phantom {
namespace {

constexpr std::string_view first_line = "calligraphy wire profile 1";
constexpr std::size_t max_text = 1 << 20;  // a profile is about one page; anything longer is another file [bytes]

LineKind kind_of(std::string_view key) {
  return key == "name" || key == "source" || key == "licence" ? LineKind::text : LineKind::words;
}

/// "link-error" for DeviceFault::link_error; empty if there is no such fault.
std::optional<DeviceFault> fault_of(std::string_view word) {
  for (auto fault = DeviceFault::unplugged; fault <= DeviceFault::late_clock;
       fault = static_cast<DeviceFault>(static_cast<int>(fault) + 1)) {
    std::string name = to_string(fault);
    std::ranges::replace(name, ' ', '-');
    if (name == word) return fault;
  }
  return std::nullopt;
}

class Parser : private LineReader {
 public:
  Parser(std::istream& in, std::string_view name) : LineReader(bytes_of(in, name), name, max_text) {}

  WireProfile parse() {
    while (next_statement([this](std::string_view key) { return checked_kind_of(key); })) {
      if (!seen_first_line_) {
        if (line() != first_line) fail("expected " + in_quotes(first_line) + ", found " + in_quotes(line()));
        seen_first_line_ = true;
        continue;
      }
      statement();
    }
    if (!seen_first_line_) throw FormatError(name() + ": empty; expected " + in_quotes(first_line));
    for (const char* key : {"name", "report", "encoder 1", "encoder 2", "encoder 3"}) {
      if (!lines_.contains(key)) throw FormatError(name() + ": the line '" + key + "' is missing");
    }
    if (!button_numbers_.empty() && *button_numbers_.rbegin() != static_cast<int>(button_numbers_.size())) {
      throw FormatError(name() + ": button " + std::to_string(*button_numbers_.rbegin()) + " of " +
                        std::to_string(button_numbers_.size()) + ": buttons are numbered from 1 without a gap");
    }
    try {
      validate(profile_);
    } catch (const ValueError& error) {
      throw FormatError(name() + line_of(error.what()) + ": " + error.what());
    }
    return std::move(profile_);
  }

 private:
  /// Comments must be UTF-8, too.
  LineKind checked_kind_of(std::string_view key) const {
    if (!is_utf8(line())) fail("not a wire profile: it is not valid UTF-8");
    return kind_of(key);
  }

  void statement() {
    const std::string_view key = word();
    if (text(key) || numbers(key) || report_field(key) || command_field(key)) {
      if (const std::string_view more = word(); !more.empty())
        fail("expected the end of the line, found " + in_quotes(more));
      return;
    }
    fail("unknown keyword " + in_quotes(key));
  }

  /// ":7" if the message begins with the name of a statement on line 7; empty if it concerns no single line.
  std::string line_of(std::string_view complaint) const {
    for (const auto& [key, line] : lines_) {
      const bool is_named = complaint.starts_with(key) && complaint.size() > key.size();
      if (is_named && (complaint[key.size()] == ' ' || complaint[key.size()] == ':')) return ":" + std::to_string(line);
    }
    return {};
  }

  /// For statements that may appear only once.
  void once(std::string key) {
    if (const auto [it, is_new] = lines_.emplace(std::move(key), number()); !is_new)
      fail(in_quotes(it->first) + " is already defined");
  }

  /// For repeatable statements, numbered as in validate().
  void counted(std::string_view key, std::size_t before) {
    lines_.emplace(std::string(key) + " " + std::to_string(before + 1), number());
  }

  bool text(std::string_view key) {
    if (kind_of(key) != LineKind::text) return false;
    once(std::string(key));
    const std::string_view text = rest();
    if (text.empty()) fail(in_quotes(key) + " is empty");
    (key == "name" ? profile_.name : key == "source" ? profile_.source : profile_.licence) = text;
    return true;
  }

  bool numbers(std::string_view key) {
    if (key == "framing") {
      once("framing");
      framing();
    } else if (key == "rate") {
      once("rate");
      profile_.rate = real();
    } else if (key == "report" || key == "command") {
      once(std::string(key));
      (key == "report" ? profile_.report_size : profile_.command_size) = static_cast<std::size_t>(integer(0, 4096));
    } else if (key == "start" || key == "stop") {
      auto& packets = key == "start" ? profile_.start : profile_.stop;
      counted(key, packets.size());
      packets.push_back(hexadecimal_bytes());
    } else if (key == "counts-per-radian") {
      three(key, profile_.counts_per_radian);
    } else if (key == "docked-angles") {
      three(key, profile_.docked_angles);
    } else if (key == "torque-per-count") {
      three(key, profile_.torque_per_count);
    } else if (key == "continuous-torque") {
      three(key, profile_.continuous_torque);
    } else if (key == "gravity") {
      once("gravity");
      const double upper_arm = real();
      profile_.gravity = Eigen::Vector2d(upper_arm, real());
    } else {
      return false;
    }
    return true;
  }

  bool report_field(std::string_view key) {
    if (key == "encoder") {
      of_joint(key, profile_.encoders);
    } else if (key == "encoder-copy") {
      of_joint(key, profile_.encoder_copies);
    } else if (key == "gimbal") {
      of_joint(key, profile_.gimbal);
    } else if (key == "gimbal-copy") {
      of_joint(key, profile_.gimbal_copies);
    } else if (key == "button") {
      const int number = static_cast<int>(integer(1, 32));
      once("button " + std::to_string(number));
      button_numbers_.insert(number);
      profile_.buttons.resize(std::max(profile_.buttons.size(), static_cast<std::size_t>(number)));
      profile_.buttons[static_cast<std::size_t>(number - 1)] = field();
    } else if (key == "docked" || key == "sequence") {
      once(std::string(key));
      (key == "docked" ? profile_.docked : profile_.sequence) = field();
    } else if (key == "fault") {
      const std::string_view name = word();
      const std::optional<DeviceFault> fault = fault_of(name);
      if (!fault) fail(in_quotes(name) + " is not a fault name");
      counted(key, profile_.faults.size());
      profile_.faults.push_back({*fault, field()});
    } else if (key == "expect") {
      counted(key, profile_.expected.size());
      profile_.expected.push_back(constant());
    } else if (key == "report-checksum") {
      once("report-checksum");
      profile_.report_checksum = checksum();
    } else {
      return false;
    }
    return true;
  }

  bool command_field(std::string_view key) {
    if (key == "dac") {
      const std::size_t number = joint(key);
      DacField dac{field(), 0};
      if (const std::string_view zero = word(); zero != "zero") fail("expected 'zero', found " + in_quotes(zero));
      dac.zero = integer();
      profile_.dac[number] = dac;
    } else if (key == "constant") {
      counted(key, profile_.constants.size());
      profile_.constants.push_back(constant());
    } else if (key == "motors-on" || key == "toggle" || key == "dock-light") {
      once(std::string(key));
      (key == "motors-on" ? profile_.motors_on : key == "toggle" ? profile_.toggle : profile_.dock_light) = field();
    } else if (key == "command-checksum") {
      once("command-checksum");
      profile_.command_checksum = checksum();
    } else {
      return false;
    }
    return true;
  }

  void framing() {
    const std::string_view kind = word();
    if (kind == "packet") return;
    if (kind != "serial") fail("framing is " + in_quotes(kind) + ", must be 'packet' or 'serial REPORT COMMAND'");
    profile_.framing = Framing::serial;
    profile_.report_code = static_cast<std::uint8_t>(integer(0, 255));
    profile_.command_code = static_cast<std::uint8_t>(integer(0, 255));
  }

  std::size_t joint(std::string_view key) {
    const auto number = integer(1, 3);
    once(std::string(key) + " " + std::to_string(number));
    return static_cast<std::size_t>(number - 1);
  }

  template <class Value>
  void of_joint(std::string_view key, PerJoint<Value>& fields) {
    const std::size_t number = joint(key);
    fields[number] = field();
  }

  /// u16 at 4 bits 0..11 big inverted
  Field field() {
    Field field;
    const std::string_view type = word();
    const bool known = type.size() >= 2 && (type[0] == 'u' || type[0] == 's');
    const std::string_view width = known ? type.substr(1) : std::string_view();
    if (width != "8" && width != "16" && width != "24" && width != "32") {
      fail(in_quotes(type) + " is not a field type (u8, u16, u24, u32, s8, s16, s24, s32)");
    }
    field.is_signed = type[0] == 's';
    field.bits = width == "8" ? 8 : width == "16" ? 16 : width == "24" ? 24 : 32;
    field.bytes = field.bits / 8;
    if (const std::string_view at = word(); at != "at") fail("expected 'at', found " + in_quotes(at));
    field.offset = static_cast<int>(integer(0, 4095));
    for (std::string_view rest = left(); !rest.empty(); rest = left()) {
      const std::string_view option = word();
      if (option == "bits") {
        const auto [low, high] = span(8 * field.bytes - 1, "bits");
        field.low_bit = low;
        field.bits = high - low + 1;
      } else if (option == "bit") {
        field.low_bit = static_cast<int>(integer(0, 8 * field.bytes - 1));
        field.bits = 1;
      } else if (option == "big") {
        field.big_endian = true;
      } else if (option == "inverted") {
        field.inverted = true;
      } else {
        set_left(rest);  // rest of the statement, not of the field
        break;
      }
    }
    return field;
  }

  Constant constant() {
    Constant constant{field(), 0};
    if (const std::string_view is = word(); is != "is") fail("expected 'is', found " + in_quotes(is));
    constant.value = integer();
    return constant;
  }

  Checksum checksum() {
    Checksum checksum;
    const std::string_view kind = word();
    if (kind != "sum" && kind != "xor") fail(in_quotes(kind) + " is not a checksum type (sum, xor)");
    checksum.kind = kind == "sum" ? ChecksumKind::sum : ChecksumKind::exclusive_or;
    std::tie(checksum.first, checksum.last) = span(4095, "bytes");
    checksum.field = field();
    return checksum;
  }

  /// LOW..HIGH
  std::pair<int, int> span(int most, const char* what) {
    const std::string_view text = word();
    const auto dots = text.find("..");
    if (dots == std::string_view::npos) fail(in_quotes(text) + " is not a range of " + what + ", FIRST..LAST");
    const auto low = to_integer(text.substr(0, dots), 0, most);
    return {static_cast<int>(low), static_cast<int>(to_integer(text.substr(dots + 2), low, most))};
  }

  std::int64_t integer(std::int64_t least = std::numeric_limits<std::int32_t>::min(),
                       std::int64_t most = std::numeric_limits<std::uint32_t>::max()) {
    return to_integer(word(), least, most);
  }

  std::int64_t to_integer(std::string_view text, std::int64_t least, std::int64_t most) const {
    const bool hexadecimal = text.starts_with("0x");
    const std::string_view digits = hexadecimal ? text.substr(2) : text;
    std::int64_t value = 0;
    const auto [end, error] = from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 10);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (!whole || (hexadecimal && value < 0)) fail(in_quotes(text) + " is not an integer");
    if (value < least || value > most) {
      fail(std::string(text) + " is out of range, must be " + std::to_string(least) + " to " + std::to_string(most));
    }
    return value;
  }

  double real() {
    const std::string_view text = word();
    double value = 0.0;
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) fail(in_quotes(text) + " is not a number");
    return value;
  }

  void three(std::string_view key, std::optional<Eigen::Vector3d>& values) {
    once(std::string(key));
    values.emplace();
    for (double& value : *values) value = real();
  }

  std::vector<std::byte> hexadecimal_bytes() {
    std::vector<std::byte> bytes;
    for (std::string_view text = word(); !text.empty(); text = word()) {
      int value = 0;
      const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value, 16);
      if (text.size() != 2 || text[0] == '-' || error != std::errc() || end != text.data() + text.size()) {
        fail(in_quotes(text) + " is not a byte (two hexadecimal digits)");
      }
      bytes.push_back(static_cast<std::byte>(value));
    }
    if (bytes.empty()) fail("expected bytes (two hexadecimal digits each), found none");
    return bytes;
  }

  bool seen_first_line_ = false;
  std::map<std::string, int> lines_;  ///< line numbers of statements, by their names in validate()'s messages
  std::set<int> button_numbers_;
  WireProfile profile_;
};

}  // namespace

WireProfile read_wire_profile(std::istream& in, std::string_view name) { return Parser(in, name).parse(); }

WireProfile read_wire_profile(const std::string& path) {
  std::ifstream in = open_file(path);
  return read_wire_profile(in, path);
}

}  // namespace calligraphy::phantom
