// One tick of a session, whoever holds the pen: the force, and the line that the recording keeps of it.
#pragma once

#include <exception>
#include <string>

#include <calligraphy/devices/servo.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

namespace calligraphy {

/// Asks the renderer, and the law for the whole force if there is one, and by choice reads the clock round them.
class SessionTick {
 public:
  SessionTick(HapticRenderer& renderer, const Capabilities& device, FeedbackMode mode, const ForceLaw& law,
              bool measure);

  /// The force for the device is force().
  const HapticTick& update(const DeviceState& state) noexcept;

  const Eigen::Vector3d& force() const noexcept { return force_; }
  const RecordedSample& sample() const noexcept { return sample_; }
  /// Whether the force law or the guidance law has thrown, or its force was not finite: TickStatus::bad_law.
  bool has_failed() const noexcept { return has_failed_; }
  /// What it threw first, or a ValueError that names it; null unless it has failed.
  std::exception_ptr error() const;

 private:
  void ask(DeviceState state) noexcept;

  HapticRenderer& renderer_;
  double peak_force_;  ///< [N]
  FeedbackMode mode_;
  ForceLaw law_;
  VelocityEstimator velocity_;
  double time_;  ///< of the last estimate [s]
  bool measure_;
  bool has_failed_ = false;
  std::exception_ptr error_;  ///< what the force law threw
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  RecordedSample sample_;
};

/// An empty recording of a page written at the rate of a renderer.
Recording recording_for(const PracticePage& page, const HapticRenderer& renderer, FeedbackMode mode,
                        const ForceLaw& law);

/// Of the strokes of the page, by characters.
double share_written(const PracticePage& page, int character, int stroke) noexcept;

}  // namespace calligraphy
