// The pen on the page, as the samples of the device show it.
#pragma once

#include <limits>

#include <Eigen/Core>

#include <calligraphy/render/haptic_tick.hpp>

namespace calligraphy {

/// Position, contact and motion are those of the last good sample: one that is not `ok` leaves them unchanged.
struct PenState {
  double time = 0.0;  ///< of the sample [s]
  TickStatus status = TickStatus::ok;
  bool holds_force = false;  ///< samples have been stale only so briefly that the force is held, as a servo does
  /// Force at work when the sample was read [N, device axes]; NaN if the device does not report it.
  Eigen::Vector3d force = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());

  Eigen::Vector3d position = Eigen::Vector3d::Zero();       ///< of the device, page frame [m]
  Eigen::Vector3d device_point = Eigen::Vector3d::Zero();   ///< haptic interface point, page frame [m]
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();            ///< virtual pen tip, page frame [m]
  double penetration = 0.0;                                 ///< of the device point into the paper [m]
  bool contact = false;                                     ///< touches the paper, or bounces on it
  bool on_paper = false;                                    ///< at most 0.5 mm above it: does not bounce
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();       ///< estimate [m/s, page]
  Eigen::Vector3d last_velocity = Eigen::Vector3d::Zero();  ///< at the previous sample; after a gap, at this one
  Eigen::Vector3d last_position = Eigen::Vector3d::Zero();  ///< likewise

  int ticks = 1;          ///< since the previous sample; more when the loop paused, counted for the account of energy
  double settling = 0.0;  ///< how long after the previous sample another force may have acted [s]

  /// Changes since the previous sample; zero after a gap [m, page], [m/s, page].
  Eigen::Vector3d motion() const noexcept { return position - last_position; }
  Eigen::Vector3d velocity_change() const noexcept { return velocity - last_velocity; }
};

}  // namespace calligraphy
