// A Phantom or Touch on USB: link, codec and kinematics put together.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/phantom/kinematics.hpp>

namespace calligraphy {

namespace phantom {
class Link;
}  // namespace phantom

struct PhantomOptions {
  std::string serial;             ///< empty: the only one that is plugged in
  std::string wire_profile;       ///< of a shipped one the name, otherwise a file as docs/wire-profile.md describes it
  std::string model = "touch";    ///< omni, touch or premium-1.5: arm and capabilities
  bool drive = true;              ///< false: positions alone, the motors stay off
  bool gravity = false;           ///< motors bear the weight of the arm, as the profile says; felt at the tip otherwise
  double velocity_cutoff = 50.0;  ///< of the filter of the velocity, 1 to 1000 [Hz]
  bool limit_heat = true;         ///< lowers the torque of warm motors; false: cuts it when they are too warm
  bool keep_calibration = false;  ///< the encoders are known to go on counting while the device is unplugged
  /// Real-time priority, 1 to 99, of the threads that carry reports and commands, where the system permits it; 0:
  /// ordinary threads. One below the servo loop's, which is not to wait for them.
  int priority = 79;
};

/// Reads the profile too. @throws FormatError or FileError of the profile, ValueError naming an option, or the lines
/// that the profile lacks
void validate(const PhantomOptions& options);

/// Counts since the device was opened.
struct PhantomStatistics {
  std::uint64_t reports = 0;           ///< frames, good and bad
  std::uint64_t used_reports = 0;      ///< that gave a position
  std::uint64_t lost_reports = 0;      ///< by the sequence number
  std::uint64_t repeated_reports = 0;  ///< by the sequence number: dropped
  std::uint64_t skipped_bytes = 0;     ///< of a stream, that were in no frame
  std::uint64_t commands = 0;          ///< handed to the link
  std::uint64_t refused_commands = 0;  ///< that the link did not take
  std::uint64_t released = 0;          ///< times that the motors were switched off because no command came
  std::array<std::uint64_t, device_fault_count> faults{};  ///< by DeviceFault
  std::uint64_t transfers_failed = 0;
  std::uint64_t commands_replaced = 0;  ///< that a newer one overtook
  std::uint64_t opened = 0;             ///< times that the device was found
  double warmest_motor = 0.0;           ///< 0 cold, 1 what it bears for ever
};

/// Reports come and are judged in the link's thread; read() takes the newest. A fault, however short, is told by name
/// for 20 ms, so that no loop misses it and the force of every fault gets to zero: by a ramp of 10 ms from the last
/// force in write() itself, whatever is then asked for, and with the motors' enable bit off at its end. Afterwards the
/// force rises again within 0.1 s. docs/phantom.md tells what counts as a fault.
///
/// `needs_calibration` until the pen has stood in the inkwell; no force before that, and none while it stands there.
/// After an unplug too, unless `keep_calibration`.
///
/// Nothing of this has been run on hardware.
class PhantomDevice final : public HapticDevice {
 public:
  /// Finds the device and opens it.
  /// @throws DeviceError naming device, reason and what can be done, FormatError or FileError of the profile,
  /// ValueError naming an option, or the lines that the profile lacks
  explicit PhantomDevice(const PhantomOptions& options);

  /// On a link that is not open yet, with the clock of your own [s] (never back, from two threads): for this
  /// library's own tests. @throws as above
  PhantomDevice(std::unique_ptr<phantom::Link> link, const PhantomOptions& options,
                std::function<double()> clock = nullptr);
  ~PhantomDevice() override;
  PhantomDevice(const PhantomDevice&) = delete;
  PhantomDevice& operator=(const PhantomDevice&) = delete;

  const Capabilities& capabilities() const noexcept override;
  /// `stale` when no report has come since the last call; the velocity is that of the joints, filtered.
  DeviceState read() noexcept override;
  /// Shortened to the peak force and to what the motors can give and bear, its direction kept. When no call comes for
  /// 20 ms, the link's thread switches the motors off.
  void write(const Eigen::Vector3d& force) noexcept override;
  /// Motors off, and the profile's stop commands. Waits for their end.
  void close() noexcept override;

  /// The joints are at these angles now [rad], instead of the inkwell; from the next report on.
  /// @throws ValueError when an angle is not finite
  void calibrate(const phantom::Joints& joints);

  /// Of the sample that read() gave last [rad].
  const phantom::Joints& joints() const noexcept;
  bool docked() const noexcept;

  /// Any thread, at any time before close().
  PhantomStatistics statistics() const noexcept;
  /// "2988:0302 on bus 1, port 2, serial 540-12345"
  const std::string& description() const noexcept;
  /// That the priority was not permitted, and what to do.
  std::vector<std::string> warnings() const override;

 private:
  class Core;
  std::unique_ptr<Core> core_;
};

}  // namespace calligraphy
