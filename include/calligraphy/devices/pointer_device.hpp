// A mouse, tablet or finger as the intention of a simulated hand, for people who have no haptic device.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include <Eigen/Geometry>

#include <calligraphy/devices/simulated_device.hpp>

namespace calligraphy {

/// The default hand writes as the simulated writer's: 8 mm above the paper between strokes, 2.5 mm deep at half
/// pressure.
struct PointerOptions {
  double rate = 1000.0;          ///< of read() [Hz]
  double smoothing_time = 0.03;  ///< how late the intention is behind the pointer: events come 60 to 120 times a
                                 ///< second, and what is made of them moves at a speed without leaps [s]
  double largest_speed = 0.5;    ///< of the intention along the paper; a pointer that leaps is followed at this [m/s]
  double lifting_speed = 0.12;   ///< of the intention towards the paper and away from it [m/s]
  double hover_height = 8e-3;    ///< of a pointer that is not pressed, above the paper [m]
  double press_depth = 5e-3;     ///< where a hand at full pressure means to be, below the paper [m]
  Eigen::Isometry3d paper = Eigen::Isometry3d::Identity();  ///< from the paper (x, y on it, z out of it) to device axes
};

/// Any thread says where the pointer is; read() and write() belong to the servo loop. A simulated hand that holds a
/// simulated device follows the pointer and feels the forces, so where the pen really is comes from read(): a program
/// draws the pen there, not at the pointer. How a window's pixels lie on the paper is the caller's business.
class PointerDevice final : public HapticDevice {
 public:
  /// @throws ValueError naming the value when the device, the hand or an option is out of its domain
  explicit PointerDevice(const Capabilities& device, const Hand& hand = {}, const PointerOptions& options = {});

  /// Where the pointer is from now on: a place on the paper [m] and its pressure, from 0, which is not pressed, to 1; a
  /// mouse presses with 0.5. Never waits; from one thread at a time, any thread. A place or pressure that is not finite
  /// is ignored. Before the first call the pen hovers over the paper's origin.
  void move(double x, double y, double pressure, std::uint32_t buttons = 0) noexcept;

  const Capabilities& capabilities() const noexcept override { return device_.capabilities(); }
  /// Lets one period of virtual time pass, then gives the newest sample.
  DeviceState read() noexcept override;
  void write(const Eigen::Vector3d& force) noexcept override { device_.write(force); }
  void close() noexcept override { device_.close(); }

  /// Where the hand means the pen to be, in device axes; of the thread that calls read().
  const Intention& intention() const noexcept { return intention_; }
  const SimulatedDevice& device() const noexcept { return device_; }

 private:
  void take_target() noexcept;
  void follow() noexcept;

  PointerOptions options_;
  SimulatedDevice device_;

  // Handed over under a sequence number that is odd while they change.
  std::atomic<std::uint32_t> sequence_ = 0;
  std::array<std::atomic<double>, 3> place_ = {};  ///< on the paper [m]
  std::atomic<std::uint32_t> buttons_ = 0;

  // Of the thread that reads, on the paper [m].
  std::uint32_t taken_ = 0;
  Eigen::Vector3d target_;
  Eigen::Vector3d between_;  ///< behind the first of two lags
  Eigen::Vector3d meant_;    ///< behind the second
  Intention intention_;
};

}  // namespace calligraphy
