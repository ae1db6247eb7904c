// Who writes: the simulated writer, a recorded trace, or a person with a device.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/devices/servo_statistics.hpp>
#include <calligraphy/practice/session.hpp>

#include "device_choice.hpp"
#include "interrupt.hpp"

namespace calligraphy::tools {

struct PenOptions {
  DeviceChoice device;
  std::string like = "desktop";  ///< profile whose limits and workspace a recorded trace gets
  double peak_force = std::numeric_limits<double>::infinity();  ///< at most this, whatever the device can do [N]
  double longest = 600.0;                                       ///< after which a person's page is given up [s]
};

class Pen {
 public:
  /// Opens the device. @throws DeviceError, UsageError
  explicit Pen(const PenOptions& options);

  /// Of the device, its forces lowered to the peak asked for.
  const Capabilities& capabilities() const noexcept { return capabilities_; }

  /// A person holds the device and takes their time.
  bool is_person() const noexcept { return device_ != nullptr; }
  bool is_replay() const noexcept { return options_.device.kind == DeviceKind::replay; }

  /// Of the session the mode, the renderer and the progress count for everyone. @throws FileError, FormatError,
  /// DeviceError
  Recording write(const Page& page, const SessionOptions& session);

  /// Ctrl-C was pressed since the device was opened. It ends a simulated writer's or a trace's write() with an Error, a
  /// person's with what they wrote until then.
  bool interrupted() const noexcept { return interrupt_->asked(); }
  /// Of the servo loop, page by page; a person's alone.
  const std::vector<ServoStatistics>& statistics() const noexcept { return statistics_; }

 private:
  Recording replay(const Page& page, const SessionOptions& session) const;
  Recording live(const Page& page, const SessionOptions& session);

  PenOptions options_;
  Capabilities capabilities_;
  std::unique_ptr<HapticDevice> device_;  ///< a person's
  std::optional<Interrupt> interrupt_;    ///< from when the device is open until what was written is in its files
  std::vector<std::string> warnings_;     ///< that were told
  std::vector<ServoStatistics> statistics_;
};

}  // namespace calligraphy::tools
