// Turns device samples into the state of the pen: mapping, plausibility, staleness, velocity, and contact without
// bounces.
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "pen_course.hpp"
#include "pen_state.hpp"

namespace calligraphy {

/// update() never allocates, throws or logs.
class PenSensor {
 public:
  /// A pen farther from the page's origin along any axis is a fault, whatever its speed [m].
  static constexpr double max_coordinate = Placement::max_coordinate;

  /// The options must be valid.
  PenSensor(const RendererOptions& options, const MotionMapping& mapping, const Capabilities& capabilities);

  /// `sent`: the last force, for a device that does not report the force at work [N, device axes].
  PenState& update(const DeviceState& sample, const Eigen::Vector3d& sent) noexcept;
  void restart() noexcept;

 private:
  void count_ticks(const DeviceState& sample) noexcept;
  TickStatus accept(const DeviceState& sample, const Eigen::Vector3d& sent) noexcept;
  bool is_leaping(double time) noexcept;
  bool is_frozen(const Eigen::Vector3d& position, const Eigen::Vector3d& force) noexcept;
  bool is_plausible(const Eigen::Vector3d& position, double elapsed) noexcept;
  void move_device_point(const DeviceState& sample, const Eigen::Vector3d& position) noexcept;
  void estimate_motion(const Eigen::Vector3d& position, double elapsed) noexcept;
  void feel_paper(double elapsed) noexcept;

  ContactOptions contact_;
  MotionMapping mapping_;
  bool is_printed_;     ///< Rules
  double max_speed_;    ///< [m/s, page]
  double period_;       ///< [s]
  bool counts_pauses_;  ///< for the account of energy
  double max_gap_;      ///< a longer time without a sample means that samples are missing [s]
  double max_standstill_;  ///< [s]
  double min_force_change_;  ///< that moves any pen [N, device]
  VelocityEstimator velocity_;
  PenState pen_;
  bool has_sample_ = false;                  ///< a sample was accepted, and the pen has moved on from there
  double time_ = 0.0;                        ///< of that sample [s]
  double clock_ = 0.0;                       ///< time of the last sample that was not stale [s]
  int leaps_ = 0;                            ///< consecutive samples that were much later than the one before
  std::int64_t unseen_ = 0;                  ///< ticks since then, without a good sample
  double above_for_ = 0.0;                   ///< how long a pen in contact has been above the paper [s]
  double unsure_for_;         ///< how long the force must not yet follow the pen at once [s]
  bool is_in_doubt_ = false;  ///< the last sample was off the pen's course
  PenCourse believed_;        ///< of the pen
  PenCourse doubted_;         ///< of samples off that course
  Eigen::Vector3d still_at_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< [m, device]
  Eigen::Vector3d still_force_ = Eigen::Vector3d::Zero();  ///< at work when the pen was first seen there [N, device]
  double still_for_ = 0.0;                                 ///< since the force has changed from that [s]
};

}  // namespace calligraphy
