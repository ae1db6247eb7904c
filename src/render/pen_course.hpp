// Where a pen can be next, from where it was.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// Follows a pen from sample to sample. A hand can stop within a period, but cannot set out or turn in no time: the
/// next position lies on the path that its velocity predicts, within what acceleration and sensor noise add.
class PenCourse {
 public:
  enum class Place : std::uint8_t {
    expected,   ///< where pens go all the time
    possible,   ///< only a jerk would bring it there
    impossible  ///< no hand would
  };

  /// Lengths on the page are `scale` times those of the device.
  PenCourse(const ForceLimits& limits, const Capabilities& device, double period, double scale);

  /// Starts at a position, at rest or at an unknown speed.
  void begin(const Eigen::Vector3d& position, bool at_rest) noexcept;

  /// The step from the last position to a new sample.
  struct Step {
    double passed;        ///< since the pen was first seen at the last position [s]
    Eigen::Vector3d way;  ///< [m]
    double square;        ///< of the way
    bool is_too_far;      ///< for any speed that is plausible
  };
  /// The step to a position `elapsed` [s] after the previous sample.
  Step step(const Eigen::Vector3d& position, double elapsed) const noexcept;
  /// Classifies a step.
  Place classify(const Step& step) const noexcept;
  /// Records a step that the pen has taken.
  void add(const Eigen::Vector3d& position, const Step& step) noexcept;

 private:
  double max_speed_;         ///< [m/s, page]
  double max_acceleration_;  ///< [m/s^2, page]
  double noise_;             ///< of the way between two samples [m, page]
  double period_;            ///< [s]
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d way_ = Eigen::Vector3d::Zero();  ///< the last step, which led there [m]
  double took_;                                    ///< duration of that step [s]
  double waited_ = 0.0;                            ///< for how long repeated samples have shown it there [s]
};

}  // namespace calligraphy
