#include "session_tick.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/base/error.hpp>

#include "base/monotonic_clock.hpp"
#include "collision/length.hpp"

namespace calligraphy {

SessionTick::SessionTick(HapticRenderer& renderer, const Capabilities& device, FeedbackMode mode, const ForceLaw& law,
                         bool measure)
    : renderer_(renderer),
      device_(device),
      mode_(mode),
      law_(law),
      velocity_(device.velocity_cutoff),
      time_(-1.0 / renderer.options().servo_rate),
      measure_(measure) {}

const HapticTick& SessionTick::update(const DeviceState& state) noexcept {
  is_force_known_ = state.force == force_at_work(device_, force_);
  const double before = measure_ ? monotonic_seconds() : 0.0;
  const HapticTick& tick = renderer_.update(state);
  sample_ = {tick.time,  tick.device_point, tick.pen_tip,   tick.page_force, tick.state,
             tick.events, tick.status,       tick.character, tick.stroke,     0.0F};
  force_ = tick.force;
  if (law_) apply_law(state);
  has_failed_ = has_failed_ || sample_.status == TickStatus::bad_law;
  if (mode_ == FeedbackMode::vision) force_ = sample_.force = Eigen::Vector3d::Zero();
  if (measure_) sample_.tick_ns = static_cast<float>(1e9 * (monotonic_seconds() - before));
  return tick;
}

/// Calls the law as a servo does: only for good samples, with their velocity filled in, and with the force limited to
/// the device's peak; a force that is not finite is a failure.
void SessionTick::apply_law(DeviceState state) noexcept {
  force_ = sample_.force = Eigen::Vector3d::Zero();
  if (sample_.status != TickStatus::ok || has_failed_) return;
  if (!state.velocity.allFinite()) {
    state.velocity = velocity_.update(state.position, state.time - time_);
    state.velocity_estimated = true;
    time_ = state.time;
  }
  try {
    force_ = law_(state);
  } catch (...) {
    error_ = std::current_exception();
  }
  if (error_ || !std::isfinite(force_.norm())) {
    sample_.status = TickStatus::bad_law;
    force_ = Eigen::Vector3d::Zero();
    return;
  }
  force_ = shortened(force_, device_.peak_force);
  sample_.force = renderer_.mapping().force_to_page(force_);
}

std::exception_ptr SessionTick::error() const {
  if (!has_failed_) return nullptr;
  if (error_) return error_;
  if (!law_ || renderer_.law_error()) return guidance_error(renderer_);
  return std::make_exception_ptr(ValueError("force law \"" + law_.name + "\": its force is not finite"));
}

std::exception_ptr guidance_error(const HapticRenderer& renderer) {
  if (renderer.law_error()) return renderer.law_error();
  return std::make_exception_ptr(ValueError("guidance law \"" + renderer.law().name + "\": its force is not finite"));
}

Eigen::Vector3d force_at_work(const Capabilities& device, const Eigen::Vector3d& sent) noexcept {
  return device.simulated ? output_force(device, sent) : sent;
}

Recording recording_for(const PracticePage& page, const HapticRenderer& renderer, const RendererOptions& options,
                        const Capabilities& device, FeedbackMode mode, const ForceLaw& law) {
  Recording recording;
  recording.rate = renderer.options().servo_rate;
  recording.page = page_id(page);
  recording.law = mode == FeedbackMode::vision ? "none" : law ? law.name : renderer.law().name;
  const auto& force = options.guidance.force;
  const bool is_ours = force.is(linear_guidance) || force.is(saturating_guidance) || force.is(printed_guidance);
  const bool has_own_law = law || !is_ours;
  recording.setup = {page, renderer.mapping(), device, options, mode, has_own_law};
  return recording;
}

}  // namespace calligraphy
