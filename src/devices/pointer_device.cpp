#include <calligraphy/devices/pointer_device.hpp>

#include <algorithm>
#include <cmath>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "base/stylus_fields.hpp"

namespace calligraphy {
namespace {

PointerOptions checked(PointerOptions options, const Capabilities& device) {
  if (options.rate == 0.0) options.rate = device.update_rate;
  require_within("pointer: rate", options.rate, "Hz", 100.0, 1e5);
  require_within("pointer: smoothing_time", options.smoothing_time, "s", 0.0, 1.0);
  require_within("pointer: max_speed", options.max_speed, "m/s", 1e-3, 10.0);
  require_within("pointer: lifting_speed", options.lifting_speed, "m/s", 1e-3, 10.0);
  require_within("pointer: hover_height", options.hover_height, "m", 0.0, 0.1);
  require_within("pointer: press_depth", options.press_depth, "m", 0.0, 0.1);
  const Eigen::Matrix3d rotation = options.paper.linear();
  if (!options.paper.matrix().allFinite() ||
      !(rotation.transpose() * rotation).isApprox(Eigen::Matrix3d::Identity(), 1e-9) || rotation.determinant() < 0.0) {
    throw ValueError("pointer: the transform of the paper is not a rotation and a translation");
  }
  return options;
}

Capabilities at_rate(Capabilities device, double rate) {
  device.update_rate = rate;
  return device;
}

/// Reads that overlap a write are retried; a write takes a few nanoseconds.
constexpr int max_attempts = 8;

}  // namespace

PointerDevice::PointerDevice(const Capabilities& device, const GripImpedance& grip, const PointerOptions& options)
    : options_(checked(options, device)),
      device_(at_rate(device, options_.rate), grip, options.paper * Eigen::Vector3d(0.0, 0.0, options.hover_height)),
      target_(0.0, 0.0, options.hover_height),
      between_(target_),
      meant_(target_) {
  intention_.position = options_.paper * meant_;
}

void PointerDevice::move(double x, double y, double pressure, std::uint32_t buttons,
                         const StylusState& stylus) noexcept {
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(pressure)) return;
  const double height = pressure > 0.0 ? -std::min(pressure, 1.0) * options_.press_depth : options_.hover_height;
  const Eigen::Vector3d& workspace = device_.capabilities().workspace;  // positions are clamped to twice its size
  sequence_.fetch_add(1, std::memory_order_acquire);
  place_[0].store(std::clamp(x, -workspace.x(), workspace.x()), std::memory_order_release);
  place_[1].store(std::clamp(y, -workspace.y(), workspace.y()), std::memory_order_release);
  place_[2].store(height, std::memory_order_release);
  for (std::size_t i = 0; i < stylus_.size(); ++i) {
    stylus_[i].store(stylus.*stylus_fields[i].member, std::memory_order_release);
  }
  buttons_.store(buttons, std::memory_order_release);
  sequence_.fetch_add(1, std::memory_order_release);
}

DeviceState PointerDevice::read() noexcept {
  take_target();
  follow();
  device_.set_intention(intention_);
  device_.advance(1.0 / options_.rate);
  return device_.read();
}

void PointerDevice::take_target() noexcept {
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    const std::uint32_t before = sequence_.load(std::memory_order_acquire);
    if (before == taken_) return;
    if (before % 2 == 1) continue;
    const Eigen::Vector3d place(place_[0].load(std::memory_order_acquire), place_[1].load(std::memory_order_acquire),
                                place_[2].load(std::memory_order_acquire));
    StylusState stylus;
    for (std::size_t i = 0; i < stylus_.size(); ++i) {
      stylus.*stylus_fields[i].member = stylus_[i].load(std::memory_order_acquire);
    }
    const std::uint32_t buttons = buttons_.load(std::memory_order_acquire);
    if (sequence_.load(std::memory_order_relaxed) != before) continue;
    taken_ = before;
    target_ = place;
    intention_.stylus = stylus;
    device_.set_buttons(buttons);
    return;
  }
}

/// Two equal first-order lags in series turn stepwise positions into a path of continuous velocity. The second is
/// limited in speed, so that a pointer that jumps or is lifted does not fling the pen.
void PointerDevice::follow() noexcept {
  const double period = 1.0 / options_.rate;
  const double lag = 0.5 * options_.smoothing_time;
  const double share = lag > 0.0 ? -std::expm1(-period / lag) : 1.0;
  between_ += share * (target_ - between_);
  Eigen::Vector3d step = share * (between_ - meant_);
  const double along = step.head<2>().norm();
  const double longest = options_.max_speed * period;
  if (along > longest) step.head<2>() *= longest / along;
  step.z() = std::clamp(step.z(), -options_.lifting_speed * period, options_.lifting_speed * period);
  intention_.position = options_.paper * meant_;
  intention_.velocity = options_.paper.linear() * step / period;
  meant_ += step;
}

}  // namespace calligraphy
