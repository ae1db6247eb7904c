// Sessions in virtual time: a writer, a device and a renderer in closed loop.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/practice/feedback_mode.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/writer.hpp>
#include <calligraphy/render/haptic_renderer.hpp>
#include <calligraphy/render/motion_mapping.hpp>

namespace calligraphy {

/// Options of a writer, a device and a renderer in closed loop.
struct SessionOptions {
  FeedbackMode mode = FeedbackMode::force;  ///< whether the device receives the renderer's force
  Capabilities device;                      ///< the simulated device, such as device_profile("desktop")
  RendererOptions renderer;                 ///< its servo rate is that of the loop
  /// Computes the whole force on the device in place of the renderer, which still follows the pen: for forces other
  /// than guidance. Called as by a Servo, at the rate of the loop. By default the force is the renderer's.
  ForceLaw law = {};
  /// Device axes to page axes; by default upright_page() of the page. On a desk: desk_page(). With a motion scale K_S
  /// the hand moves 1 / K_S times as far as the pen on the page, and feels K_S^2 times its stiffness:
  /// RendererOptions::for_device(device, K_S) compensates for that.
  std::optional<MotionMapping> mapping = std::nullopt;
  WriterSkill skill;               ///< skill of the simulated writer, whose grip holds the device
  std::uint64_t seed = 1;          ///< seed of the writer's beliefs and mistakes (SimulatedWriter)
  bool measure_ticks = false;      ///< measure the execution time of the renderer in every tick
  double character_timeout = 120;  ///< the session ends after this virtual time per character [s]
  /// Called from time to time with the share of characters written. An exception that it throws ends the session.
  std::function<void(double)> progress = nullptr;
  /// Called with the recording so far before the first tick and then from time to time, so that what comes in can be
  /// stored as it comes (RecordingWriter). An exception that it throws ends the session.
  std::function<void(const Recording&)> keep = nullptr;
};

/// Returns, after each tick, the intended motion of the pen on the page during the `seconds` until the next one;
/// std::nullopt ends the session.
using PenMotion = std::function<std::optional<Intention>(const HapticTick& tick, double seconds)>;

/// Runs the loop: device.read, renderer.update, device.write, `motion`, device.advance. The grip of the skill holds the
/// device; it starts above the centre of the page.
/// @throws ValueError when an option is out of its domain, or when the force of a law is not finite, which ends the
/// session, as does whatever a law throws
Recording run_session(const PracticePage& page, const SessionOptions& options, const PenMotion& motion);

/// Writes the page once. Deterministic per seed, except for measured times.
/// @throws ValueError when an option is out of its domain
Recording write_page(const PracticePage& page, const SessionOptions& options);

/// A session in which a simulated hand follows a person's recorded pen, on a page of one character. Uses only the grip
/// of the skill.
/// @throws ValueError when an option is out of its domain, or the page has not exactly one character
Recording follow_trace(const PracticePage& page, const PenTrace& trace, const SessionOptions& options);

/// Records what the renderer would have rendered for recorded samples, as fast as possible and without a hand in the
/// loop. Uses only the options `mode`, `renderer`, `mapping`, `law`, `measure_ticks`, `progress` and `keep`.
/// @throws ValueError when an option is out of its domain
Recording replay_page(const PracticePage& page, ReplayDevice& device, const SessionOptions& options);

/// Makes the ticks of a recording again from its inputs and its set-up: the same to the last bit, but for measured times,
/// and for the forces of an author's own law, which are kept as they are. With another set-up, what would have been
/// rendered for this pen.
/// @throws ValueError when it has no set-up or no inputs, or the renderer refuses its set-up
Recording replayed(const Recording& recording);

}  // namespace calligraphy
