#include <calligraphy/render/haptic_renderer.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "base/require.hpp"
#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// A pen farther from the page than this is a fault, whatever its speed [m].
constexpr double furthest_point = 1e3;

/// Minimum motion scale, and the inverse of the maximum; keeps every force finite.
constexpr double min_scale = 1e-6;

/// Maximum time over which eq. (3) integrates in one tick [s].
constexpr double max_tick = 0.1;

void require_valid(const PlacedCharacter& placed, std::size_t index) {
  const std::string place = "character " + std::to_string(index + 1) + " of the page: ";
  const std::vector<ValidationIssue> problems = validate(placed.character);
  if (!problems.empty()) {
    throw ValueError(place + "stroke " + std::to_string(problems[0].stroke) + ": " + problems[0].what);
  }
  const double em = placed.placement.em;
  require_above_zero(place + "em", em, "m");
  if (!placed.placement.origin.allFinite()) throw ValueError(place + "its origin is not finite");
  const Eigen::AlignedBox2d box = bounding_box(placed);
  if (!(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) <= furthest_point)) {
    throw ValueError(place + "it reaches further than " + std::to_string(furthest_point) + " m from the page's origin");
  }
}

void require_valid(const MotionMapping& mapping) {
  const bool rigid =
      mapping.rotation.allFinite() && mapping.rotation.isUnitary(1e-9) && mapping.rotation.determinant() > 0.0;
  if (!rigid) throw ValueError("motion mapping: rotation is not a rotation matrix");
  if (!mapping.offset.allFinite()) throw ValueError("motion mapping: offset is not finite");
  require_within("motion mapping: scale", mapping.scale, "", min_scale, 1.0 / min_scale);
}

/// In page axes, where forces are 1 / scale times those of the device, masses and damping 1 / scale^2 times
/// (MotionMapping).
PassivityController passivity_controller(const RendererOptions& options, const Capabilities& capabilities,
                                         double scale) {
  const double period = 1.0 / options.servo_rate;
  PassivityOptions passivity;
  passivity.delay = capabilities.sample_delay;
  if (options.passivity_control) {
    passivity.max_damping = injectable_damping({capabilities, options.servo_rate}) / (scale * scale);
  }
  passivity.energy_budget = options.energy_budget;
  if (options.limit_force_rate) {
    passivity.force_rate = std::min(options.in_plane_force_rate, options.normal_force_rate) / scale;
  }
  return PassivityController(passivity, period);
}

}  // namespace

HapticRenderer::HapticRenderer(std::vector<PlacedCharacter> page, const MotionMapping& mapping,
                               const Capabilities& capabilities, const RendererOptions& options)
    : page_(std::move(page)), mapping_(mapping), options_(options) {
  if (page_.empty()) throw ValueError("the page has no character");
  double max_attraction = 1.0;
  for (std::size_t i = 0; i < page_.size(); ++i) {
    require_valid(page_[i], i);
    const auto& factors = page_[i].character.physics.attraction_factors;
    max_attraction = std::max(max_attraction, *std::max_element(factors.begin(), factors.end()));
    Eigen::AlignedBox2d box = bounding_box(page_[i]);
    box.min().array() -= options.box_margin;
    box.max().array() += options.box_margin;
    prepared_.push_back({strokes(page_[i].character), box});
  }
  require_valid(mapping);
  if (options_.stiffness_check == StiffnessCheck::clip) {
    clipped_ = clip_stiffness(options_, capabilities, max_attraction, mapping.scale);
  }
  validate(options_, capabilities, max_attraction, mapping.scale);
  require_translations(capabilities, "the renderer");
  require(capabilities.peak_force > 0.0, "peak force of the device", capabilities.peak_force, "N", "above 0");
  fade_step_ = options.guidance_fade_in > 0.0 ? 1.0 / (options.guidance_fade_in * options.servo_rate) : 1.0;
  limiter_.in_plane_step = options.in_plane_force_rate / options.servo_rate / mapping.scale;
  limiter_.normal_step = options.normal_force_rate / options.servo_rate / mapping.scale;
  limiter_.peak = capabilities.peak_force / mapping.scale;
  limiter_.limit_rate = options.limit_force_rate;
  const double period = 1.0 / options.servo_rate;
  limiter_.jerk = options.force_jerk * period * period / mapping.scale;
  observes_energy_ = options.passivity_control || std::isfinite(options.energy_budget);
  if (observes_energy_) passivity_ = passivity_controller(options, capabilities, mapping.scale);
  if (options.thermal_time_constant > 0.0) {
    thermal_.peak = limiter_.peak;
    thermal_.continuous = std::min(capabilities.continuous_force, capabilities.peak_force) / mapping.scale;
    thermal_.time_constant = options.thermal_time_constant;
  }
  restart();
}

void HapticRenderer::restart() noexcept {
  tick_ = {};
  inside_box_ = false;
  lifted_ = true;
  has_sample_ = false;
  has_rejected_ = false;
  limiter_.last_step.setZero();
  passivity_.restart();
  thermal_.heat = 0.0;
  friction_.release();
  activate(0, 0);
}

double HapticRenderer::max_force_step() const noexcept { return limiter_.max_step() * mapping_.scale; }

const HapticTick& HapticRenderer::update(const DeviceState& state) noexcept {
  tick_.events = TickEvent::none;
  tick_.time = state.time;
  tick_.status = map_sample(state);
  if (tick_.status == TickStatus::ok) {
    follow(sense());
    send(sum_forces());
  } else {
    tick_.attraction = tick_.wrong_way = tick_.friction = Point::Zero();
    tick_.normal = 0.0;
    friction_.release();
    send(Eigen::Vector3d::Zero());
  }
  return tick_;
}

TickStatus HapticRenderer::map_sample(const DeviceState& state) noexcept {
  const bool usable = state.status == DeviceStatus::ok || state.status == DeviceStatus::stale ||
                      state.status == DeviceStatus::warm_motors;
  if (!usable) return TickStatus::device_fault;
  if (!state.position.allFinite() || !std::isfinite(state.time)) return TickStatus::bad_sample;
  const Eigen::Vector3d mapped = mapping_.to_page(state.position);
  if (!(mapped.cwiseAbs().maxCoeff() <= furthest_point)) return TickStatus::bad_sample;
  if (!plausible(mapped, state.time)) {
    has_rejected_ = true;
    rejected_position_ = mapped;
    return TickStatus::bad_sample;
  }

  if (options_.motion == MotionMappingRule::wang2006 && has_sample_) {
    const double elapsed = std::clamp(state.time - last_time_, 0.0, max_tick);
    const Eigen::Vector3d velocity = mapping_.velocity_to_page(state.velocity);
    const bool measured = norm(velocity) <= options_.max_speed;  // false for NaN too
    tick_.device_point += measured ? Eigen::Vector3d(velocity * elapsed) : Eigen::Vector3d(mapped - last_position_);
  } else {
    tick_.device_point = mapped;
  }
  has_sample_ = true;
  has_rejected_ = false;
  last_position_ = mapped;
  last_time_ = state.time;
  return TickStatus::ok;
}

/// A pen cannot jump: a single sample far away is rejected. A second one near the first is accepted, because then the
/// device really is elsewhere.
bool HapticRenderer::plausible(const Eigen::Vector3d& position, double time) const noexcept {
  if (!has_sample_) return true;
  const double period = 1.0 / options_.servo_rate;
  const double reach = options_.max_speed * std::max(time - last_time_, period);
  if (norm(position - last_position_) <= reach) return true;
  return has_rejected_ && norm(position - rejected_position_) <= options_.max_speed * period;
}

TransitionInput HapticRenderer::sense() noexcept {
  const Eigen::Vector3d& point = tick_.device_point;
  const bool was_in_contact = tick_.state != InteractionState::separation;
  const bool writing = tick_.state == InteractionState::writing;
  TransitionInput input;
  input.contact = point.z() <= (was_in_contact ? options_.lift_height : 0.0);

  tick_.penetration = std::max(0.0, -point.z());
  tick_.pen_tip = point;
  if (options_.pen_tip == PenTipRule::projected && point.z() < 0.0) tick_.pen_tip.z() = 0.0;
  if (all_written()) return input;

  const Point tip = tick_.pen_tip.head<2>();
  const double slack = inside_box_ ? options_.box_hysteresis * (writing ? 3.0 : 1.0) : 0.0;
  inside_box_ = active_character().box.exteriorDistance(tip) <= slack;
  input.inside_box = inside_box_;
  input.may_start = may_start();
  if (!input.contact) return input;
  if (writing) {
    tick_.contact = active_.update(tip, options_.stroke);
    input.stroke_finished = tick_.contact.finished;
    if (tick_.contact.passed_feature) tick_.events |= TickEvent::feature_passed;
  } else if (input.may_start) {
    input.at_start = active_.begins_at(tip, options_.start_radius);
  }
  return input;
}

void HapticRenderer::follow(const TransitionInput& input) noexcept {
  const InteractionState before = tick_.state;
  const InteractionState after = next_state(before, input);
  tick_.state = after;
  if (after != InteractionState::separation && before == InteractionState::separation) {
    tick_.events |= TickEvent::contact;
  }
  if (before == InteractionState::writing && after != InteractionState::writing) {
    if (options_.assist.enabled) adapt_assistance(!input.stroke_finished);
    if (input.stroke_finished) {
      finish_stroke();
    } else {
      active_.reload();
      tick_.events |= TickEvent::stroke_abandoned;
    }
  }
  if (after == InteractionState::writing && before != InteractionState::writing) {
    tick_.events |= TickEvent::stroke_started;
    tick_.contact = active_.update(tick_.pen_tip.head<2>(), options_.stroke);
    if (tick_.contact.passed_feature) tick_.events |= TickEvent::feature_passed;
  }
  if (after == InteractionState::separation && before != InteractionState::separation) {
    tick_.events |= TickEvent::lift;
    lifted_ = true;
    if (character_done_) activate(tick_.character + 1, 0);
  }
}

void HapticRenderer::finish_stroke() noexcept {
  tick_.events |= TickEvent::stroke_finished;
  lifted_ = false;
  const int next = tick_.stroke + 1;
  if (next < static_cast<int>(active_character().strokes.size())) {
    activate(tick_.character, next);
    return;
  }
  tick_.events |= TickEvent::character_finished;
  if (tick_.character + 1 == static_cast<int>(page_.size())) tick_.events |= TickEvent::page_finished;
  if (options_.lift_between_strokes) {
    // The box of the next character is elsewhere, and outside a box the paper does not press back: it would give way
    // under a pen that still rests on this character.
    tick_.stroke = next;
    character_done_ = true;
  } else {
    activate(tick_.character + 1, 0);
  }
}

void HapticRenderer::activate(int character, int stroke) noexcept {
  if (character != tick_.character) inside_box_ = false;
  tick_.character = character;
  tick_.stroke = stroke;
  character_done_ = false;
  if (all_written()) return;
  active_.load(active_character().strokes[static_cast<std::size_t>(stroke)],
               page_[static_cast<std::size_t>(character)].placement);
}

void HapticRenderer::measure_error() noexcept {
  const Point tip = tick_.pen_tip.head<2>();
  if (has_event(tick_.events, TickEvent::stroke_started)) {
    error_square_ = error_way_ = 0.0;
    error_tip_ = tip;
  }
  const double way = (tip - error_tip_).norm();
  error_square_ += way * tick_.contact.closest.distance * tick_.contact.closest.distance;
  error_way_ += way;
  error_tip_ = tip;
}

void HapticRenderer::adapt_assistance(bool abandoned) noexcept {
  const AssistPolicy& policy = options_.assist;
  const double error = error_way_ > 0.0 ? std::sqrt(error_square_ / error_way_) : 0.0;
  tick_.assistance = policy.next(tick_.assistance, abandoned ? std::max(error, policy.full_assistance_error) : error);
}

Eigen::Vector3d HapticRenderer::sum_forces() noexcept {
  tick_.attraction = tick_.wrong_way = Point::Zero();
  tick_.normal = 0.0;
  const bool solid = tick_.state == InteractionState::calibration || tick_.state == InteractionState::writing ||
                     (tick_.state == InteractionState::adjusting && options_.solid_paper);
  if (solid) tick_.normal = normal_force(options_.paper_stiffness, tick_.penetration, options_.force_sign);
  Point in_plane = guidance_force();
  if (options_.friction.coefficient > 0.0) in_plane += friction_force();
  return {in_plane.x(), in_plane.y(), tick_.normal};
}

Point HapticRenderer::guidance_force() noexcept {
  const Point tip = tick_.pen_tip.head<2>();
  const double stiffness = options_.guidance_stiffness * tick_.assistance;
  const bool saturating = options_.guidance == GuidanceLaw::saturating;
  const bool writing = tick_.state == InteractionState::writing;
  if (writing) {
    const StrokeContact& contact = tick_.contact;
    const double share = saturating ? contact.attraction : contact.attraction * contact.weight;
    tick_.attraction = attraction_force(stiffness * share, tip, contact.closest.point, options_.force_sign);
    tick_.wrong_way =
        contact.weight * wrong_way_force(options_.wrong_way_stiffness, options_.wrong_way_limit,
                                         options_.wrong_way_slack, contact.backwards, contact.closest.tangent);
    if (options_.assist.enabled) measure_error();
  } else if (options_.guide_to_start && tick_.state == InteractionState::calibration && may_start()) {
    tick_.attraction = attraction_force(stiffness, tip, active_.start(), options_.force_sign);
  } else {
    return Point::Zero();
  }
  if (saturating) tick_.attraction = saturated_force(tick_.attraction, options_.guidance_limit);
  return fade(tick_.attraction + tick_.wrong_way);
}

Point HapticRenderer::friction_force() noexcept {
  if (tick_.normal > 0.0) {
    const double normal = std::max(0.0, tick_.page_force.z());  // the actual contact force of the hand
    tick_.friction =
        friction_.update(options_.friction, tick_.device_point.head<2>(), normal, 1.0 / options_.servo_rate);
  } else {
    tick_.friction = Point::Zero();
    friction_.release();
  }
  return tick_.friction;
}

/// Where the closest point jumps, at the start of a stroke and at a feature point, a spring that appears at once would
/// throw the pen: during the fade-in the force passes from its previous value to the new one.
Point HapticRenderer::fade(const Point& force) noexcept {
  constexpr TickEvent leaps =
      TickEvent::stroke_started | TickEvent::feature_passed | TickEvent::contact | TickEvent::stroke_abandoned;
  if (has_event(tick_.events, leaps)) {
    fade_from_ = tick_.page_force.head<2>() - tick_.friction - tick_.damping.head<2>();
    faded_ = 0.0;
  }
  faded_ = std::min(1.0, faded_ + fade_step_);
  const double share = faded_ * faded_ * (3.0 - 2.0 * faded_);
  return fade_from_ + share * (force - fade_from_);
}

/// The last stages, in this order: passivity, direction-preserving saturation, rate and jerk, energy and heat of the
/// force sent.
void HapticRenderer::send(const Eigen::Vector3d& wanted) noexcept {
  const Eigen::Vector3d force = observes_energy_ ? control_passivity(wanted) : wanted;
  double longest = observes_energy_ ? passivity_.max_force() : ForceLimiter::no_limit;
  if (thermal_.peak > 0.0) longest = std::min(longest, thermal_.max_force());
  const bool trusted = tick_.status == TickStatus::ok;
  tick_.page_force = trusted ? limiter_.next(tick_.page_force, force, longest) : limiter_.release(tick_.page_force);
  if (observes_energy_) passivity_.sent(tick_.page_force);
  if (thermal_.peak > 0.0) {
    thermal_.held(norm(tick_.page_force), 1.0 / options_.servo_rate);
    tick_.heat = thermal_.heat;
  }
  tick_.force = mapping_.force_to_device(tick_.page_force);
}

Eigen::Vector3d HapticRenderer::control_passivity(const Eigen::Vector3d& wanted) noexcept {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const bool known = tick_.status == TickStatus::ok;
  Eigen::Vector3d force = passivity_.next(known ? last_position_ : Eigen::Vector3d(unknown, unknown, unknown), wanted);
  // Paper does not pull, however fast the pen is lifted.
  if (wanted.z() >= 0.0) force.z() = std::max(0.0, force.z());
  tick_.damping = passivity_.damping();
  tick_.energy_given = passivity_.energy_given();
  return force;
}

}  // namespace calligraphy
