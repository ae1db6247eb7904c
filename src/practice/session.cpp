#include <calligraphy/practice/session.hpp>

#include <algorithm>
#include <exception>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/detail/flush_denormals.hpp>

#include "base/require.hpp"
#include "session_tick.hpp"
#include "trace_hand.hpp"

namespace calligraphy {
namespace {

/// Height at which the pen waits before the first stroke, above the middle of the page [m].
constexpr double resting_height = 0.02;

/// Samples between two calls of the progress function.
constexpr std::size_t progress_interval = 256;

/// The last stroke of a page, if it is in doubt, is finished once the pen has been in the air for a second: longest
/// time for which a hand that has nothing more to write waits for that [s].
constexpr double max_doubt = 1.1;

Intention to_device(const Intention& page, const MotionMapping& mapping) {
  return {mapping.to_device(page.position), mapping.rotation.transpose() * page.velocity / mapping.scale, page.stylus};
}

Eigen::Vector3d resting_point(const PracticePage& page) {
  return {0.5 * page.width, 0.5 * page.height, resting_height};
}

/// Hands over the last ticks of a session that ends by an exception.
struct KeepOnThrow {
  const SessionOptions& options;
  const Recording& recording;
  int exceptions = std::uncaught_exceptions();

  ~KeepOnThrow() {
    if (!options.keep || std::uncaught_exceptions() == exceptions) return;
    try {
      options.keep(recording);
    } catch (...) {  // the first exception is on its way
    }
  }
};

void end(const SessionOptions& options, const Recording& recording) {
  if (options.keep) options.keep(recording);
  if (options.progress) options.progress(1.0);
}

/// Renders the device's present sample, sends the force and records the tick.
const HapticTick& record_tick(const PracticePage& page, HapticDevice& device, SessionTick& session,
                              const SessionOptions& options, Recording& recording) {
  if (options.keep && recording.samples.size() % progress_interval == 0) options.keep(recording);
  const DeviceState input = device.read();
  const HapticTick& tick = session.update(input);
  if (session.has_failed()) std::rethrow_exception(session.error());
  device.write(session.force());
  recording.samples.push_back(session.sample());
  recording.inputs.push_back(session.input(input));
  if (options.progress && recording.samples.size() % progress_interval == 0) {
    options.progress(share_written(page, tick.character, tick.stroke));
  }
  return tick;
}

}  // namespace

double share_written(const PracticePage& page, int character, int stroke) noexcept {
  const auto count = static_cast<double>(page.characters.size());
  if (character >= static_cast<int>(page.characters.size())) return 1.0;
  const auto& active = page.characters[static_cast<std::size_t>(character)].character;
  return (character + stroke / static_cast<double>(active.stroke_count())) / count;
}

Recording run_session(const PracticePage& page, const SessionOptions& options, const PenMotion& motion) {
  require_above_zero("character_timeout", options.character_timeout, "s");
  const MotionMapping mapping = options.mapping.value_or(upright_page(page.width, page.height));
  Capabilities capabilities = options.device;
  capabilities.simulated = true;
  // The renderer comes first because it rejects an invalid mapping, with which the device would have no position.
  HapticRenderer renderer(page.characters, mapping, capabilities, options.renderer);
  SimulatedDevice device(capabilities, options.skill.grip, mapping.to_device(resting_point(page)));

  const detail::FlushDenormals as_a_servo_thread;
  SessionTick session(renderer, capabilities, options.mode, options.law, options.measure_ticks);
  const double period = 1.0 / renderer.options().servo_rate;
  const double longest = options.character_timeout * static_cast<double>(page.characters.size());
  Recording recording = recording_for(page, renderer, options.renderer, capabilities, options.mode, options.law);
  const KeepOnThrow keep_on_throw{options, recording};
  while (device.time() < longest) {
    const std::optional<Intention> next = motion(record_tick(page, device, session, options, recording), period);
    if (!next) break;
    device.set_intention(to_device(*next, mapping));
    device.advance(period);
  }
  end(options, recording);
  return recording;
}

Recording write_page(const PracticePage& page, const SessionOptions& options) {
  SimulatedWriter writer(page, options.skill, options.seed);
  return run_session(page, options, [&writer](const HapticTick& tick, double seconds) -> std::optional<Intention> {
    const Intention next = writer.update(visual_feedback(tick), seconds);
    if (writer.done()) return std::nullopt;
    return next;
  });
}

Recording follow_trace(const PracticePage& page, const PenTrace& trace, const SessionOptions& options) {
  if (page.characters.size() != 1) {
    throw ValueError("follow_trace: the page has " + std::to_string(page.characters.size()) +
                     " characters, expected 1");
  }
  const TraceHand hand(trace, page.characters.front(), resting_point(page));
  double time = 0.0;
  return run_session(page, options, [&](const HapticTick& tick, double seconds) -> std::optional<Intention> {
    const double wait = tick.hint == WritingHint::lifted_early ? max_doubt : 0.0;
    if (time > hand.duration() + wait) return std::nullopt;
    const TraceHand::Pen from = hand.at(time);
    time += seconds;
    return Intention{from.point, (hand.at(time).point - from.point) / seconds, from.stylus};
  });
}

Recording replay_page(const PracticePage& page, ReplayDevice& device, const SessionOptions& options) {
  const MotionMapping mapping = options.mapping.value_or(upright_page(page.width, page.height));
  HapticRenderer renderer(page.characters, mapping, device.capabilities(), options.renderer);
  const detail::FlushDenormals as_a_servo_thread;
  SessionTick session(renderer, device.capabilities(), options.mode, options.law, options.measure_ticks);
  Recording recording = recording_for(page, renderer, options.renderer, device.capabilities(), options.mode, options.law);
  while (!device.finished()) record_tick(page, device, session, options, recording);
  end(options, recording);
  return recording;
}

Recording replayed(const Recording& recording) {
  if (!recording.setup) throw ValueError("recording: without a set-up its ticks cannot be made again");
  if (recording.inputs.empty() && !recording.samples.empty()) {
    throw ValueError("recording: without inputs its ticks cannot be made again");
  }
  const RecordingSetup& setup = *recording.setup;
  RendererOptions options = setup.renderer;
  if (setup.has_own_law) options.guidance.force = GuidanceOptions().force;  // only its forces are of the author's law
  HapticRenderer renderer(setup.page.characters, setup.mapping, setup.device, options);
  const detail::FlushDenormals as_a_servo_thread;
  SessionTick session(renderer, setup.device, setup.mode, {}, false);
  Recording result = recording;
  result.samples.clear();
  result.samples.reserve(recording.inputs.size());
  for (DeviceState input : recording.inputs) {
    if (!input.force.allFinite()) input.force = force_at_work(setup.device, session.force());
    session.update(input);
    result.samples.push_back(session.sample());
  }
  if (!setup.has_own_law) return result;
  for (std::size_t i = 0; i < std::min(result.samples.size(), recording.samples.size()); ++i) {
    result.samples[i].force = recording.samples[i].force;
  }
  return result;
}

}  // namespace calligraphy
