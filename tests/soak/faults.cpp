#include "faults.hpp"

#include <bit>
#include <limits>

namespace calligraphy_test {
namespace {

using calligraphy::DeviceState;
using calligraphy::DeviceStatus;

constexpr double share_of_ticks_that_begin_one = 1.0 / 2000.0;

constexpr double bad_values[] = {std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN(),
                                 5e-324,
                                 1e-310,
                                 1.7e308,
                                 -1e200};

}  // namespace

void Faults::begin(const DeviceState& state) {
  ++count_;
  kind_ = static_cast<Kind>(random_.next() * static_cast<double>(Kind::number_of_kinds));
  const double length = random_.next();
  left_ = length < 0.3 ? 1 : static_cast<int>(random_.between(1.0, 60.0));
  if (kind_ == Kind::gone && length > 0.9) left_ = static_cast<int>(random_.between(60.0, 10'000.0));
  axis_ = static_cast<int>(3.0 * random_.next());
  held_ = state;
  if (kind_ == Kind::time_back) clock_offset_ -= random_.between(0.0, 1.0);
  if (kind_ == Kind::time_leap) clock_offset_ += random_.between(0.0, 10.0);
}

DeviceState Faults::tamper(const DeviceState& state) {
  if (left_ > 0) {
    --left_;
  } else if (random_.next() < share_of_ticks_that_begin_one) {
    begin(state);
  }
  DeviceState result = state;
  result.time += clock_offset_;
  if (left_ == 0) return result;
  double& coordinate = result.position[axis_];
  switch (kind_) {
    case Kind::not_finite:
      coordinate = bad_values[static_cast<std::size_t>(random_.next() * std::size(bad_values))];
      break;
    case Kind::frozen:
      result.position = held_.position;
      if (axis_ == 0) result.status = DeviceStatus::stale;
      break;
    case Kind::leap:
      coordinate += 1.0;
      break;
    case Kind::sign_flip:
      result.position = -result.position;
      break;
    case Kind::one_axis:
      coordinate = 0.0;
      break;
    case Kind::flipped_bits:
      coordinate = std::bit_cast<double>(std::bit_cast<std::uint64_t>(coordinate) ^
                                         (std::uint64_t{1} << static_cast<int>(64.0 * random_.next())));
      break;
    case Kind::gone:
      result.status = DeviceStatus::disconnected;
      result.position = held_.position;
      break;
    case Kind::status:
      result.status = static_cast<DeviceStatus>(static_cast<int>(8.0 * random_.next()));
      break;
    case Kind::time_still:
      result.time = held_.time + clock_offset_;
      break;
    case Kind::late:
      result.time += random_.between(0.0, 0.02);
      break;
    case Kind::jitter:
      result.time += random_.between(-0.0005, 0.0005);
      break;
    case Kind::buttons:
      result.buttons = static_cast<std::uint32_t>(random_.next() * 4e9);
      break;
    case Kind::time_back:
    case Kind::time_leap:
    case Kind::number_of_kinds:
      break;
  }
  return result;
}

}  // namespace calligraphy_test
