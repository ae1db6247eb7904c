#include "releases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <span>

#include <calligraphy/base/random.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_list.hpp>

#include "base/parallel.hpp"
#include "scene.hpp"
#include "stroke_line.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

constexpr double raised = 0.008, depth = 0.0025;  // of the intention [m]
constexpr double lowering = 0.2, waiting = 0.15;  // before the hand moves on [s]
constexpr double fastest_aside = 0.06;            // [m/s]
constexpr double full_weight = 0.95;
constexpr double felt = 0.02;  // a weaker guidance is not missed [N]

Point left_of(const Point& tangent) { return {-tangent.y(), tangent.x()}; }

/// The hand of a case: where it means to be does not depend on the pen.
class StrainedHand {
 public:
  StrainedHand(const ReleaseCase& drawn, const StrokeLine& line) : drawn_(drawn), line_(line) {
    begins_ = lowering + waiting;
    const double goal = drawn.strain == Strain::finish ? line.length() : drawn.share * line.length();
    aside_ = left_of(line.tangent(goal));
    arrives_ = begins_ + std::max(goal / drawn.speed, std::abs(drawn.aside) / fastest_aside);
    speed_ = goal / (arrives_ - begins_);
    acts_ = drawn.strain == Strain::coast ? arrives_ : arrives_ + 0.2;
    if (drawn.strain == Strain::finish) acts_ = arrives_;
  }

  double ends() const { return acts_ + (drawn_.strain == Strain::pull ? 0.03 / drawn_.speed : 0.0) + 0.6; }

  Vector3d intended(double time) const {
    const double way = std::max(0.0, std::min(time, arrives_) - begins_) * speed_;
    Point point = line_.at(way);
    // Aside little by little, so that the strain is there when it happens.
    const double strained = std::clamp((time - begins_) / (arrives_ - begins_), 0.0, 1.0);
    if (drawn_.strain != Strain::pull) point += strained * drawn_.aside * aside_;
    if (time > arrives_ && drawn_.strain == Strain::finish) {  // runs out, slower and slower, at most 5 mm
      point += 0.005 * (1.0 - std::exp(-(time - arrives_) * speed_ / 0.005)) * line_.tangent(line_.length());
    }
    if (drawn_.strain == Strain::pull && time > acts_) {
      point += std::copysign(std::min(0.03, drawn_.speed * (time - acts_)), drawn_.aside) * aside_;
    }
    double height = raised - (raised + depth) * smooth_step(time / lowering);
    if (drawn_.strain == Strain::lift) height += (raised + depth) * smooth_step((time - acts_) / 0.12);
    return {point.x(), point.y(), height};
  }

  HandAction act(double time, const Vector3d& position, const Vector3d& velocity) const {
    constexpr double step = 1e-4;
    const bool open = (drawn_.strain == Strain::open || drawn_.strain == Strain::coast) && time >= acts_;
    HandAction action;
    if (open) {
      // The desk under the paper, for where there is no force that holds the pen.
      action.force.z() = -drawn_.press * std::clamp((position.z() + 0.01) / 0.005, 0.0, 1.0);
      if (position.z() < -0.01) action.force -= 2.0 * velocity;
      return action;
    }
    const Vector3d to = intended(time), velocity_to = (intended(time + step) - to) / step;
    action.mass = drawn_.grip.mass;
    action.force = grip_force(drawn_.grip, to, velocity_to, position, velocity);
    return action;
  }

 private:
  const ReleaseCase& drawn_;
  const StrokeLine& line_;
  Point aside_;  ///< one direction, because a turn at a corner would be a leap of the hand
  double begins_ = 0.0, arrives_ = 0.0, acts_ = 0.0, speed_ = 0.0;
};

/// The guidance as it was just before it was released: the spring towards the same stroke, which goes on beyond its
/// end, with no edge of the tube, and the dampers.
class EndlessGuidance {
 public:
  EndlessGuidance(const StrokeLine& line, const HapticTick& before, const RendererOptions& options)
      : before_(before), arc_(before.contact.arc), damping_(options.guidance.damping) {
    const bool writing = before.state == InteractionState::writing;
    std::vector<Point> points = writing ? line.points() : std::vector<Point>{line.at(0.0), line.at(0.0)};
    if (writing) points.push_back(points.back() + 0.1 * line.tangent(line.length()));
    line_ = StrokeLine(std::move(points));
    if (!writing) arc_ = 0.0;
    window_ = 0.2 * line.length();
    if (options.guidance.force.is(saturating_guidance)) limit_ = options.guidance.limit;
    stiffness_ = options.guidance.stiffness * before.assistance;
    if (writing) stiffness_ *= before.contact.attraction;
    if (writing && options.guidance.force.is(linear_guidance)) stiffness_ *= before.contact.weight;
    fade_in_ = std::max(options.guidance.fade_in, 0.001);
    missing_ = guidance_of(before) - spring(before.pen_tip.head<2>());
  }

  /// What the guidance of a tick amounts to, without friction; the dampers are small.
  static Point guidance_of(const HapticTick& tick) {
    return tick.page_force.head<2>() - tick.friction - tick.viscous.head<2>();
  }

  /// `since` the release [s]: what is not explained by the spring, as that it was fading in, passes.
  Point force(const Point& tip, const Point& velocity, double since) {
    arc_ = line_.nearest_arc(tip, std::max(0.0, arc_ - window_), std::min(line_.length(), arc_ + window_));
    const Point tangent = line_.tangent(arc_);
    const Point along = velocity.dot(tangent) * tangent;
    constexpr double free_share = 0.15;
    const double left = std::max(0.0, 1.0 - since / fade_in_);
    return spring(tip) - damping_ * (velocity - (1.0 - free_share) * along) + left * missing_;
  }

 private:
  Point spring(const Point& tip) const {
    const Point force = stiffness_ * (line_.at(arc_) - tip);
    const double size = force.norm();
    return size > limit_ ? Point(limit_ / size * force) : force;
  }

  HapticTick before_;
  StrokeLine line_;
  double arc_;
  double damping_;
  double window_ = 0.0;
  double limit_ = std::numeric_limits<double>::infinity();
  double stiffness_ = 0.0, fade_in_ = 0.0;
  Point missing_ = Point::Zero();
};

struct Twin {
  ReleaseEvent event;
  IndependentDevice device;
  EndlessGuidance guidance;
};

/// What this tick releases, if anything; `before` is the tick before.
std::optional<Release> released(const HapticTick& before, const HapticTick& tick) {
  if (before.status != TickStatus::ok || tick.status != TickStatus::ok) return std::nullopt;
  if (!(EndlessGuidance::guidance_of(before).norm() > felt) || !(before.attraction.norm() > 0.0)) return std::nullopt;
  if (has_event(tick.events, TickEvent::stroke_finished)) return Release::finished;
  if (has_event(tick.events, TickEvent::lift)) return Release::lifted;
  if (has_event(tick.events, TickEvent::stroke_abandoned)) return Release::abandoned;
  const bool writing = before.state == InteractionState::writing && tick.state == InteractionState::writing;
  const bool weakened = before.contact.weight >= full_weight && tick.contact.weight < full_weight;
  return writing && weakened ? std::optional(Release::weakened) : std::nullopt;
}

double log_between(Random& random, double low, double high) {
  return std::exp(random.between(std::log(low), std::log(high)));
}

}  // namespace

ReleaseCase draw_release(std::uint64_t seed, int index) {
  Random random(seed, {index});
  ReleaseCase drawn;
  drawn.seed = seed;
  drawn.index = index;
  const auto profiles = device_profiles();
  drawn.device = profiles[random.index(profiles.size())];
  drawn.everything = random.next() < 0.5;
  const auto& characters = built_in_characters().characters;
  drawn.character = static_cast<int>(random.index(characters.size()));
  drawn.stroke =
      static_cast<int>(random.index(characters[static_cast<std::size_t>(drawn.character)].sequence.stroke_ids.size()));
  drawn.em = random.between(0.02, 0.06);
  // As in the sweep of stability: log-uniform, redrawn until it swings with a damping ratio of at least 0.1.
  do {
    drawn.grip = {log_between(random, 0.01, 0.3), log_between(random, 0.1, 10.0), log_between(random, 30.0, 1000.0)};
  } while (drawn.grip.damping < 0.2 * std::sqrt(drawn.grip.stiffness * (drawn.grip.mass + drawn.device.apparent_mass)));
  drawn.strain = static_cast<Strain>(random.index(strain_names.size()));
  drawn.aside = random.between(-0.02, 0.02);
  drawn.share = drawn.strain == Strain::coast ? random.between(0.6, 0.95) : random.between(0.2, 0.8);
  drawn.speed = random.between(0.02, 0.08);
  drawn.press = random.between(0.3, 1.0);
  return drawn;
}

std::vector<ReleaseEvent> run_release(const ReleaseCase& drawn,
                                      const std::function<void(const ReleaseSample&)>& watch) {
  const Character& whole = built_in_characters().characters[static_cast<std::size_t>(drawn.character)];
  const Stroke stroke = strokes(whole)[static_cast<std::size_t>(drawn.stroke)];
  const StrokeInput input = input_of(stroke);
  const PracticePage page = page_of(make_character(whole.code, std::span(&input, 1), whole.curve_degree), drawn.em);
  const StrokeLine line = stroke_lines(page.characters.front()).front();
  const StrainedHand hand(drawn, line);
  const MotionMapping mapping = upright_page(page.width, page.height);  // axes of the page are those of the device
  HapticRenderer renderer(
      page.characters, mapping, drawn.device,
      drawn.everything ? RendererOptions::everything(drawn.device) : RendererOptions::for_device(drawn.device));
  IndependentDevice device(drawn.device, mapping.to_device(hand.intended(0.0)));
  const auto act = [&](double time, const Vector3d& position, const Vector3d& velocity) {
    return hand.act(time, mapping.to_page(position), velocity);
  };
  const double period = 1.0 / renderer.options().servo_rate;
  std::vector<ReleaseEvent> events;
  std::vector<Twin> twins;
  HapticTick before;
  while (device.time() < hand.ends()) {
    const HapticTick& tick = renderer.update(device.read());
    if (const auto release = released(before, tick)) {
      const double force = EndlessGuidance::guidance_of(before).norm();
      twins.push_back({{*release, device.time(), force}, device, {line, before, renderer.options()}});
    }
    before = tick;
    device.write(tick.force);
    device.advance(period, act);
    for (Twin& twin : twins) {
      const double since = twin.device.time() - twin.event.time;
      const Point force = twin.guidance.force(mapping.to_page(twin.device.position()).head<2>(),
                                              twin.device.velocity().head<2>(), since);
      twin.device.write({force.x(), force.y(), tick.force.z()});
      twin.device.advance(period, act);
      const double excess = device.velocity().head<2>().norm() - twin.device.velocity().head<2>().norm();
      if (excess <= twin.event.excess) continue;
      twin.event.excess = excess;
      twin.event.excess_at = since + period;
    }
    if (watch) {
      watch({device.time(), tick, mapping.to_page(device.position()), device.velocity(), hand.intended(device.time()),
             twins.empty() ? std::nan("") : twins.back().device.velocity().head<2>().norm()});
    }
    for (auto twin = twins.begin(); twin != twins.end();) {
      const bool done = device.time() - twin->event.time >= release_window;
      if (done) events.push_back(twin->event);
      twin = done ? twins.erase(twin) : twin + 1;
    }
  }
  for (const Twin& twin : twins) events.push_back(twin.event);
  return events;
}

std::vector<std::vector<ReleaseEvent>> run_releases(std::uint64_t seed, int count, int threads,
                                                    const std::function<void(double)>& progress) {
  std::vector<std::vector<ReleaseEvent>> events(static_cast<std::size_t>(count));
  parallel_for(
      events.size(), threads, progress ? progress : [](double) {},
      [&](std::size_t i) { events[i] = run_release(draw_release(seed, static_cast<int>(i))); });
  return events;
}

std::string describe(const ReleaseCase& drawn) {
  char text[512];
  const auto& characters = built_in_characters().characters;
  std::snprintf(text, sizeof text,
                "--seed %llu --case %d: %s, %s, %s stroke %d at %.0f mm, grip %.3g kg %.3g N s/m %.4g N/m; %s, %.1f mm "
                "aside, at %.2f of the stroke, %.3f m/s, press %.2f N",
                static_cast<unsigned long long>(drawn.seed), drawn.index, drawn.device.name.c_str(),
                drawn.everything ? "everything" : "for_device",
                encode_utf8(characters[static_cast<std::size_t>(drawn.character)].code).c_str(), drawn.stroke + 1,
                1e3 * drawn.em, drawn.grip.mass, drawn.grip.damping, drawn.grip.stiffness,
                strain_names[static_cast<std::size_t>(drawn.strain)], 1e3 * drawn.aside, drawn.share, drawn.speed,
                drawn.press);
  return text;
}

}  // namespace calligraphy_test
