// What happened while a page was written, tick by tick.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string_view>
#include <vector>

#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/render/haptic_tick.hpp>
#include <calligraphy/render/motion_mapping.hpp>

namespace calligraphy {

struct RecordedSample {
  double time = 0.0;                                       ///< [s]
  Eigen::Vector3d device_point = Eigen::Vector3d::Zero();  ///< page frame [m]
  Eigen::Vector3d pen_tip = Eigen::Vector3d::Zero();       ///< page frame [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();         ///< given to the hand, page axes [N]
  InteractionState state = InteractionState::separation;
  TickEvent events = TickEvent::none;
  TickStatus status = TickStatus::ok;
  int character = 0;  ///< active one, by index on the page
  int stroke = 0;     ///< active one, by index within the character
  float tick_ns = 0;  ///< time that the renderer took; 0 when it was not measured [ns]
};

struct Recording {
  double rate = 1000.0;  ///< samples per second [Hz]
  std::vector<RecordedSample> samples;
};

/// Comma-separated values; the first line names columns and units, the second, a comment, gives the rate. Numbers are
/// in the shortest form that reads back the same and do not depend on the locale; events are the sum of TickEvent's
/// bits.
void write_recording(std::ostream& out, const Recording& recording);

/// What write_recording wrote, exactly. `name` is used in messages.
/// @throws FormatError naming the line and the value, also when the file is cut off within a line; FileError when the
/// stream fails
Recording read_recording(std::istream& in, std::string_view name);
/// @throws FileError when the file cannot be opened, FormatError as above
Recording read_recording(const std::filesystem::path& path);

/// The device point of each sample in device axes, for a ReplayDevice on the same mapping. A bad sample has no position
/// (NaN) and a device fault says so, so that they are replayed as what they were.
std::vector<DeviceState> device_states(const Recording& recording, const MotionMapping& mapping);

}  // namespace calligraphy
