// A Touch, Phantom or Omni, driven through the vendor's runtime (OpenHaptics HDAPI) if it is installed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy {

/// How the runtime calibrates the joint encoders to absolute angles.
enum class CalibrationStyle : std::uint8_t {
  encoder_reset,  ///< the user holds the pen in a known pose
  automatic,      ///< the device calibrates itself
  inkwell         ///< the user puts the pen into the inkwell
};

/// Selects a device of the vendor's runtime, and how it is calibrated.
struct OpenHapticsOptions {
  /// File name of the runtime; empty: the environment variable CALLIGRAPHY_LIBHD, otherwise libHD.so on the system's
  /// library path.
  std::string library;
  /// Name given to the device in the vendor's setup program; empty: the runtime's default device.
  std::string device;
  CalibrationStyle calibration = CalibrationStyle::inkwell;  ///< style requested until the runtime is calibrated
  double (*time)() noexcept = nullptr;                       ///< a monotonic clock [s]; null: the system's
};

/// The runtime is loaded when a device is opened, stays loaded, and is never linked; this library contains no vendor
/// code.
///
/// The servo loop must be clocked by the vendor's scheduler, clock(), which ServoLoop uses automatically; read() and
/// write() reach the device only from within its ticks. While no loop runs, read() returns the last sample as `stale`;
/// writing a zero force switches the force output off, so that a watchdog in another thread can remove a force, and any
/// other force is ignored. The output is on only while a loop runs. Open all devices before the first loop starts,
/// because they share the runtime's single scheduler.
///
/// No function of the runtime may be called from a signal handler. In an emergency stop, therefore, the next tick of
/// the scheduler, whose thread still runs, writes zero.
///
/// Never run on hardware: written from the public interface and tested against a stub.
class OpenHapticsDevice final : public HapticDevice {
 public:
  /// Loads the runtime and opens the device.
  /// @throws DeviceError when the runtime is missing or incomplete, when it has no such device, or while a loop runs on
  /// another of its devices; the message says what to do
  explicit OpenHapticsDevice(const OpenHapticsOptions& options = {});
  /// Stops the clock and closes. End any ServoLoop on this device first.
  ~OpenHapticsDevice() override;

  /// Workspace, peak and continuous force and rate are those of the runtime if plausible; everything else, in
  /// particular the stiffness, comes from the built-in profile closest to the model.
  const Capabilities& capabilities() const noexcept override;
  DeviceState read() noexcept override;
  void write(const Eigen::Vector3d& force) noexcept override;
  void close() noexcept override;
  ServoClock* clock() noexcept override;
  /// Warns that the vendor documents no watchdog.
  std::vector<std::string> warnings() const override;
  std::string advice() const override;

  /// Serial number of the device, as the runtime reports it.
  const std::string& serial() const noexcept;
  /// File name of the runtime.
  const std::string& library() const noexcept;
  /// Most recent error code of the runtime; 0: none so far. Thread-safe.
  std::uint32_t last_error() const noexcept;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Display text: "warm motors" for 0x0200; "error 0x1234" for an unknown code.
std::string openhaptics_error_name(std::uint32_t code);

/// Whether the runtime is installed and complete, determined without opening a device.
struct OpenHapticsRuntime {
  bool found = false;   ///< the runtime is installed and has every function that this library calls
  std::string library;  ///< file name
  std::string advice;   ///< what to do if it was not found
};

/// Looks for the runtime without opening a device. `library` is as OpenHapticsOptions::library.
OpenHapticsRuntime openhaptics_runtime(const std::string& library = {});

}  // namespace calligraphy
