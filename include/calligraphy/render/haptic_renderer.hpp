// Renders guided writing, once per tick: device sample in, force out (Wang 2006, sec. 4.1, Figs. 14 and 15).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/render/detail/effective_options.hpp>
#include <calligraphy/render/detail/force_output.hpp>
#include <calligraphy/render/detail/guidance.hpp>
#include <calligraphy/render/detail/paper.hpp>
#include <calligraphy/render/detail/pen_sensor.hpp>
#include <calligraphy/render/detail/stroke_capture.hpp>
#include <calligraphy/render/detail/stroke_coverage.hpp>
#include <calligraphy/render/haptic_tick.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// Guides a pen through the characters of a page, one after the other, stroke by stroke in the correct order and
/// direction.
///
/// update() neither allocates, locks, throws nor logs, and its work is bounded. Use one renderer per device.
class HapticRenderer {
 public:
  /// @throws ValueError naming the option, the mapping, the character or its placement that is invalid
  HapticRenderer(std::vector<PlacedCharacter> page, const MotionMapping& mapping, const Capabilities& capabilities,
                 const RendererOptions& options = {});

  HapticRenderer(HapticRenderer&&) noexcept = default;
  HapticRenderer& operator=(HapticRenderer&&) noexcept = default;

  /// Processes one sample. Write `force` of the result to the device.
  const HapticTick& update(const DeviceState& state) noexcept;

  /// Starts the page again: nothing written, force zero immediately.
  void restart() noexcept;

  /// What the last update() returned. For the thread that calls update() alone: for a display, publish it through a
  /// LatestValue.
  const HapticTick& last() const noexcept { return tick_; }
  /// Effective options: with StiffnessCheck::clip, stiffnesses may be lower than requested.
  const RendererOptions& options() const noexcept { return options_; }
  /// What was clipped, one line per value, with the reason.
  const std::vector<std::string>& clipped() const noexcept { return effective_.clipped; }
  const MotionMapping& mapping() const noexcept { return mapping_; }
  const std::vector<PlacedCharacter>& page() const noexcept { return page_; }
  /// Maximum change of the force per tick [N], that on a pen as fast as the force follows at once (1 m/s); infinite
  /// when the rate is not limited.
  double max_force_step() const noexcept;

 private:
  struct PreparedCharacter {
    std::vector<Stroke> strokes;
    std::vector<StrokeStart> starts;
    Eigen::AlignedBox2d box;  ///< including the margin [m]
    double em = 0.0;          ///< [m]
  };

  TransitionInput sense() noexcept;
  void write_on(const Point& tip, TransitionInput& input) noexcept;
  double needed_coverage() const noexcept;
  void put_down(const Point& tip) noexcept;
  bool begins(const Point& tip) noexcept;
  WritingHint hint() const noexcept;
  void follow(const TransitionInput& input) noexcept;
  void finish_stroke() noexcept;
  void activate(int character, int stroke) noexcept;
  bool is_guided() const noexcept;
  Point hand() const noexcept;
  void send(const Eigen::Vector3d& wanted) noexcept;
  bool may_start() const noexcept { return !character_done_ && (lifted_ || !options_.lift_between_strokes); }
  bool all_written() const noexcept { return writer_.character >= static_cast<int>(page_.size()); }
  /// Of the active stroke.
  const StrokeStart& start_of_stroke() const noexcept {
    return active_character().starts[static_cast<std::size_t>(writer_.stroke)];
  }
  const PreparedCharacter& active_character() const noexcept {
    return prepared_[static_cast<std::size_t>(writer_.character)];
  }

  std::vector<PlacedCharacter> page_;
  std::vector<PreparedCharacter> prepared_;  ///< views into page_
  MotionMapping mapping_;
  EffectiveOptions effective_;
  RendererOptions options_;
  PenSensor sensor_;
  Guidance guidance_;
  Paper paper_;
  ForceOutput output_;
  double hidden_way_ = 0.0;      ///< by which the device's dry friction holds the pen back from a usual hand [m, page]

  ActiveStroke active_;
  StrokeCapture capture_;
  StrokeCoverage coverage_;
  WriterState writer_;
  HapticTick tick_;
  bool inside_box_ = false;
  bool lifted_ = true;           ///< the pen was lifted since the last stroke was finished
  bool character_done_ = false;  ///< its last stroke is finished, and the pen is still down
};

}  // namespace calligraphy
