// The ticks of a recording file as text: each value is left out where it is what was to be expected, and positions on
// the grid of an encoder are counts of its steps. The reader expects what the writer does, so nothing is lost.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/detail/flush_denormals.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// Checksum of the forces of samples (64-bit FNV-1a of their bits), from that of those before.
std::uint64_t force_checksum(std::span<const RecordedSample> samples,
                             std::uint64_t before = 0xcbf29ce484222325) noexcept;

/// What is to be expected of the next tick: what both ends of the codec know.
class ExpectedInput {
 public:
  ExpectedInput(double rate, const Capabilities& device);

  /// The time, the buttons and the stylus; also the position, where the pen is at rest.
  const DeviceState& state() const noexcept { return state_; }
  /// The velocity that the device would have estimated at this position.
  const Eigen::Vector3d& velocity_at(const Eigen::Vector3d& position) noexcept {
    const detail::FlushDenormals as_in_a_session;
    return velocity_.update(position, period_);
  }
  /// The steps of the encoder between two coordinates [m]; NaN if moved() would not lead there to the last bit.
  double steps_between(double from, double to) const noexcept;
  /// A coordinate moved by so many steps [m].
  double moved(double from, double steps) const noexcept;
  /// Takes the tick that came.
  void take(const DeviceState& input) noexcept;

 private:
  double period_;  ///< [s]
  double step_;    ///< of the encoder; 0: none [m]
  VelocityEstimator velocity_;
  DeviceState state_;
};

/// Writes ticks.
class InputEncoder {
 public:
  InputEncoder(double rate, const Capabilities& device, bool has_own_law)
      : expected_(rate, device), has_own_law_(has_own_law) {}

  /// Appends a line.
  void append(std::string& text, const DeviceState& input, const Eigen::Vector3d& force);

 private:
  ExpectedInput expected_;
  bool has_own_law_;
};

/// Reads ticks.
class InputDecoder {
 public:
  InputDecoder(double rate, const Capabilities& device, bool has_own_law)
      : expected_(rate, device), has_own_law_(has_own_law) {}

  /// Reads a line. @throws FormatError naming the value
  DeviceState decode(std::string_view line);
  /// The force of the author's own law in this tick, page axes [N].
  const Eigen::Vector3d& own_force() const noexcept { return own_force_; }

 private:
  ExpectedInput expected_;
  bool has_own_law_;
  Eigen::Vector3d own_force_ = Eigen::Vector3d::Zero();
};

}  // namespace calligraphy
