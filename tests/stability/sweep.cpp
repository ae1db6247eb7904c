#include "sweep.hpp"

#include <cstdio>
#include <numbers>
#include <optional>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/device_profiles.hpp>

#include "base/parallel.hpp"

namespace calligraphy_test {
namespace {

using namespace calligraphy;

constexpr double window_time = 1.0;  // [s]
constexpr double raised = 0.005;     // where the pen comes from [m]
constexpr double lowering = 0.15;    // [s]
constexpr GripImpedance carrier = {0.1, 3.0, 300.0};

double log_between(Random& random, double low, double high) {
  return std::exp(random.between(std::log(low), std::log(high)));
}

Point on_circle(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

/// m, b, k log-uniform, redrawn until the grip with the device swings with a damping ratio of at least 0.1.
GripImpedance draw_grip(Random& random, double device_mass) {
  constexpr std::array<GripImpedance, 5> fixed = {
      {{0.05, 1.0, 100.0}, {0.1, 3.0, 300.0}, {0.15, 5.0, 500.0}, {0.02, 0.3, 30.0}, {0.1, 3.0, 300.0}}};
  if (random.next() < 0.25) return fixed[random.index(fixed.size())];
  for (;;) {
    GripImpedance grip;
    grip.mass = log_between(random, 0.01, 0.3);
    grip.damping = log_between(random, 0.1, 10.0);
    grip.stiffness = log_between(random, 30.0, 1000.0);
    if (grip.damping >= 0.2 * std::sqrt(grip.stiffness * (grip.mass + device_mass))) return grip;
  }
}

void draw_damping(RendererOptions& options, Random& random) {
  const double guidance = random.between(0.0, 10.0), paper = random.between(0.0, 20.0);
  if (random.next() >= 0.5) return;
  options.guidance.damping = guidance;
  options.paper.damping = paper;
}

void draw_options(SweepCase& drawn, Random& random) {
  drawn.composition = static_cast<Composition>(random.index(5));
  try {
    drawn.options = drawn.composition == Composition::everything ? RendererOptions::everything(drawn.device)
                                                                 : RendererOptions::for_device(drawn.device);
  } catch (const Error& error) {
    drawn.refusal = error.what();
  }
  RendererOptions& options = drawn.options;
  options.stiffness_check = StiffnessCheck::clip;
  const bool other_law = random.next() < 0.5;
  random.next();  // once drew a stage that is gone; the other draws of a case stay as they were
  if (drawn.composition == Composition::force_rates || drawn.composition == Composition::stiffness) {
    if (other_law) {
      options.guidance.force = options.guidance.force.is(linear_guidance) ? saturating_guidance : linear_guidance;
    }
  }
  if (drawn.composition == Composition::force_rates) {
    options.limits.in_plane_rate = log_between(random, 20.0, 2000.0);
    options.limits.normal_rate = log_between(random, 20.0, 2000.0);
  } else if (drawn.composition == Composition::stiffness) {
    options.guidance.stiffness = log_between(random, 150.0, 3000.0);
    options.paper.stiffness = log_between(random, 150.0, 3000.0);
    draw_damping(options, random);
  } else if (drawn.composition == Composition::friction) {
    options.paper.friction.coefficient = random.between(0.05, 0.5);
    random.next();  // likewise
  }
}

void draw_disturbance(SweepCase& drawn, Random& random) {
  do {
    drawn.disturbance = static_cast<Disturbance>(random.index(disturbance_names.size()));
  } while (drawn.bare && drawn.disturbance == Disturbance::release);
  const double angle = random.between(0.0, 2.0 * std::numbers::pi);
  const double normal = random.next();
  drawn.direction = {std::cos(angle), std::sin(angle), 0.0};
  if (normal < 0.3) drawn.direction = {0.0, 0.0, normal < 0.15 ? 1.0 : -1.0};
  drawn.distance = random.between(0.002, 0.012);
  drawn.hit_speed = random.between(0.1, 0.4);
  drawn.keeps_press = random.next() < 0.5;
  const double time = random.next(), strength = random.next();
  switch (drawn.disturbance) {
    case Disturbance::jog:
      drawn.duration = 0.02 + 0.04 * time;
      break;
    case Disturbance::pull:
      drawn.duration = 0.1 + 0.4 * time;
      drawn.strength = 1.0 + 3.0 * strength;
      break;
    case Disturbance::push:
      drawn.duration = 0.005 + 0.015 * time;
      drawn.strength = 2.0 + 8.0 * strength;
      break;
    default:
      break;
  }
}

/// Where the hand means to be, and how fast it means to move.
struct Intended {
  Vector3d position = Vector3d::Zero(), velocity = Vector3d::Zero();
};

/// The hand of a case, page axes. A twin neither presses nor means to be below the paper's surface, since without force
/// there is no paper to stop it.
class DisturbedHand {
 public:
  DisturbedHand(const SweepCase& drawn, double device_mass, const PlacedCharacter& placed, bool twin)
      : drawn_(drawn), device_mass_(device_mass), twin_(twin), path_(placed, 0) {
    arc_ = drawn.share * path_.length();
    touched_ = lowering;
    follows_ = touched_ + 0.15;
    stops_ = follows_ + (arc_ > 0.0 ? 0.05 + arc_ / drawn.writing_speed : 0.0);
    opens_ = drawn.bare ? (drawn.carried ? stops_ + 0.2 : 0.0) : 1e9;
    begins_ = (drawn.bare && !drawn.carried ? 0.3 : stops_ + 0.2) + (drawn.bare ? 0.2 : 0.1);
    down_ = ends_ = begins_;
    switch (drawn.disturbance) {
      case Disturbance::jog:
      case Disturbance::pull:
      case Disturbance::push:
        ends_ = begins_ + drawn.duration;
        break;
      case Disturbance::comeback:  // a bare pen is left there
        ends_ = begins_ + 0.5 + (drawn.bare ? 0.0 : 0.05);
        break;
      case Disturbance::tap:
        down_ = begins_ + 0.25;
        ends_ = down_ + (raised + (drawn.bare ? -0.0005 : drawn.depth)) / drawn.hit_speed;
        break;
      case Disturbance::release:
        opens_ = begins_;
        break;
    }
    held_ = at(Vector3d(0.0, 0.0, 0.0), arc_);
  }

  double begins() const { return begins_; }
  double ends() const { return ends_; }
  Vector3d start() const {
    Vector3d point = at(Vector3d(0.0, 0.0, 0.0), 0.0);
    point.z() = drawn_.bare && !drawn_.carried ? 0.0001 : raised;
    return point;
  }

  HandAction act(double time, const Vector3d& position, const Vector3d& velocity) const {
    const bool disturbed = time >= begins_ && time < ends_;
    const bool regripped = drawn_.bare && disturbed &&
                           (drawn_.disturbance == Disturbance::comeback || drawn_.disturbance == Disturbance::tap);
    HandAction action;
    if (time < opens_ || regripped) {
      const GripImpedance& grip = drawn_.bare ? carrier : drawn_.grip;
      const Intended intended = intention(time);
      action.mass = grip.mass;
      action.force = grip_force(grip, intended.position, intended.velocity, position, velocity);
    }
    if (!twin_) action.force.z() -= pressing(time) * std::clamp((position.z() + 0.015) / 0.005, 0.0, 1.0);
    if (disturbed) action.force += knock(time, velocity);
    // The end of the workspace: nothing flies to the moon, nor falls through the desk under the paper.
    if (std::abs(position.x() - 0.5 * page_width) > 0.1 || std::abs(position.y() - 0.5 * page_height) > 0.1 ||
        std::abs(position.z()) > 0.1 || position.z() < -0.01) {
      action.force -= 2.0 * velocity;
    }
    return action;
  }

 private:
  Vector3d at(const Vector3d& add, double arc) const {
    const double aside = drawn_.keeps_beside || arc_ <= 0.0 ? 1.0 : 1.0 - arc / arc_;
    const Point point = path_.at(arc) + aside * drawn_.beside;
    return Vector3d(point.x(), point.y(), 0.0) + add;
  }

  Intended intention(double time) const {
    Intended intended;
    const double depth = drawn_.depth;
    if (time < touched_) {
      intended.position = at(Vector3d(0.0, 0.0, 0.0), 0.0);
      intended.position.z() = raised - (raised + depth) * smooth_step(time / lowering);
      intended.velocity.z() = -(raised + depth) * smooth_slope(time / lowering) / lowering;
    } else if (time < stops_ && time > follows_) {
      const double span = stops_ - follows_;
      intended.position = at({0.0, 0.0, -depth}, arc_ * smooth_step((time - follows_) / span));
    } else {
      intended.position = time <= follows_ ? at(Vector3d(0.0, 0.0, 0.0), 0.0) : held_;
      intended.position.z() = -depth;
    }
    if (time >= begins_ && time < ends_) disturb(time, intended);
    if (twin_ && intended.position.z() < 0.0) intended.position.z() = intended.velocity.z() = 0.0;
    return intended;
  }

  void disturb(double time, Intended& intended) const {
    const double since = time - begins_;
    if (drawn_.disturbance == Disturbance::jog) {
      intended.position += drawn_.distance * drawn_.direction;
    } else if (drawn_.disturbance == Disturbance::comeback) {
      double share = smooth_step(since / 0.3), slope = smooth_slope(since / 0.3) / 0.3;
      if (since > 0.5) {
        share = 1.0 - smooth_step((since - 0.5) / 0.05);
        slope = -smooth_slope((since - 0.5) / 0.05) / 0.05;
      }
      intended.position += share * drawn_.distance * drawn_.direction;
      intended.velocity += slope * drawn_.distance * drawn_.direction;
    } else if (drawn_.disturbance == Disturbance::tap) {
      if (time < down_) {
        intended.position.z() += (raised + drawn_.depth) * smooth_step(since / 0.15);
        intended.velocity.z() += (raised + drawn_.depth) * smooth_slope(since / 0.15) / 0.15;
      } else {
        intended.position.z() = raised - drawn_.hit_speed * (time - down_);
        intended.velocity.z() = -drawn_.hit_speed;
      }
    }
  }

  /// Force into the paper, beside the grip [N].
  double pressing(double time) const {
    if (drawn_.disturbance == Disturbance::tap && time >= begins_ && time < ends_) {
      const bool lifted = time < down_ || raised - drawn_.hit_speed * (time - down_) > 0.0;
      if (lifted) return 0.0;
    }
    if (drawn_.disturbance == Disturbance::release && time >= opens_) {
      const double before = drawn_.press > 0.0 ? drawn_.press : std::min(3.0, drawn_.grip.stiffness * drawn_.depth);
      return drawn_.keeps_press ? before : 0.0;
    }
    if (drawn_.bare && !drawn_.carried) return drawn_.press;
    return drawn_.press * std::clamp((time - touched_) / 0.1, 0.0, 1.0);
  }

  /// Force of a disturbance, beside the grip. No faster than 1 m/s; a bare pen, which nothing else stops, is slower.
  Vector3d knock(double time, const Vector3d& velocity) const {
    double strength = 0.0, fastest = 1.0;
    if (drawn_.disturbance == Disturbance::pull) {
      strength = drawn_.strength;
      if (drawn_.bare) fastest = 0.1;
    } else if (drawn_.disturbance == Disturbance::push) {
      strength = drawn_.strength * std::sin(std::numbers::pi * (time - begins_) / drawn_.duration);
      if (drawn_.bare) fastest = 0.4;
    } else if (drawn_.disturbance == Disturbance::jog && drawn_.bare) {
      strength = 2.0 * device_mass_ * drawn_.hit_speed / drawn_.duration;
      fastest = drawn_.hit_speed;
    }
    if (velocity.dot(drawn_.direction) >= fastest) return {0.0, 0.0, 0.0};
    return strength * drawn_.direction;
  }

  const SweepCase& drawn_;
  double device_mass_;
  bool twin_;
  StrokePath path_;
  double arc_ = 0.0;
  double touched_ = 0.0, follows_ = 0.0, stops_ = 0.0, opens_ = 0.0, begins_ = 0.0, down_ = 0.0, ends_ = 0.0;
  Vector3d held_ = Vector3d::Zero();
};

}  // namespace

SweepCase draw_case(std::uint64_t seed, int index) {
  Random random(seed, {index});
  SweepCase drawn;
  drawn.seed = seed;
  drawn.index = index;
  const auto profiles = device_profiles();
  drawn.device = profiles[random.index(profiles.size())];
  if (drawn.device.viscous_friction == 0.0) drawn.device.viscous_friction = 0.05;  // ideal
  drawn.device.update_rate = log_between(random, 500.0, 10000.0);
  const double lateness = random.next();
  drawn.device.sample_delay = static_cast<int>(lateness < 0.5 ? 4.0 * lateness : 2.0 + 8.0 * (lateness - 0.5));
  drawn.velocity = static_cast<VelocityGiven>(random.index(3));
  drawn.flat = random.next() < 0.5;

  draw_options(drawn, random);

  const auto& characters = built_in_characters().characters;
  drawn.character = static_cast<int>(random.index(characters.size()));
  const double factor = random.between(0.5, 3.0);
  if (random.next() < 0.1) drawn.attraction = factor;

  drawn.bare = random.next() < 0.2;
  drawn.carried = random.next() < 0.6;
  drawn.grip = drawn.bare ? GripImpedance{0.0, 0.0, 0.0} : draw_grip(random, drawn.device.apparent_mass);
  const double away = random.between(0.0, 0.006);
  drawn.beside = on_circle(away, random.between(0.0, 2.0 * std::numbers::pi));
  drawn.keeps_beside = random.next() < 0.5;
  const double share = random.between(0.05, 0.9);
  const bool stays = random.next() < 0.3 || (drawn.bare && !drawn.carried);
  drawn.share = stays ? 0.0 : share;
  drawn.writing_speed = random.between(0.03, 0.15);
  const double press = log_between(random, 0.3, 3.0);
  const double depth = random.between(0.0005, 0.002);
  const bool presses = drawn.bare || random.next() < 0.5;
  drawn.press = presses ? press : 0.0;
  drawn.options.limits.thermal_time_constant = 0.0;  // motors that warm up give way, slowly and on purpose
  drawn.depth = presses ? 0.0 : depth;

  draw_disturbance(drawn, random);
  return drawn;
}

GuidanceFactory strange_law(const std::string& name) {
  GuidanceTraits traits;
  traits.name = name;
  const std::size_t comma = name.find(", stated");
  if (comma != std::string::npos) traits.stiffness = 600.0;
  const std::string kind = name.substr(0, comma);
  if (kind == "spring") return {[](const GuidanceInput& in) -> Point { return 600.0 * in.share * in.way; }, traits};
  if (kind == "stiff") return {[](const GuidanceInput& in) -> Point { return 5000.0 * in.way; }, traits};
  if (kind == "along") return {[](const GuidanceInput& in) -> Point { return 2.0 * in.tangent; }, traits};
  if (kind == "away") return {[](const GuidanceInput& in) -> Point { return -600.0 * in.way; }, traits};
  if (kind == "undamped") {
    return {[](const GuidanceInput& in) -> GuidanceTerms { return {600.0 * in.share * in.way}; }, traits};
  }
  throw ValueError("no such law: " + name);
}

SweepResult run_case(const SweepCase& drawn, const std::function<void(const SweepSample&)>& watch, double settle_time) {
  SweepResult result;
  const Character& character = built_in_characters().characters[static_cast<std::size_t>(drawn.character)];
  const PlacedCharacter placed = in_the_middle(character, drawn.attraction);
  const MotionMapping mapping = drawn.flat ? desk_page(page_width, page_height) : upright_page(page_width, page_height);
  std::optional<HapticRenderer> made;
  try {
    if (!drawn.refusal.empty()) throw ValueError(drawn.refusal);
    made.emplace(std::vector{placed}, mapping, drawn.device, drawn.options);
  } catch (const Error& error) {
    result.refused = true;
    result.refusal = error.what();
    return result;
  }
  HapticRenderer& renderer = *made;
  const auto& factors = placed.character.physics.attraction_factors;
  const double factor = std::max(1.0, *std::max_element(factors.begin(), factors.end()));
  const RendererOptions& options = renderer.options();
  result.guidance_stiffness = options.guidance.stiffness * factor;
  result.paper_stiffness = options.paper.stiffness;
  const double in_plane = result.guidance_stiffness + options.guidance.wrong_way_stiffness +
                          (options.paper.friction.coefficient > 0.0 ? options.paper.friction.stiffness : 0.0);
  const double stiffest = std::max(in_plane, options.paper.stiffness);

  const double mass = drawn.device.apparent_mass;
  const DisturbedHand hand(drawn, mass, placed, false), twin_hand(drawn, mass, placed, true);
  const auto in_device_axes = [&mapping](const DisturbedHand& of) {
    return [&mapping, &of](double time, const Vector3d& position, const Vector3d& velocity) {
      HandAction action = of.act(time, mapping.to_page(position), mapping.velocity_to_page(velocity));
      action.force = mapping.force_to_device(action.force);
      return action;
    };
  };
  const auto guided = in_device_axes(hand), alone = in_device_axes(twin_hand);
  const Vector3d start = mapping.to_device(hand.start());
  IndependentDevice device(drawn.device, start, drawn.velocity), twin(drawn.device, start, drawn.velocity);

  const double rate = drawn.device.update_rate;
  const double window = hand.ends() + settle_time, end = window + window_time;
  Extent motion, twin_motion, force;
  double energy = 0.0;
  for (std::int64_t tick = 0; static_cast<double>(tick) < end * rate; ++tick) {
    const HapticTick& felt = renderer.update(device.read());
    device.write(felt.force);
    const double time = static_cast<double>(tick) / rate;
    if (time < hand.begins()) result.began = felt.state == InteractionState::writing;
    result.peak_force = std::max(result.peak_force, device.force().norm());
    const Vector3d pen = mapping.to_page(device.position()), other = mapping.to_page(twin.position());
    const Vector3d felt_force = mapping.rotation * device.force();
    if (time >= window) {
      motion.add(pen);
      twin_motion.add(other);
      force.add(felt_force);
      result.speed = std::max(result.speed, device.velocity().norm());
      result.twin_speed = std::max(result.twin_speed, twin.velocity().norm());
      if (device.force().norm() > 1e-3) result.acted = true;
    }
    if (watch) watch({time, pen, other, felt_force, felt.state});
    const Vector3d before = device.position();
    device.advance(1.0 / rate, guided);
    energy += device.force().dot(device.position() - before);
    result.energy = std::max(result.energy, energy);
    twin.advance(1.0 / rate, alone);
  }
  Vector3d twin_size = twin_motion.size();
  const bool open = drawn.bare || drawn.disturbance == Disturbance::release;
  if (open) twin_size.z() = 0.0;  // a pen that rests on the paper: the twin has none, and nothing else to hold it
  result.motion = motion.size().maxCoeff();
  result.twin_motion = twin_size.maxCoeff();
  // The stroke may turn the swing of a hand into another direction.
  result.motion_excess = motion.size().maxCoeff() - twin_size.norm();
  result.force = force.size().maxCoeff();
  result.forgiven_force = result.force - stiffest * twin_size.norm();
  return result;
}

std::vector<SweepResult> run_sweep(std::uint64_t seed, int count, int threads,
                                   const std::function<void(double)>& progress,
                                   const std::function<void(SweepCase&)>& change) {
  std::vector<SweepResult> results(static_cast<std::size_t>(count));
  parallel_for(
      results.size(), threads, progress ? progress : [](double) {},
      [&](std::size_t i) {
        SweepCase drawn = draw_case(seed, static_cast<int>(i));
        if (change) change(drawn);
        results[i] = run_case(drawn);
        if (results[i].fails()) results[i].fails_later = run_case(drawn, nullptr, 5.0).fails();
      });
  return results;
}

std::string describe(const SweepCase& drawn) {
  char text[1024];
  const auto& characters = built_in_characters().characters;
  const std::string name = encode_utf8(characters[static_cast<std::size_t>(drawn.character)].code);
  const RendererOptions& options = drawn.options;
  std::snprintf(
      text, sizeof text,
      "--seed %llu --case %d: %s, %.0f Hz, delay %d, %s, K %.0f/%.0f N/m, %s, %.0f/%.0f N/s, friction %.2f, "
      "factor %.2f, %s, velocity %s; %s x %s (%.4g kg, %.3g N s/m, %.4g N/m), beside (%.1f, %.1f) mm%s, "
      "writes %.2f at %.3f m/s, press %.2f N, depth %.2f mm; %s towards (%.2f, %.2f, %.0f): %.1f mm, %.0f ms, %.1f N, "
      "%.2f m/s%s",
      static_cast<unsigned long long>(drawn.seed), drawn.index, drawn.device.name.c_str(), drawn.device.update_rate,
      drawn.device.sample_delay, composition_names[static_cast<std::size_t>(drawn.composition)],
      options.guidance.stiffness, options.paper.stiffness,
      options.guidance.force.is(linear_guidance) ? "linear" : "saturating", options.limits.in_plane_rate,
      options.limits.normal_rate, options.paper.friction.coefficient, drawn.attraction, drawn.flat ? "flat" : "upright",
      std::array{"true", "estimated", "unknown"}[static_cast<std::size_t>(drawn.velocity)], name.c_str(),
      drawn.bare ? (drawn.carried ? "bare pen carried" : "bare pen") : "grip", drawn.grip.mass, drawn.grip.damping,
      drawn.grip.stiffness, 1e3 * drawn.beside.x(), 1e3 * drawn.beside.y(), drawn.keeps_beside ? " kept" : "",
      drawn.share, drawn.writing_speed, drawn.press, 1e3 * drawn.depth,
      disturbance_names[static_cast<std::size_t>(drawn.disturbance)], drawn.direction.x(), drawn.direction.y(),
      drawn.direction.z(), 1e3 * drawn.distance, 1e3 * drawn.duration, drawn.strength, drawn.hit_speed,
      drawn.keeps_press ? ", press kept" : "");
  return text;
}

std::string describe(const SweepResult& result) {
  if (result.refused) return "refused: " + result.refusal;
  char text[512];
  std::snprintf(text, sizeof text,
                "motion %.2f mm (twin %.2f, excess %.2f), speed %.3f m/s (twin %.3f), force %.2f N (forgiven %.2f), "
                "peak %.2f N, K %.0f/%.0f N/m%s%s",
                1e3 * result.motion, 1e3 * result.twin_motion, 1e3 * result.motion_excess, result.speed,
                result.twin_speed, result.force, std::max(0.0, result.forgiven_force), result.peak_force,
                result.guidance_stiffness, result.paper_stiffness, result.began ? ", writing" : "",
                result.acted ? "" : ", no force");
  return text;
}

}  // namespace calligraphy_test
