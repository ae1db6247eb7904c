#include <algorithm>
#include <cmath>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/experiments/tradeoff.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// Higher than any force rate that a loop here asks for [N/s].
constexpr double no_rate_limit = 1e9;

// A pen lowered onto the paper and pressed there, as a writer does it.
constexpr double lowered_from = 0.005, pressed_to = 0.003;  // [m]
constexpr double lowering_speed = 0.1;                      // [m/s]
constexpr double pressed_for = 2.0, watched_for = 0.4;      // [s]
constexpr double resting_swing = 5e-6;                      ///< peak to peak, a fraction of an encoder step [m]

constexpr double softest = 50.0, hardest = 1e6;  ///< stiffnesses that are tried [N/m]

RendererOptions with_paper(RendererOptions options, double stiffness, bool limit) {
  options.paper.stiffness = stiffness;
  if (!limit) options.limits.normal_rate = no_rate_limit;
  return options;
}

/// Whether a pen pressed on the paper comes to rest: the whole loop, dry friction, encoder and force limits included.
bool comes_to_rest(const PracticePage& page, const Capabilities& capabilities, const GripImpedance& grip,
                   const RendererOptions& options) {
  const MotionMapping mapping = upright_page(page.width, page.height);
  HapticRenderer renderer(page.characters, mapping, capabilities, options);
  const Point middle = bounding_box(page.characters.front()).center();
  const auto above = [&](double z) { return mapping.to_device({middle.x(), middle.y(), z}); };
  SimulatedDevice device(capabilities, grip, above(lowered_from));
  const double period = 1.0 / options.servo_rate;
  double low = lowered_from, high = -lowered_from;
  while (device.time() < pressed_for) {
    device.write(renderer.update(device.read()).force);
    const double wanted = lowered_from - lowering_speed * device.time();
    const double speed = wanted > -pressed_to ? -lowering_speed : 0.0;
    device.set_intention(
        {above(std::max(wanted, -pressed_to)), mapping.rotation.transpose() * Eigen::Vector3d(0.0, 0.0, speed)});
    device.advance(period);
    if (device.time() < pressed_for - watched_for) continue;
    const double z = mapping.to_page(device.true_position()).z();
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return high - low < resting_swing;
}

/// The largest stiffness below which none that was tried is unstable, to 2 % [N/m].
double max_stable_stiffness(const PracticePage& page, const Capabilities& device, const GripImpedance& grip,
                            const RendererOptions& options, bool limit, const std::function<void()>& pause) {
  const auto stable = [&](double stiffness) {
    pause();
    return comes_to_rest(page, device, grip, with_paper(options, stiffness, limit));
  };
  double good = softest, bad = softest;
  if (!stable(good)) return 0.0;
  do {
    good = bad;
    bad *= 1.2;
    if (bad > hardest) return hardest;
  } while (stable(bad));
  while (bad / good > 1.02) {
    const double middle = std::sqrt(good * bad);
    (stable(middle) ? good : bad) = middle;
  }
  return good;
}

struct Written {
  double penetration = 0.0, path_error = 0.0, force_step = 0.0, share = 0.0;
};

/// Each character on a page of its own, each with every seed.
Written write_all(std::span<const Character> characters, const Capabilities& device, const RendererOptions& renderer,
                  const ServoRateTradeoffOptions& options, const std::function<void()>& pause) {
  SessionOptions session;
  session.progress = [&pause](double) { pause(); };
  session.device = device;
  session.renderer = renderer;
  session.skill = WriterSkill::novice();
  Written written;
  double squares = 0.0;
  int completed = 0, strokes = 0, scored = 0;
  for (const Character& character : characters) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    for (int i = 0; i < options.seeds; ++i) {
      session.seed = options.seed + static_cast<std::uint64_t>(i);
      const Recording recording = write_page(page, session);
      Eigen::Vector3d last = Eigen::Vector3d::Zero();
      for (const RecordedSample& sample : recording.samples) {
        const bool solid = sample.state == InteractionState::calibration || sample.state == InteractionState::writing;
        if (solid) written.penetration = std::max(written.penetration, -sample.device_point.z());
        written.force_step = std::max(written.force_step, (sample.force - last).norm());
        last = sample.force;
      }
      const CharacterScore own = score_page(page, recording).front();
      completed += own.strokes_completed;
      strokes += own.stroke_count;
      if (own.strokes_written == 0) continue;
      squares += own.rms_error * own.rms_error;
      ++scored;
    }
  }
  written.path_error = scored > 0 ? std::sqrt(squares / scored) : 0.0;
  written.share = static_cast<double>(completed) / strokes;
  return written;
}

}  // namespace

std::vector<ServoRateTradeoff> servo_rate_tradeoff(std::span<const Character> characters,
                                                   const ServoRateTradeoffOptions& options) {
  if (characters.empty()) throw ValueError("servo rate: no characters");
  require_above_zero("seeds", options.seeds, "");
  const Capabilities& device = device_profile(options.device);
  RendererOptions usual = RendererOptions::for_device(device);
  usual.stiffness_check = StiffnessCheck::off;  // stability is what is measured here
  const PracticePage page = lay_out(characters.first(1)).front();
  double total = 0.0, done = 0.0;
  for (const double rate : options.rates) total += rate;
  // Also called within a rate, which may take a minute.
  const auto pause = [&] {
    if (options.progress) options.progress(done / total);
  };
  std::vector<ServoRateTradeoff> tradeoff;
  for (const double rate : options.rates) {
    RendererOptions renderer = usual;
    renderer.servo_rate = rate;
    validate(renderer, device);
    const GripImpedance grip = WriterSkill::novice().grip;
    ServoRateTradeoff entry;
    entry.rate = rate;
    entry.stiffness = renderer.paper.stiffness;
    entry.stable = comes_to_rest(page, device, grip, renderer);
    const Written written = write_all(characters, device, renderer, options, pause);
    entry.penetration = written.penetration;
    entry.path_error = written.path_error;
    entry.force_step = written.force_step;
    entry.written = written.share;
    entry.loop_stiffness = max_stable_stiffness(page, device, grip, renderer, true, pause);
    entry.unlimited_stiffness = max_stable_stiffness(page, device, grip, renderer, false, pause);
    entry.held_stiffness = critical_stiffness({device, rate, grip});
    entry.free_stiffness = critical_stiffness({device, rate});
    entry.hard_stiffness = 0.5 * entry.unlimited_stiffness;
    const Written hard =
        write_all(characters, device, with_paper(renderer, entry.hard_stiffness, false), options, pause);
    entry.hard_penetration = hard.penetration;
    entry.hard_force_step = hard.force_step;
    tradeoff.push_back(entry);
    done += rate;
    pause();
  }
  return tradeoff;
}

}  // namespace calligraphy
