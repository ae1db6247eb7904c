// Guidance for large deviations compared with the linear law, for a novice who believes the character to be elsewhere
// (Wang 2006, sec. 7.3, a limitation that the authors state).
#include "../catch.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/practice/score.hpp>
#include <calligraphy/practice/session.hpp>

#include "pages.hpp"

using namespace calligraphy;

namespace {

constexpr int deviating_seeds = 8;
const char* const deviating_text = "永北京木国大";

/// Totals over the pages of one law and one bias.
struct Outcome {
  int strokes = 0, completed = 0, at_once = 0, faults = 0;
  double square = 0.0, way = 0.0;  ///< distance from the expected stroke, integrated along the path on the paper
  double peak = 0.0, step = 0.0;

  double share_at_once() const { return at_once / static_cast<double>(strokes); }
  double rms() const { return std::sqrt(square / way); }

  void add(const PracticePage& page, const Recording& recording) {
    strokes += page.characters.front().character.stroke_count();
    const auto drawn = calligraphy::strokes(page.characters.front().character);
    const Placement& placement = page.characters.front().placement;
    std::vector<StrokeElement> due;
    int loaded = -1, contacts = 0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Point last = recording.samples.front().pen_tip.head<2>();
    for (const RecordedSample& sample : recording.samples) {
      contacts += has_event(sample.events, TickEvent::contact);
      if (has_event(sample.events, TickEvent::stroke_finished)) {
        ++completed;
        at_once += contacts == 1;
        contacts = 0;
      }
      faults += sample.status != TickStatus::ok;
      peak = std::max(peak, sample.force.norm());
      step = std::max(step, (sample.force - force).norm());
      force = sample.force;
      const Point tip = sample.pen_tip.head<2>();
      const double moved = (tip - last).norm();
      last = tip;
      if (sample.state == InteractionState::separation || sample.character != 0 || contacts == 0) continue;
      if (sample.stroke >= static_cast<int>(drawn.size())) continue;
      if (sample.stroke != loaded) {
        loaded = sample.stroke;
        due = place_elements(drawn[static_cast<std::size_t>(loaded)], placement);
      }
      double distance = 1.0;
      for (const StrokeElement& element : due) distance = std::min(distance, nearest_point(element, tip).distance);
      square += distance * distance * moved;
      way += moved;
    }
  }
};

enum class Law { linear, saturating, everything };

RendererOptions options_of(Law law, const Capabilities& capabilities) {
  if (law == Law::everything) return RendererOptions::everything(capabilities);
  RendererOptions options = RendererOptions::for_device(capabilities);
  if (law == Law::linear) return options;
  const RendererOptions all = RendererOptions::everything(capabilities);
  options.guidance.force = all.guidance.force;
  options.guidance.limit = all.guidance.limit;
  options.guidance.to_start = all.guidance.to_start;
  options.contact.box_margin = all.contact.box_margin;
  return options;
}

Outcome write(const std::string& device, Law law, double bias) {
  SessionOptions session;
  session.device = device_profile(device);
  session.renderer = options_of(law, session.device);
  session.skill = WriterSkill::novice();
  session.skill.bias = bias;
  Outcome outcome;
  for (const Character& character : calligraphy_test::characters(deviating_text)) {
    const PracticePage page = lay_out(std::span(&character, 1)).front();
    for (int seed = 1; seed <= deviating_seeds; ++seed) {
      session.seed = static_cast<std::uint64_t>(seed);
      outcome.add(page, write_page(page, session));
    }
  }
  return outcome;
}

}  // namespace

TEST_CASE("guidance for large deviations completes more strokes at once and closer to them than the linear law",
          "[practice]") {
  for (const std::string device : {"desktop", "omni"}) {
    const Capabilities& capabilities = device_profile(device);
    std::printf("%s, a novice who is off by   | strokes completed at once | RMS distance [mm]    | peak force [N]\n",
                device.c_str());
    for (const double bias : {0.0, 0.1, 0.2, 0.3}) {
      const Outcome linear = write(device, Law::linear, bias);
      const Outcome saturating = write(device, Law::saturating, bias);
      const Outcome everything = write(device, Law::everything, bias);
      std::printf(
          "  %2.0f %% of the character (%d strokes) | %5.1f %5.1f %5.1f %%       | %5.2f %5.2f %5.2f | %5.2f %5.2f "
          "%5.2f\n",
          100.0 * bias, linear.strokes, 100.0 * linear.share_at_once(), 100.0 * saturating.share_at_once(),
          100.0 * everything.share_at_once(), 1e3 * linear.rms(), 1e3 * saturating.rms(), 1e3 * everything.rms(),
          linear.peak, saturating.peak, everything.peak);
      CAPTURE(device, bias);
      for (const Outcome& outcome : {linear, saturating, everything}) {
        CHECK(outcome.faults == 0);
        CHECK(outcome.completed == outcome.strokes);
        CHECK(outcome.peak <= capabilities.peak_force);
        // 100 and 400 N/s, and what springs and dampers change at 0.1 m/s, with kicks of 0.05 m/s, as the pen touches.
        CHECK(outcome.step <= std::hypot(0.1 + 800.0 * 1e-4 + 4.0 * 0.05, 0.4 + 600.0 * 1e-4 + 4.0 * (0.05 + 0.05)));
      }
      if (bias < 0.2) continue;
      if (bias > 0.2) {  // nearer to the start all of them begin at once
        CHECK(saturating.share_at_once() > linear.share_at_once());
        CHECK(everything.share_at_once() > linear.share_at_once());
      }
      CHECK(saturating.rms() < linear.rms());
      CHECK(everything.rms() < linear.rms());
    }
  }
}
