// Where a pen can be next, from where it was.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// Follows a pen from sample to sample. A hand can stop within a period but not set out or turn in no time: the pen is
/// next on the way that its velocity takes it, within what an acceleration and the noise of the sensor add.
class PenCourse {
 public:
  enum class Place : std::uint8_t {
    expected,   ///< as pens do all the time
    possible,   ///< only a jerk would bring it there
    impossible  ///< no hand would
  };

  /// Lengths on the page are `scale` times those of the device.
  PenCourse(const ForceLimits& limits, const Capabilities& device, double period, double scale);

  /// The pen is there, at rest or at any speed.
  void begin(const Eigen::Vector3d& position, bool at_rest) noexcept;

  /// To the next sample.
  struct Step {
    double passed;        ///< since the pen was first seen where it was [s]
    Eigen::Vector3d way;  ///< [m]
    double square;        ///< of the way
    bool is_too_far;      ///< for any speed that is believed
  };
  /// To a position `elapsed` after the sample before [s].
  Step step(const Eigen::Vector3d& position, double elapsed) const noexcept;
  /// What to make of it.
  Place judge(const Step& step) const noexcept;
  /// The pen has taken it.
  void add(const Eigen::Vector3d& position, const Step& step) noexcept;

 private:
  double max_speed_;         ///< [m/s, page]
  double max_acceleration_;  ///< [m/s^2, page]
  double noise_;             ///< of the way between two samples [m, page]
  double period_;            ///< [s]
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d way_ = Eigen::Vector3d::Zero();  ///< that led there [m]
  double took_;                                    ///< time of that way [s]
  double waited_ = 0.0;                            ///< since it was first seen there, on the way [s]
};

}  // namespace calligraphy
