// A mouse, tablet or finger that moves the hand of a simulated device, for users without a haptic device.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include <Eigen/Geometry>

#include <calligraphy/devices/simulated_device.hpp>

namespace calligraphy {

/// How the simulated hand follows a pointer. By default it moves like the simulated writer's: 8 mm above the paper
/// between strokes, 2.5 mm deep at half pressure.
struct PointerOptions {
  double rate = 0.0;             ///< rate at which read() is called, becomes update_rate; 0: the profile's [Hz]
  double smoothing_time = 0.03;  ///< lag of the intended position behind the pointer: smooths events that arrive 60 to
                                 ///< 120 times a second into a motion of continuous velocity [s]
  double max_speed = 0.5;        ///< speed limit of the intended position along the paper, also when the pointer jumps
                                 ///< [m/s]
  double lifting_speed = 0.12;   ///< speed of the intended position towards and away from the paper [m/s]
  double hover_height = 8e-3;    ///< height above the paper while the pointer is not pressed [m]
  double press_depth = 5e-3;     ///< depth of the intended position below the paper at full pressure [m]
  Eigen::Isometry3d paper = Eigen::Isometry3d::Identity();  ///< from paper (x, y on it, z out of it) to device axes
};

/// Any thread reports the pointer with move(); the servo loop calls read() and write(). A simulated hand that holds a
/// simulated device follows the pointer and feels the forces, so read() returns the actual position of the pen: draw
/// the pen there, not at the pointer. Mapping the pixels of a window to the paper is left to the caller.
class PointerDevice final : public HapticDevice {
 public:
  /// Simulates this device, held by a hand with this grip that the pointer moves.
  /// @throws ValueError naming the value when the device, the grip or an option is invalid
  explicit PointerDevice(const Capabilities& device, const GripImpedance& grip = {},
                         const PointerOptions& options = {});

  /// Sets the position of the pointer on the paper [m] and its pressure, from 0 (not pressed) to 1; use 0.5 for a mouse
  /// button. What the pen of a tablet senses becomes DeviceState::stylus as it is; its pressure there does not move the
  /// hand. Wait-free; call from any thread, one at a time. Positions and pressures that are not finite are ignored.
  /// Before the first call the pen hovers over the origin of the paper.
  void move(double x, double y, double pressure, std::uint32_t buttons = 0, const StylusState& stylus = {}) noexcept;

  const Capabilities& capabilities() const noexcept override { return device_.capabilities(); }
  /// Advances virtual time by one period, then returns the newest sample.
  DeviceState read() noexcept override;
  void write(const Eigen::Vector3d& force) noexcept override { device_.write(force); }
  void close() noexcept override { device_.close(); }

  /// Intended position of the hand, in device axes. Only for the thread that calls read().
  const Intention& intention() const noexcept { return intention_; }
  /// The simulated device that the hand holds. Only for the thread that calls read().
  const SimulatedDevice& device() const noexcept { return device_; }

 private:
  void take_target() noexcept;
  void follow() noexcept;

  PointerOptions options_;
  SimulatedDevice device_;

  // Sequence lock: the number is odd while the values change.
  std::atomic<std::uint32_t> sequence_ = 0;
  std::array<std::atomic<double>, 3> place_ = {};   ///< position on the paper [m] and pressure
  std::array<std::atomic<double>, 6> stylus_ = {};  ///< the members of StylusState
  std::atomic<std::uint32_t> buttons_ = 0;

  // Used only by the reading thread; in paper axes [m].
  std::uint32_t taken_ = 0;
  Eigen::Vector3d target_;
  Eigen::Vector3d between_;  ///< after the first of two lags
  Eigen::Vector3d meant_;    ///< after the second
  Intention intention_;
};

}  // namespace calligraphy
