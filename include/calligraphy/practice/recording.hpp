// A tick-by-tick recording of a page being written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/practice/feedback_mode.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/render/haptic_tick.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// One tick of a recording.
struct RecordedSample {
  double time = 0.0;                                       ///< sample time, since the device was opened [s]
  Eigen::Vector3d device_point = Eigen::Vector3d::Zero();  ///< haptic interface point, page frame [m]
  Eigen::Vector3d pen_tip = Eigen::Vector3d::Zero();       ///< virtual pen tip, page frame [m]
  /// Force on the pen, page axes [N]; with a motion scale K_S the hand feels K_S times as much.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  InteractionState state = InteractionState::separation;  ///< after this tick
  TickEvent events = TickEvent::none;                     ///< what happened in this tick
  TickStatus status = TickStatus::ok;                     ///< whether its sample was usable
  int character = 0;                                      ///< index of the active character on the page
  int stroke = 0;                                         ///< index of the active stroke within the character
  float tick_ns = 0;                                      ///< execution time of the renderer; 0 if not measured [ns]
};

/// All that it takes, besides what came in, to make the ticks of a recording again.
struct RecordingSetup {
  PracticePage page;                         ///< that was written
  MotionMapping mapping;                     ///< device axes to page axes
  Capabilities device;                       ///< as the renderer knew it
  RendererOptions renderer;                  ///< as given to the renderer
  FeedbackMode mode = FeedbackMode::force;   ///< whether the device received the renderer's force
  bool has_own_law = false;                  ///< the forces are of a law that is not the library's
};

/// A page being written, tick by tick.
struct Recording {
  double rate = 1000.0;                 ///< samples per second [Hz]
  std::vector<RecordedSample> samples;  ///< one per tick, in order
  std::uint32_t page = 0;               ///< page_id() of the page that was written; 0: unknown
  std::string law = {};                 ///< name of the force law, with parameters: "linear: 600 N/m"; empty: unknown
  /// What came in at each tick, exactly, or empty if it was not recorded. A force of NaN is that of the tick before,
  /// as a simulated device outputs it (output_force()) or a servo has sent it to a real one.
  std::vector<DeviceState> inputs = {};
  std::optional<RecordingSetup> setup = {};  ///< std::nullopt if it is not known
};

/// The pen-downs of a recording, in the coordinates of a character's square, whether or not the renderer accepted them
/// as strokes: the samples from each contact to the lift, except rejected ones. A lift of at most 50 ms is a bounce,
/// not an intended lift: voluntary motion ends at 10 Hz. A loss of samples for at most 100 ms does not end a pen-down
/// either, unless a sample shows a lift.
std::vector<PenPath> pen_paths(const Recording& recording, const Placement& placement);

/// The device point of each sample in device axes, for a ReplayDevice with the same mapping. A bad sample has no
/// position (NaN) and a device fault is marked as one, so both are replayed as recorded.
std::vector<DeviceState> device_states(const Recording& recording, const MotionMapping& mapping);

}  // namespace calligraphy
