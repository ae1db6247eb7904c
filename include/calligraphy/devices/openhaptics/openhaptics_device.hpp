// A Touch, Phantom or Omni by way of the vendor's own runtime, HDAPI, when it is installed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy {

/// How the runtime brings joint encoders to absolute angles.
enum class CalibrationStyle : std::uint8_t {
  encoder_reset,  ///< the pen is held in a known pose
  automatic,      ///< the device does it by itself
  inkwell         ///< the pen is put into the inkwell
};

struct OpenHapticsOptions {
  /// File of the runtime; empty: the environment's CALLIGRAPHY_LIBHD, else libHD.so where the system looks for
  /// libraries.
  std::string library;
  /// As the vendor's setup program calls the device; empty: the runtime's default device.
  std::string device;
  CalibrationStyle calibration = CalibrationStyle::inkwell;
  double (*time)() noexcept = nullptr;  ///< never runs back [s]; null: the system's monotonic clock
};

/// The runtime is loaded while a device is open, never linked; nothing of the vendor's is part of this library.
///
/// The vendor's scheduler is the clock: clock() must be what runs a ServoLoop (which it is by itself), and read() and
/// write() reach the device only from within its ticks. While no loop runs, read() gives the last sample as `stale`;
/// write() of a zero force switches the force output off, so that a watchdog in another thread can end a force, and any
/// other force is ignored. The output is on only while a loop runs. Open all devices before the first loop starts: they
/// share the one scheduler of the runtime.
///
/// Never run on hardware: written from the public interface, tested against a stand-in.
class OpenHapticsDevice final : public HapticDevice {
 public:
  /// @throws DeviceError when the runtime is missing or incomplete, when it has no such device, or while a loop runs on
  /// another device of it; the message says what to do
  explicit OpenHapticsDevice(const OpenHapticsOptions& options = {});
  /// Stops the clock and closes. A ServoLoop on this device must have ended before.
  ~OpenHapticsDevice() override;

  /// Workspace, peak and continuous force and rate as the runtime has them, where they make sense; the rest, the
  /// stiffness above all, from the device profile that is closest to the model.
  const Capabilities& capabilities() const noexcept override;
  DeviceState read() noexcept override;
  void write(const Eigen::Vector3d& force) noexcept override;
  void close() noexcept override;
  ServoClock* clock() noexcept override;

  const std::string& serial() const noexcept;
  /// The file of the runtime.
  const std::string& library() const noexcept;
  /// The newest error code of the runtime; 0: none so far. Any thread.
  std::uint32_t last_error() const noexcept;
  /// "needs calibration: put the pen into the inkwell", or empty: what a person has to do. Any thread.
  std::string advice() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// "warm motors" for 0x0200; "error 0x1234" for a code that is not known.
std::string openhaptics_error_name(std::uint32_t code);

/// Whether the runtime is there and complete, without opening a device.
struct OpenHapticsRuntime {
  bool found = false;
  std::string library;  ///< its file
  std::string advice;   ///< what to do when it is not found
};
OpenHapticsRuntime openhaptics_runtime(const std::string& library = {});

}  // namespace calligraphy
