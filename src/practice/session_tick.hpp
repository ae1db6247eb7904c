// One tick of a session, whoever holds the pen: the renderer's answer and the line that the recording keeps of it.
#pragma once

#include <chrono>

#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

namespace calligraphy {

/// Asks the renderer, and by choice reads the clock round it.
class SessionTick {
 public:
  SessionTick(HapticRenderer& renderer, FeedbackMode mode, bool measure)
      : renderer_(renderer), mode_(mode), measure_(measure) {}

  /// The force for the device is force().
  const HapticTick& update(const DeviceState& state) noexcept {
    using Clock = std::chrono::steady_clock;
    const auto before = measure_ ? Clock::now() : Clock::time_point();
    const HapticTick& tick = renderer_.update(state);
    const auto after = measure_ ? Clock::now() : Clock::time_point();
    const bool feels = mode_ == FeedbackMode::force;
    force_ = feels ? tick.force : Eigen::Vector3d(Eigen::Vector3d::Zero());
    sample_ = {tick.time,    tick.device_point,
               tick.pen_tip, feels ? tick.page_force : Eigen::Vector3d(Eigen::Vector3d::Zero()),
               tick.state,   tick.events,
               tick.status,  tick.character,
               tick.stroke,  std::chrono::duration<float, std::nano>(after - before).count()};
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
