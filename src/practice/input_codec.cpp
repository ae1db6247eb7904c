#include "input_codec.hpp"

#include <cmath>
#include <limits>

#include <calligraphy/base/error.hpp>

#include "base/bit_cast.hpp"
#include "base/charconv.hpp"
#include "base/line_reader.hpp"
#include "base/require.hpp"
#include "base/stylus_fields.hpp"

namespace calligraphy {
namespace {

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();
constexpr char exactly = '=', estimated = '~';  // before a coordinate, and before the part of a velocity

/// To the last bit; NaN of any kind.
bool same(double a, double b) noexcept {
  return bit_cast<std::uint64_t>(a) == bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

bool same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) noexcept {
  return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}

void append_number(std::string& text, double value) {
  char buffer[32];
  text.append(buffer, to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

/// The values of a line, one after the other; those after its end are empty.
class Values {
 public:
  explicit Values(std::string_view line) : rest_(line) {}

  std::string_view next() {
    const std::size_t comma = rest_.find(',');
    const std::string_view value = rest_.substr(0, comma);
    rest_ = comma == std::string_view::npos ? std::string_view() : rest_.substr(comma + 1);
    return value;
  }

  /// The next number; `otherwise` if it is empty.
  double number(double otherwise) {
    const std::string_view text = next();
    return text.empty() ? otherwise : parsed<double>(text);
  }

  template <typename Number>
  static Number parsed(std::string_view text) {
    Number value{};
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      throw FormatError("expected a number, found " + in_quotes(text));
    }
    return value;
  }

  void require_end() const {
    if (!rest_.empty()) throw FormatError("unexpected " + in_quotes(rest_) + " at the end of the line");
  }

 private:
  std::string_view rest_;
};

template <typename Enum>
Enum enumerator(std::string_view text, Enum last) {
  const int value = Values::parsed<int>(text);
  if (value < 0 || value > static_cast<int>(last)) throw FormatError("unknown status " + in_quotes(text));
  return static_cast<Enum>(value);
}

}  // namespace

std::uint64_t force_checksum(std::span<const RecordedSample> samples, std::uint64_t before) noexcept {
  constexpr std::uint64_t prime = 0x100000001b3;
  for (const RecordedSample& sample : samples) {
    for (const double component : sample.force) {
      const auto bits = bit_cast<std::uint64_t>(component);
      for (int shift = 0; shift < 64; shift += 8) before = (before ^ ((bits >> shift) & 0xff)) * prime;
    }
  }
  return before;
}

ExpectedInput::ExpectedInput(double rate, const Capabilities& device)
    : period_(1.0 / rate), step_(device.encoder_step), velocity_(device.velocity_cutoff) {
  state_.position.setZero();
}

double ExpectedInput::steps_between(double from, double to) const noexcept {
  const double steps = std::round(to / step_) - std::round(from / step_);
  return std::abs(steps) < 1e9 && same(moved(from, steps), to) ? steps : not_given;
}

double ExpectedInput::moved(double from, double steps) const noexcept {
  return step_ > 0.0 ? (std::round(from / step_) + steps) * step_ : not_given;
}

void ExpectedInput::take(const DeviceState& input) noexcept {
  state_ = input;
  state_.time += period_;
}

void InputEncoder::append(std::string& text, const DeviceState& input, const Eigen::Vector3d& force) {
  const DeviceState& expected = expected_.state();
  std::size_t commas = 0;  // not written yet, because nothing may follow
  const auto next = [&] { ++commas; };
  const auto begin = [&]() -> std::string& {
    text.append(std::exchange(commas, 0), ',');
    return text;
  };
  const auto number = [&](double value, double otherwise) {
    if (!same(value, otherwise)) append_number(begin(), value);
    next();
  };
  number(input.time, expected.time);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double value = input.position[axis], last = expected.position[axis];
    if (!same(value, last)) {
      const double steps = expected_.steps_between(last, value);
      append_number(std::isnan(steps) ? begin() += exactly : begin(), std::isnan(steps) ? value : steps);
    }
    next();
  }
  const bool is_as_estimated = same(expected_.velocity_at(input.position), input.velocity) && input.velocity_estimated;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (!is_as_estimated) {
      if (input.velocity_estimated) begin() += estimated;
      append_number(begin(), input.velocity[axis]);
    }
    next();
  }
  if (input.status != DeviceStatus::ok || input.fault != DeviceFault::none) {
    append_number(begin(), static_cast<int>(input.status));
    append_number(text += '/', static_cast<int>(input.fault));
  }
  next();
  number(input.buttons, expected.buttons);
  for (const double component : input.force) number(component, not_given);
  number(input.force_settling, 0.0);
  for (const StylusField& field : stylus_fields) number(input.stylus.*field.member, expected.stylus.*field.member);
  if (has_own_law_) {
    for (const double component : force) number(component, 0.0);
  }
  text += '\n';
  expected_.take(input);
}

DeviceState InputDecoder::decode(std::string_view line) {
  const DeviceState& expected = expected_.state();
  Values values(line);
  DeviceState input;
  input.time = values.number(expected.time);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::string_view text = values.next();
    const bool is_exact = text.starts_with(exactly);
    if (text.empty()) input.position[axis] = expected.position[axis];
    else if (is_exact) input.position[axis] = Values::parsed<double>(text.substr(1));
    else input.position[axis] = expected_.moved(expected.position[axis], Values::parsed<double>(text));
  }
  input.velocity = expected_.velocity_at(input.position);
  input.velocity_estimated = true;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::string_view text = values.next();
    if (text.empty()) continue;
    input.velocity_estimated = text.front() == estimated;
    input.velocity[axis] = Values::parsed<double>(text.substr(input.velocity_estimated ? 1 : 0));
  }
  if (const std::string_view text = values.next(); !text.empty()) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) throw FormatError("expected STATUS/FAULT, found " + in_quotes(text));
    input.status = enumerator(text.substr(0, slash), DeviceStatus::fault);
    input.fault = enumerator(text.substr(slash + 1), DeviceFault::device_error);
  }
  const std::string_view buttons = values.next();
  input.buttons = buttons.empty() ? expected.buttons : Values::parsed<std::uint32_t>(buttons);
  for (double& component : input.force) component = values.number(not_given);
  input.force_settling = values.number(0.0);
  for (const StylusField& field : stylus_fields) {
    input.stylus.*field.member = values.number(expected.stylus.*field.member);
  }
  if (has_own_law_) {
    for (double& component : own_force_) component = values.number(0.0);
  }
  values.require_end();
  expected_.take(input);
  return input;
}

}  // namespace calligraphy
