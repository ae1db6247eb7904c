#include "stiffness_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <calligraphy/render/renderer_options.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "base/require.hpp"
#include "effective_options.hpp"

namespace calligraphy {
namespace {

/// Mass assumed of a device that states none, with a margin: the lightest of the shipped profiles weighs 45 g [kg].
constexpr double presumed_mass = 0.02;

/// Minimum share of friction, if it asks for as much, in what guidance and friction may be together.
constexpr double friction_share = 0.35;
constexpr double min_friction_stiffness = 1.0;  ///< below this there is no friction [N/m]

/// Relative tolerance: what has been clipped must not be clipped again because of rounding.
constexpr double slack = 1e-9;

/// Maximum force of a damper for one encoder step, unless Coulomb friction holds more [N].
constexpr double max_damper_click = 0.1;

struct StiffnessLimit {
  double value;  ///< [N/m]
  std::string reason;
};

StiffnessLimit usable_stiffness(const Capabilities& capabilities) {
  if (!(capabilities.usable_stiffness > 0.0 && capabilities.usable_stiffness < max_stiffness)) {
    return {max_stiffness, "at most 1e6 N/m are accepted"};
  }
  Message reason;
  reason << "the device " << capabilities.model << " is usable up to " << capabilities.usable_stiffness << " N/m";
  return {capabilities.usable_stiffness, reason.str()};
}

/// Rounded to single precision: the last bits, which differ between implementations of libm, reach no force.
double without_last_bits(double stiffness) { return static_cast<float>(stiffness); }

/// How stiff the springs of a page may be, given the loop that renders them.
class Limits {
 public:
  Limits(const RendererOptions& options, const Capabilities& capabilities, double scale)
      : square_(scale * scale),
        is_off_(options.stiffness_check == StiffnessCheck::off),
        cutoff_(options.velocity_cutoff),
        usable_(usable_stiffness(is_off_ ? Capabilities() : capabilities)) {
    loop_.device = capabilities;
    loop_.device.apparent_mass = capabilities.apparent_mass > 0.0 ? capabilities.apparent_mass : presumed_mass;
    loop_.rate = servo_rate(options, capabilities);
    if (scale != 1.0) {
      Message enlarged;
      enlarged << " times the square of the motion scale " << scale;
      enlarged_ = enlarged.str();
    }
  }

  /// Limits of a stiffness on the page next to `damping` on the page [N/m].
  StiffnessLimit usable() const { return {usable_.value / square_, enlarged_ + ": " + usable_.reason}; }
  StiffnessLimit stable(double damping) const {
    if (is_off_) return {std::numeric_limits<double>::infinity(), ""};
    const double value = stable_on_device(damping * square_);
    Message reason;
    reason << enlarged_ << ": with a damping of " << damping * square_ << " N s/m at " << loop_.rate << " Hz";
    if (loop_.device.sample_delay > 0) reason << " and a delay of " << loop_.device.sample_delay << " ticks";
    reason << " the device " << device_label(loop_.device) << " is stable in any hand up to " << value
           << " N/m (stiffness_for_any_hand)" << (damping > 0.0 ? "" : ": without damping no spring is");
    return {value / square_, reason.str()};
  }
  StiffnessLimit both(double damping) const {
    const StiffnessLimit one = usable(), other = stable(damping);
    return one.value < other.value ? one : other;
  }
  /// The highest damping, at most that wanted, that permits `stiffness` in addition to a damping `beside`; if none
  /// does, the one that permits most, or 0 if none permits any: it would drive the pen by itself [N s/m, page].
  double best_damping(double wanted, double stiffness, double beside) const {
    const double needed = std::min(stiffness, usable().value);
    const auto permitted = [&](double damping) { return is_safe(damping) ? stable(damping + beside).value : -1.0; };
    if (is_off_ || wanted == 0.0 || permitted(wanted) >= (1.0 - slack) * needed) return wanted;
    double best = 0.0, most = 0.0, too_strong = wanted;
    for (const double share : {1.0, 0.75, 0.5, 0.35, 0.25, 0.15, 0.08, 0.04}) {
      const double value = permitted(share * wanted);
      if (value > most) {
        most = value;
        best = share * wanted;
      }
      if (value >= needed) break;
      too_strong = share * wanted;
    }
    if (most < needed || best == 0.0) return best;
    for (int halving = 0; halving < 8; ++halving) {
      const double middle = 0.5 * (best + too_strong);
      (permitted(middle) >= needed ? best : too_strong) = middle;
    }
    return without_last_bits(best);
  }

 private:
  /// Whether the damper alone drives no motion, through the lag of the loop or the encoder steps.
  bool is_safe(double damping) const {
    constexpr double almost_nothing = 1e-3;  // [N/m]
    SampledLoop loop = loop_;
    loop.wall_damping = damping * square_;
    const double passed = -std::expm1(-2.0 * std::numbers::pi * cutoff_ / loop.rate);
    const double click = loop.wall_damping * loop.device.encoder_step * passed * loop.rate;
    return click <= std::max(max_damper_click, loop.device.coulomb_friction) &&
           stiffness_for_any_hand(loop, cutoff_, almost_nothing) >= almost_nothing;
  }
  double stable_on_device(double damping) const {
    SampledLoop loop = loop_;
    loop.wall_damping = damping;
    return without_last_bits(stiffness_for_any_hand(loop, cutoff_, max_stiffness));
  }

  double square_;  ///< of the motion scale
  bool is_off_;
  double cutoff_;
  StiffnessLimit usable_;
  SampledLoop loop_;
  std::string enlarged_;
};

}  // namespace

std::vector<std::string> clip_stiffness(RendererOptions& options, const Capabilities& capabilities, double scale) {
  require_within("velocity_cutoff", options.velocity_cutoff, "Hz", 5.0, 1e6,
                 "a slower filter knows the velocity too late to damp a spring that a hand would feel");
  require_above_zero("scale", scale, "");
  const Limits limits(options, capabilities, scale);
  std::vector<std::string> clipped;
  const auto clip = [&](const char* name, double& stiffness, const StiffnessLimit& limit) {
    require_not_negative(name, stiffness, "N/m");
    if (stiffness <= limit.value * (1.0 + slack)) return;
    Message message;
    message << name << " = " << stiffness << " N/m" << limit.reason;
    clipped.push_back(message.str());
    stiffness = limit.value;
  };
  const auto clip_damping = [&](const char* name, double& damping, double stiffness, double beside = 0.0) {
    require_within(name, damping, "N s/m", 0.0, max_damping);
    const double best = limits.best_damping(damping, stiffness, beside);
    if (best == damping) return;
    Message message;
    message << name << " = " << damping << " N s/m: too strong for the lag or the encoder of this loop, at most "
            << best << " N s/m beside " << stiffness << " N/m";
    clipped.push_back(message.str());
    damping = best;
  };
  clip_damping("paper.damping", options.paper.damping, options.paper.stiffness);
  clip("paper.stiffness", options.paper.stiffness, limits.both(options.paper.damping));
  clip_damping("guidance.damping", options.guidance.damping, options.guidance.stiffness);
  const StiffnessLimit guidance = limits.both(options.guidance.damping);
  clip("guidance.stiffness", options.guidance.stiffness, guidance);
  clip("guidance.wrong_way_stiffness", options.guidance.wrong_way_stiffness, guidance);
  if (options.paper.friction.coefficient > 0.0) {
    FrictionOptions& friction = options.paper.friction;
    // `usable_stiffness` applies to each of the two springs, one along the stroke and one across; stability requires
    // counting both.
    const double both = options.guidance.stiffness + friction.stiffness;
    clip_damping("paper.friction.damping", friction.damping, both, options.guidance.damping);
    const StiffnessLimit alone = limits.both(friction.damping);
    const StiffnessLimit sum = limits.stable(options.guidance.damping + friction.damping);
    if (std::min(alone.value, friction_share * sum.value) < min_friction_stiffness) {
      Message message;
      message << "paper.friction.coefficient = " << friction.coefficient << sum.reason << ", too soft for friction";
      clipped.push_back(message.str());
      friction.coefficient = 0.0;
      return clipped;
    }
    clip("paper.friction.stiffness", friction.stiffness, alone);
    Message reason;
    reason << " in addition to " << options.guidance.stiffness << " N/m of guidance" << sum.reason;
    clip("paper.friction.stiffness", friction.stiffness,
         {std::max(sum.value - options.guidance.stiffness, friction_share * sum.value), reason.str()});
    Message of_friction;
    of_friction << " in addition to " << friction.stiffness << " N/m of friction" << sum.reason;
    clip("guidance.stiffness", options.guidance.stiffness, {sum.value - friction.stiffness, of_friction.str()});
  }
  return clipped;
}

double max_guidance_stiffness(const RendererOptions& options, const Capabilities& capabilities, double scale) {
  const Limits limits(options, capabilities, scale);
  double most = limits.both(options.guidance.damping).value;
  if (options.paper.friction.coefficient > 0.0) {
    const double sum = limits.stable(options.guidance.damping + options.paper.friction.damping).value;
    most = std::min(most, sum - options.paper.friction.stiffness);
  }
  return most;
}

}  // namespace calligraphy
