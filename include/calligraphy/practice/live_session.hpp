// A person who writes a page with a real device.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/servo_loop.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/session.hpp>

namespace calligraphy {

/// What a display shows, some 50 times a second.
struct LiveView {
  RecordedSample newest;  ///< the newest tick; before the first one all zero
  ServoStatus servo;      ///< of the loop: its state and the fault that it names
  double progress = 0.0;  ///< of the page that is written, in [0, 1]
  bool started = false;   ///< the pen has been in front of the paper; before, nothing is felt and nothing recorded
};

struct LiveOptions {
  FeedbackMode mode = FeedbackMode::force;
  RendererOptions renderer;                                     ///< its servo rate is that of the loop too
  ServoLoopOptions servo;                                       ///< its rate is not read
  double peak_force = std::numeric_limits<double>::infinity();  ///< at most this, whatever the device can do [N]
  double timeout = 600.0;                                       ///< given up after so long [s]
  std::function<bool(const LiveView&)> watch = nullptr;  ///< called from the calling thread; false ends the session
};

struct LiveResult {
  Recording recording;
  ServoStatistics statistics;
  std::uint64_t dropped = 0;          ///< ticks that the recording lacks, because the calling thread came too late
  std::vector<std::string> warnings;  ///< what the servo loop could not have: priority, locked memory, a core
};

/// The device with its forces lowered to a peak [N], which may be infinite.
/// @throws ValueError unless the peak is above 0
Capabilities with_peak_force(Capabilities capabilities, double peak_force);

/// It begins when the pen is in front of the paper for the first time: it may come out of an inkwell that lies behind.
/// Runs the servo loop on the device's own clock or a thread of this library while the calling thread records, until
/// the page is written and the pen lifted, `watch` says false, or time is up. Then the force is zero and the device
/// still open.
/// @throws ValueError when an option is out of its domain, DeviceError when the clock cannot be started
LiveResult write_with_device(const PracticePage& page, HapticDevice& device, const LiveOptions& options);

}  // namespace calligraphy
