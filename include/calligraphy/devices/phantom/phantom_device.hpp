// A Phantom or Touch on USB, combining link, codec and kinematics.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/phantom/kinematics.hpp>

namespace calligraphy {

namespace phantom {
class Link;
}  // namespace phantom

/// Selects a Phantom, and how it is driven.
struct PhantomOptions {
  std::string serial;             ///< serial number; empty: the only connected device
  std::string wire_profile;       ///< name of a built-in profile, or a file as described in docs/wire-profile.md
  std::string model = "touch";    ///< omni, touch or premium-1.5: selects linkage and capabilities
  bool drive = true;              ///< false: positions only, the motors stay off
  bool gravity = false;           ///< motors carry the weight of the arm, from the profile; otherwise the hand does
  double velocity_cutoff = 50.0;  ///< cut-off frequency of the velocity filter, 1 to 1000 [Hz]
  bool limit_heat = true;         ///< reduce the torque of warm motors; false: cut it off when they are too warm
  bool keep_calibration = false;  ///< the encoders are known to keep counting while the device is unplugged
  /// Real-time priority, 1 to 99, of the threads that carry reports and commands, if the system permits it; 0: normal
  /// threads. The default is one below the servo loop's, which must not wait for them.
  int priority = 79;
};

/// Checks the options, and reads the profile. @throws FormatError or FileError for the profile, ValueError naming an
/// option, or the lines that the profile lacks
void validate(const PhantomOptions& options);

/// Counts since the device was opened.
struct PhantomStatistics {
  std::uint64_t reports = 0;           ///< frames received, good and bad
  std::uint64_t used_reports = 0;      ///< reports that gave a position
  std::uint64_t lost_reports = 0;      ///< reports lost, by the sequence number
  std::uint64_t repeated_reports = 0;  ///< reports repeated, by the sequence number, and dropped
  std::uint64_t skipped_bytes = 0;     ///< bytes of a stream that belonged to no frame
  std::uint64_t commands = 0;          ///< commands passed to the link
  std::uint64_t refused_commands = 0;  ///< commands that the link did not accept
  std::uint64_t released = 0;          ///< number of times the motors were switched off for lack of a command
  std::array<std::uint64_t, device_fault_count> faults{};  ///< occurrences of each fault, by DeviceFault
  std::uint64_t transfers_failed = 0;                      ///< transfers that the bus did not complete
  std::uint64_t commands_replaced = 0;                     ///< commands superseded by a newer one before they were sent
  std::uint64_t opened = 0;                                ///< number of times the device was found
  double warmest_motor = 0.0;  ///< estimated temperature: 0 cold, 1 the highest it sustains indefinitely
};

/// The link's thread receives and checks reports; read() returns the newest. Every fault, however short, is reported
/// for 20 ms, so that no loop misses it. From its onset write() itself ramps the force down to zero within 10 ms,
/// whatever force is requested, then clears the motor enable bit. After recovery the force ramps up within 0.1 s.
/// docs/phantom.md lists what counts as a fault.
///
/// The status is `needs_calibration` until the pen has been in the inkwell, and again after an unplug unless
/// `keep_calibration` is set. There is no force before calibration, nor while the pen is in the inkwell.
///
/// Never run on hardware.
class PhantomDevice final : public HapticDevice {
 public:
  /// Finds the device and opens it.
  /// @throws DeviceError naming device, cause and remedy, FormatError or FileError for the profile, ValueError naming
  /// an option, or the lines that the profile lacks
  explicit PhantomDevice(const PhantomOptions& options);

  /// Uses a link that is not yet open and your own monotonic clock [s], called from two threads; for this library's
  /// tests. @throws as above
  PhantomDevice(std::unique_ptr<phantom::Link> link, const PhantomOptions& options,
                std::function<double()> clock = nullptr);
  /// Calls close().
  ~PhantomDevice() override;
  PhantomDevice(const PhantomDevice&) = delete;
  PhantomDevice& operator=(const PhantomDevice&) = delete;

  /// Capabilities of the model, with the rate of the profile and the velocity filter of the options.
  const Capabilities& capabilities() const noexcept override;
  /// `stale` when no report has arrived since the last call. The velocity is computed from filtered joint velocities.
  DeviceState read() noexcept override;
  /// Limits the force to the peak force and to what the motors can exert and sustain, preserving its direction. After
  /// 20 ms without a call, the link's thread switches the motors off.
  void write(const Eigen::Vector3d& force) noexcept override;
  /// Switches the motors off and sends the profile's stop commands. Blocks until they are sent.
  void close() noexcept override;
  /// Sends a packet with zero torques and the motors off. The link's own thread transfers it; if that thread does not
  /// answer, it is written directly to the node, which is not possible with hidapi-libusb.
  void cut_force() noexcept override;

  /// Calibrates without the inkwell: takes the joints to be at these angles [rad] at the next report.
  /// @throws ValueError when an angle is not finite
  void calibrate(const phantom::Joints& joints);

  /// Joint angles of the sample last returned by read() [rad].
  const phantom::Joints& joints() const noexcept;
  /// Whether the pen was in the inkwell in that sample.
  bool docked() const noexcept;

  /// Callable from any thread, before close().
  PhantomStatistics statistics() const noexcept;
  /// For example "2988:0302 on bus 1, port 2, serial 540-12345".
  const std::string& description() const noexcept;
  /// Reports a refused real-time priority, with a remedy, and a wire profile without the dead-man bit (`toggle`) or the
  /// enable bit (`motors-on`).
  std::vector<std::string> warnings() const override;
  std::string advice() const override;

 private:
  class Core;
  std::unique_ptr<Core> core_;
  std::optional<EmergencyStopEntry> entry_;  ///< exists while the device is open
};

}  // namespace calligraphy
