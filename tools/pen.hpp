// Who writes: the simulated writer, or a person with a device.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/devices/servo_statistics.hpp>
#include <calligraphy/judge/language.hpp>
#include <calligraphy/practice/lesson_score.hpp>
#include <calligraphy/practice/session.hpp>

#include "device_choice.hpp"
#include "interrupt.hpp"
#include "stop_key.hpp"

namespace calligraphy::tools {

struct PenOptions {
  DeviceChoice device;
  double peak_force = std::numeric_limits<double>::infinity();  ///< limit in addition to the device's own [N]
  double timeout = 600.0;                                       ///< time after which a person's page is aborted [s]
  Language language;                                            ///< of what a person is told to do
};

class Pen {
 public:
  /// Opens the device. @throws DeviceError, UsageError
  explicit Pen(const PenOptions& options);

  /// Capabilities of the device, with forces limited to PenOptions::peak_force.
  const Capabilities& capabilities() const noexcept { return capabilities_; }

  /// True if a person holds the device and writes in real time.
  bool is_person() const noexcept { return device_ != nullptr; }

  /// Writes a page. Mode, renderer, mapping, progress and keep of the session apply to both, the rest to the simulated
  /// writer. @throws DeviceError, and what the session's functions throw
  Recording write(const PracticePage& page, const SessionOptions& session);

  /// What stops the writing of a person, as in "space, Esc or Ctrl-C".
  std::string stop_keys() const { return tools::stop_keys(*stop_key_, options_.language); }
  /// What else a person may press; empty where no keys are read.
  std::string lesson_keys() const { return stop_key_->available() ? options_.language.text("write.keys") : ""; }
  /// True if Ctrl-C or the stop key was pressed since the device was opened. write() then throws an Error for a
  /// simulated writer, and returns what was written so far for a person.
  bool interrupted() const noexcept { return interrupt_->asked() || (stop_key_ && stop_key_->pressed()); }
  bool stopped_by_key() const noexcept { return interrupted() && !interrupt_->asked(); }
  /// What a person wrote, per page; empty unless a person writes.
  const std::vector<LessonWriting>& lessons() const noexcept { return lessons_; }
  /// Servo loop statistics per page; empty unless a person writes.
  const std::vector<ServoStatistics>& statistics() const noexcept { return statistics_; }
  /// What a person was warned of, each once.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  Recording live(const PracticePage& page, const SessionOptions& session);
  bool is_new(const std::string& warning);

  PenOptions options_;
  Capabilities capabilities_;
  std::unique_ptr<HapticDevice> device_;  ///< null unless a person writes
  std::optional<Interrupt> interrupt_;    ///< from opening the device until the results are written
  std::optional<StopKey> stop_key_;       ///< while a person writes
  std::vector<std::string> warnings_;
  std::vector<ServoStatistics> statistics_;
  std::vector<LessonWriting> lessons_;
};

}  // namespace calligraphy::tools
