// One tick of a session, whoever holds the pen: its force, and its sample in the recording.
#pragma once

#include <exception>
#include <limits>

#include <calligraphy/devices/servo.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

namespace calligraphy {

/// Updates the renderer, takes the whole force from the law if there is one, and optionally times both.
class SessionTick {
 public:
  SessionTick(HapticRenderer& renderer, const Capabilities& device, FeedbackMode mode, const ForceLaw& law,
              bool measure);

  /// Processes a sample; force() is then the force for the device.
  const HapticTick& update(const DeviceState& state) noexcept;

  const Eigen::Vector3d& force() const noexcept { return force_; }
  const RecordedSample& sample() const noexcept { return sample_; }
  /// What came in, as Recording::inputs has it, of the sample that was processed last.
  DeviceState input(DeviceState state) const noexcept {
    if (is_force_known_) state.force.setConstant(std::numeric_limits<double>::quiet_NaN());
    return state;
  }
  /// Whether the force law or the guidance law has thrown, or its force was not finite: TickStatus::bad_law.
  bool has_failed() const noexcept { return has_failed_; }
  /// What the law threw first, or a ValueError that names the law; null unless has_failed().
  std::exception_ptr error() const;

 private:
  void apply_law(DeviceState state) noexcept;

  HapticRenderer& renderer_;
  Capabilities device_;
  FeedbackMode mode_;
  ForceLaw law_;
  VelocityEstimator velocity_;
  double time_;  ///< of the last estimate [s]
  bool measure_;
  bool has_failed_ = false;
  std::exception_ptr error_;  ///< what the force law threw
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  RecordedSample sample_;
  bool is_force_known_ = false;  ///< that of the sample is what force_at_work() says of the tick before
};

/// The force at work when nothing comes between that of the last tick and the device: a simulated device reports what
/// it outputs, and of a real one the servo knows what it has written. Device axes [N].
Eigen::Vector3d force_at_work(const Capabilities& device, const Eigen::Vector3d& sent) noexcept;

/// What the guidance law of a renderer threw, or that its force is not finite.
std::exception_ptr guidance_error(const HapticRenderer& renderer);

/// An empty recording of a page written at the rate of a renderer.
Recording recording_for(const PracticePage& page, const HapticRenderer& renderer, const RendererOptions& options,
                        const Capabilities& device, FeedbackMode mode, const ForceLaw& law);

/// Share of the page that is written; every character counts the same [1].
double share_written(const PracticePage& page, int character, int stroke) noexcept;

}  // namespace calligraphy
