// One tick of a session, whoever holds the pen: the renderer's answer and the line that the recording keeps of it.
#pragma once

#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "base/monotonic_clock.hpp"

namespace calligraphy {

/// Asks the renderer, and by choice reads the clock round it.
class SessionTick {
 public:
  SessionTick(HapticRenderer& renderer, FeedbackMode mode, bool measure)
      : renderer_(renderer), mode_(mode), measure_(measure) {}

  /// The force for the device is force().
  const HapticTick& update(const DeviceState& state) noexcept {
    const double before = measure_ ? monotonic_seconds() : 0.0;
    const HapticTick& tick = renderer_.update(state);
    const double after = measure_ ? monotonic_seconds() : 0.0;
    const bool feels = mode_ == FeedbackMode::force;
    force_ = feels ? tick.force : Eigen::Vector3d(Eigen::Vector3d::Zero());
    sample_ = {tick.time,    tick.device_point,
               tick.pen_tip, feels ? tick.page_force : Eigen::Vector3d(Eigen::Vector3d::Zero()),
               tick.state,   tick.events,
               tick.status,  tick.character,
               tick.stroke,  static_cast<float>(1e9 * (after - before))};
    return tick;
  }

  const Eigen::Vector3d& force() const noexcept { return force_; }
  const RecordedSample& sample() const noexcept { return sample_; }

 private:
  HapticRenderer& renderer_;
  FeedbackMode mode_;
  bool measure_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  RecordedSample sample_;
};

/// Of the strokes of the page, by characters.
double share_written(const PracticePage& page, int character, int stroke) noexcept;

}  // namespace calligraphy
