// A writer, a device and a renderer in closed loop, in virtual time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/pen_trace.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/practice/writer.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

namespace calligraphy {

/// The two modes of the paper's experiment (sec. 7.1).
enum class Mode {
  vision,  ///< the force stays at the renderer: the device is told zero
  force    ///< vision and force
};

struct SessionOptions {
  Mode mode = Mode::force;
  Capabilities device;
  RendererOptions renderer;
  WriterSkill skill;
  std::uint64_t seed = 1;
  bool measure_ticks = false;      ///< reads the clock round every tick of the renderer
  double longest_character = 120;  ///< virtual time after which a character is given up, per character [s]
  /// Called now and then with the share of characters written. What it throws ends the session.
  std::function<void(double)> progress = nullptr;
};

/// Says after each tick how the pen is meant to move on the page in the `seconds` until the next one; nothing ends the
/// session.
using PenMotion = std::function<std::optional<Intention>(const HapticTick& tick, double seconds)>;

/// The loop: device.read, renderer.update, device.write, `motion`, device.advance. The hand that holds the device is
/// that of the skill; it starts above the middle of the page.
/// @throws ValueError when an option is out of its domain
Recording run_session(const Page& page, const SessionOptions& options, const PenMotion& motion);

/// Writes the page once. Deterministic per seed, measured times aside.
/// @throws ValueError when an option is out of its domain
Recording write_page(const Page& page, const SessionOptions& options);

/// A hand that moves as a person's pen did, TraceHand, on a page of one character. Of the skill only the hand counts.
/// @throws ValueError when an option is out of its domain, or the page has not exactly one character
Recording follow_trace(const Page& page, const PenTrace& trace, const SessionOptions& options);

/// The renderer on recorded samples, as fast as it goes and felt by nobody: what it would have done. Of the options the
/// mode, the renderer, the measuring and the progress count.
/// @throws ValueError when an option is out of its domain
Recording replay_page(const Page& page, ReplayDevice& device, const SessionOptions& options);

}  // namespace calligraphy
