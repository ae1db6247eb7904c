#include <calligraphy/render/haptic_renderer.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/stiffness_advice.hpp>

#include "base/require.hpp"
#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// What is left of the guidance's damping where no spring acts, as long as the pen touches the paper: a pen that nobody
/// holds does not coast on.
constexpr double free_share = 0.15;

/// Least share of a stroke that finishes it, however much friction hides: well above half.
constexpr double min_coverage = 0.75;

/// Where guidance lets go of a pen: the tube's weight has fallen to this, or the hand is this far across [em].
constexpr double slipping_weight = 0.5, slipping_detour = 0.12;

/// guide_to_start leads a pen as near to the start along the stroke as this, as a share of the tolerance.
constexpr double unguided_start = 0.5;

/// A pen put down on the stroke this far along it is at its end.
constexpr double late_share = 0.75;

/// A closest point counts as an end of the stroke where the pen is this far from its normal, as a share of the
/// distance.
constexpr double oblique_share = 0.2, oblique_slack = 1e-5;

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
  if (!(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) <= PenSensor::max_coordinate)) {
    throw ValueError(place + "it reaches further than " + number_text(PenSensor::max_coordinate) + " m from the page's origin");
  }
}

/// @throws ValueError naming the character of the page that is invalid
std::vector<PlacedCharacter> checked(std::vector<PlacedCharacter> page) {
  if (page.empty()) throw ValueError("the page has no character");
  for (std::size_t i = 0; i < page.size(); ++i) require_valid(page[i], i);
  return page;
}

}  // namespace

HapticRenderer::HapticRenderer(std::vector<PlacedCharacter> page, const MotionMapping& mapping,
                               const Capabilities& capabilities, const RendererOptions& options)
    : page_(checked(std::move(page))),
      mapping_(mapping),
      effective_(effective_options(options, page_, mapping_, capabilities)),
      options_(effective_.options),
      sensor_(options_, mapping_),
      output_(options_, capabilities, mapping_, effective_.guidance_stiffness(effective_.max_attraction)) {
  for (const PlacedCharacter& placed : page_) {
    const double em = placed.placement.em;
    Eigen::AlignedBox2d box = bounding_box(placed);
    box.min().array() -= options.box_margin * em;
    box.max().array() += options.box_margin * em;
    prepared_.push_back({strokes(placed.character), stroke_starts(placed, options.tolerances), box, em});
  }
  period_ = 1.0 / options.servo_rate;
  fade_step_ = options.guidance_fade_in > 0.0 ? 1.0 / (options.guidance_fade_in * options.servo_rate) : 1.0;
  const double dry = capabilities.coulomb_friction + options_.friction.coefficient * usual_pressure;
  hidden_way_ = mapping.scale * dry / options.grip_stiffness;
  rate_filter_ = -std::expm1(-2.0 * std::numbers::pi * options.velocity_cutoff * period_);
  restart();
}

void HapticRenderer::restart() noexcept {
  tick_ = {};
  inside_box_ = false;
  lifted_ = true;
  sensor_.restart();
  output_.restart();
  release_friction();
  released_.clear();
  capture_.restart();
  held_ = false;
  activate(0, 0);
}

double HapticRenderer::max_force_step() const noexcept { return output_.max_step() * mapping_.scale; }

const HapticTick& HapticRenderer::update(const DeviceState& state) noexcept {
  tick_.events = TickEvent::none;
  tick_.time = state.time;
  const PenState& pen = sensor_.update(state);
  tick_.status = pen.status;
  tick_.device_point = pen.device_point;
  tick_.pen_tip = pen.tip;
  tick_.penetration = pen.penetration;
  output_.observe(state.force, pen);
  if (pen.status == TickStatus::ok) {
    follow(sense());
    send(sum_forces());
    return tick_;
  }
  if (pen.holds_force) {
    send(tick_.page_force);
    return tick_;
  }
  tick_.attraction = tick_.wrong_way = Point::Zero();
  tick_.viscous.setZero();
  tick_.normal = 0.0;
  released_.clear();
  release_friction();
  send(Eigen::Vector3d::Zero());
  return tick_;
}

TransitionInput HapticRenderer::sense() noexcept {
  const bool writing = tick_.state == InteractionState::writing;
  TransitionInput input;
  input.contact = sensor_.pen().contact;
  if (all_written()) return input;

  const Point tip = tick_.pen_tip.head<2>();
  const double em = active_character().em;
  const double slack = inside_box_ ? options_.box_hysteresis * em * (writing ? 3.0 : 1.0) : 0.0;
  inside_box_ = active_character().box.exteriorDistance(tip) <= slack;
  input.inside_box = inside_box_;
  input.may_start = may_start();
  if (writing) {
    write_on(tip, input);
  } else if (input.contact && input.may_start) {
    if (tick_.state == InteractionState::separation) put_down(tip);
    input.at_start = begins(tip);
  }
  return input;
}

void HapticRenderer::write_on(const Point& tip, TransitionInput& input) noexcept {
  const StrokeTolerances& tolerances = options_.tolerances;
  if (input.contact) {
    tick_.contact = active_.update(tip, options_.stroke);
    if (tick_.contact.passed_feature) tick_.events |= TickEvent::feature_passed;
    if (sensor_.pen().on_paper) {
      coverage_.update(tip, tick_.contact, active_.length(), tolerances.corridor * active_character().em);
    }
    tick_.covered = coverage_.share(active_.length());
  }
  const bool is_covered = tick_.covered >= needed_coverage() && coverage_.keeps_in_corridor();
  const bool leaves = !input.contact || !input.inside_box;
  input.stroke_finished = leaves ? is_covered && tolerances.coverage > 0.0 : is_covered && tick_.contact.finished;
}

/// A hand cannot help what dry friction hides, the device's and that of the paper, at both ends of a stroke.
double HapticRenderer::needed_coverage() const noexcept {
  const StrokeTolerances& tolerances = options_.tolerances;
  const double length = active_.length();
  if (!(length > 0.0)) return tolerances.coverage;
  const double late = tick_.contact.finished ? std::min(tolerances.late_start, coverage_.late() / length) : 0.0;
  const double needed = tolerances.coverage * (1.0 - late);
  return std::max(needed - 2.0 * hidden_way_ / length, std::min(needed, min_coverage));
}

void HapticRenderer::put_down(const Point& tip) noexcept {
  if (!has_event(tick_.events, TickEvent::stroke_finished)) tick_.covered = 0.0;
  capture_.put_down(tip, active_character().starts, static_cast<std::size_t>(tick_.stroke));
  if (options_.tolerances.coverage == 0.0) return;
  const StrokeContact nearest = active_.nearest(tip, options_.stroke);
  resting_ = nearest.closest.distance <= options_.tolerances.corridor * active_character().em;
  if (resting_) active_.rest(nearest);
}

bool HapticRenderer::begins(const Point& tip) noexcept {
  const PreparedCharacter& character = active_character();
  const CaptureVerdict verdict =
      capture_.update(tip, character.starts, static_cast<std::size_t>(tick_.stroke), character.em, options_.tolerances);
  if (verdict == CaptureVerdict::begun) return true;
  if (verdict == CaptureVerdict::another_stroke) resting_ = false;
  if (resting_) rest_ = active_.update(tip, options_.stroke);
  return false;
}

WritingHint HapticRenderer::hint() const noexcept {
  if (tick_.state == InteractionState::separation || all_written()) return WritingHint::none;
  if (tick_.state == InteractionState::writing) {
    const bool guided = held_ || has_event(tick_.events, TickEvent::stroke_started);
    return guided ? WritingHint::none : WritingHint::off_stroke;
  }
  if (!may_start()) return WritingHint::lift_first;
  if (capture_.verdict() == CaptureVerdict::another_stroke) return WritingHint::another_stroke;
  // The first stretch leads away from the start.
  const double put_down = (capture_.begin() - active_.start()).norm();
  const double from_start = std::min(tick_.to_start.norm(), put_down);
  const bool is_late = resting_ && rest_.arc > late_share * active_.length();
  if (is_late && (tick_.pen_tip.head<2>() - active_.end()).norm() < from_start) return WritingHint::at_end;
  if (from_start <= options_.tolerances.start_distance * active_character().em) {
    return capture_.verdict() == CaptureVerdict::wrong_direction ? WritingHint::wrong_direction : WritingHint::write;
  }
  return resting_ ? WritingHint::in_middle : WritingHint::too_far;
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
    if (!character_done_ && !all_written()) put_down(tick_.pen_tip.head<2>());
    resting_ = false;
  }
  if (after == InteractionState::writing && before != InteractionState::writing) {
    tick_.events |= TickEvent::stroke_started;
    active_.begin(capture_.begin());
    coverage_.restart(capture_.begin(), start_of_stroke());
    tick_.covered = 0.0;
    resting_ = false;
    TransitionInput written;
    written.contact = written.inside_box = true;
    write_on(tick_.pen_tip.head<2>(), written);
  }
  if (after == InteractionState::separation && before != InteractionState::separation) {
    tick_.events |= TickEvent::lift;
    lifted_ = true;
    if (character_done_) activate(tick_.character + 1, 0);
  }
  tick_.to_start = all_written() ? Point(Point::Zero()) : Point(active_.start() - tick_.pen_tip.head<2>());
  tick_.hint = hint();
}

void HapticRenderer::finish_stroke() noexcept {
  tick_.events |= TickEvent::stroke_finished;
  capture_.written(active_.start());
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
  if (character != tick_.character) {
    inside_box_ = false;
    capture_.restart();
  }
  tick_.character = character;
  tick_.stroke = stroke;
  character_done_ = resting_ = false;
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
  const double error = error_way_ > 0.0 ? std::sqrt(error_square_ / error_way_) / active_character().em : 0.0;
  tick_.assistance = policy.next(tick_.assistance, abandoned ? std::max(error, policy.full_assistance_error) : error);
}

Eigen::Vector3d HapticRenderer::sum_forces() noexcept {
  tick_.attraction = tick_.wrong_way = Point::Zero();
  tick_.viscous.setZero();
  const bool solid = tick_.state == InteractionState::calibration || tick_.state == InteractionState::writing ||
                     (tick_.state == InteractionState::adjusting && options_.solid_paper);
  tick_.normal = solid ? paper_force() : 0.0;
  Point in_plane = guidance_force();
  if (options_.friction.coefficient > 0.0) in_plane += friction_force();
  return {in_plane.x(), in_plane.y(), tick_.normal};
}

/// Eq. (9) and a damper, both of which set in over the first depth: the damper, because a touch would be a step; the
/// spring, so that it is never stiffer than the damper at that depth is good for. Paper does not pull, however fast the
/// pen is lifted.
double HapticRenderer::paper_force() noexcept {
  const double depth = tick_.penetration, onset = options_.paper_onset;
  const double share = depth < onset ? depth / onset : 1.0;
  const double strained = depth < onset ? 0.5 * depth * share : depth - 0.5 * onset;
  const double spring = normal_force(options_.paper_stiffness, strained, options_.force_sign);
  if (!(depth > 0.0)) return spring;
  const double damping = -share * options_.paper_damping * sensor_.pen().velocity.z();
  tick_.viscous.z() = spring >= 0.0 ? std::max(damping, -spring) : damping;
  return spring + tick_.viscous.z();
}

Point HapticRenderer::guidance_force() noexcept {
  const bool guides = is_guided();
  regrips_ = guides != held_;
  held_ = guides;
  if (tick_.state == InteractionState::separation || all_written()) return fade(Point::Zero());
  const Point tip = tick_.pen_tip.head<2>();
  const bool saturating = options_.guidance == GuidanceLaw::saturating;
  const bool writing = tick_.state == InteractionState::writing;
  const StrokeContact& contact = writing ? tick_.contact : rest_;
  Point way = Point::Zero();  // where guidance leads
  double share = 0.0;         // of guidance, in the stiffness and the damping
  double resistance = 0.0;    // to writing backwards, likewise
  if (writing) {
    way = contact.closest.point - tip;
    // A writer who began the stroke beyond its start may end it as far beyond its end.
    if (contact.finished) way -= std::min(0.0, way.dot(contact.closest.tangent)) * contact.closest.tangent;
    resistance = held_ ? contact.weight : 0.0;
    share = tick_.assistance * (saturating ? 1.0 : resistance);
    if (options_.assist.enabled) measure_error();
  } else {
    if (held_) way = way_to_begin();
    if (held_) share = tick_.assistance;
    if (resting_ && may_start()) resistance = contact.weight;
  }
  const double factor = writing ? contact.attraction : active_.first_attraction();
  const double stiffness = effective_.guidance_stiffness(factor);
  tick_.attraction = attraction_force(stiffness * share, tip, tip + way, options_.force_sign);
  if (factor < 1.0) share *= factor;
  const double slack = options_.wrong_way_slack * active_character().em;
  const bool resisted = resistance > 0.0 && contact.backwards > slack;
  if (resisted) {
    tick_.wrong_way = resistance * wrong_way_force(options_.wrong_way_stiffness, options_.wrong_way_limit, slack,
                                                   contact.backwards, contact.closest.tangent);
  }
  if (saturating) {
    const double linear = tick_.attraction.norm();
    tick_.attraction = saturated_force(tick_.attraction, options_.guidance_limit);
    // Less than the stiffness falls towards the stroke, as much as it falls around it.
    if (linear > 0.0) share *= std::sqrt(tick_.attraction.norm() / linear);
  }
  const Point velocity = sensor_.pen().velocity.head<2>();
  const Point tangent = writing ? contact.closest.tangent : held_ ? start_of_stroke().direction : Point(Point::Zero());
  // Resistance to writing backwards is not weakened by assistance, nor is its damper.
  const Point guided =
      resisted ? Point(std::max(share, resistance) * velocity) : Point(share * damped(velocity, way, tangent));
  tick_.viscous.head<2>() = -options_.guidance_damping * (guided + free_share * (velocity - guided));
  return fade(tick_.attraction + tick_.wrong_way + tick_.viscous.head<2>());
}

/// Guidance lets go, in time, of a pen that is far from the stroke or that the hand pulls elsewhere, and takes hold
/// again where both are back: a pen that slipped out of the tube would be thrown, and one that another stroke was meant
/// for would be dragged along. Before the stroke it leads a pen that is likely to begin it.
bool HapticRenderer::is_guided() const noexcept {
  if (tick_.state == InteractionState::writing) {
    if (options_.stroke.space.rule != ConstraintSpaceRule::tube || options_.guidance == GuidanceLaw::saturating)
      return true;
    if (has_event(tick_.events, TickEvent::stroke_started)) return true;
    const StrokeContact& contact = tick_.contact;
    const double em = active_character().em;
    const double astray = coverage_.astray(hand(), contact);
    if (held_) return contact.weight >= slipping_weight && astray <= slipping_detour * em;
    return contact.closest.distance <= options_.tolerances.corridor * em && astray <= 0.5 * slipping_detour * em;
  }
  if (tick_.state != InteractionState::calibration || !may_start()) return false;
  if (options_.guide_to_start) return capture_.verdict() != CaptureVerdict::another_stroke;
  return tick_.hint == WritingHint::write && capture_.is_nearest();
}

/// Where the hand means to be, as far as the force at work shows, if the device says what that is [m, page].
Point HapticRenderer::hand() const noexcept {
  const Point tip = tick_.pen_tip.head<2>();
  const Eigen::Vector3d& force = sensor_.pen().force;
  if (!force.allFinite()) return tip;
  return tip - force.head<2>() * (mapping_.scale * mapping_.scale / options_.grip_stiffness);
}

/// Until the first stretch has shown its direction, guidance acts across that direction only, so that it does not hide
/// it; with guide_to_start also along it, though not up to the start itself, which the pen is about to leave.
Point HapticRenderer::way_to_begin() const noexcept {
  const Point& direction = start_of_stroke().direction;
  const double along = tick_.to_start.dot(direction);
  const Point across = tick_.to_start - along * direction;
  if (!options_.guide_to_start) return across;
  const double free = unguided_start * options_.tolerances.start_distance * active_character().em;
  return across + std::copysign(std::max(0.0, std::abs(along) - free), along) * direction;
}

/// The part of a velocity that guidance damps: across the stroke. Along it the pen is free, except where guidance leads
/// that way too: before the start and at a corner that is not passed.
Point HapticRenderer::damped(const Point& velocity, const Point& way, const Point& tangent) const noexcept {
  const double along = std::abs(way.dot(tangent));
  const double oblique = std::min(1.0, along / (oblique_share * way.norm() + oblique_slack));
  return velocity - (1.0 - oblique) * velocity.dot(tangent) * tangent;
}

void HapticRenderer::release_friction() noexcept {
  tick_.friction = friction_spring_ = friction_rate_ = Point::Zero();
  friction_.release();
}

Point HapticRenderer::friction_force() noexcept {
  if (!(tick_.normal > 0.0)) {
    release_friction();
    return Point::Zero();
  }
  const FrictionOptions& friction = options_.friction;
  const double normal = std::max(0.0, tick_.page_force.z());  // the actual contact force of the hand
  const Point spring = friction_.update(friction, tick_.device_point.head<2>(), normal);
  // Damps the spring, not the pen: while the anchor slides along, the spring does not change.
  friction_rate_ += rate_filter_ * ((spring - friction_spring_) / period_ - friction_rate_);
  friction_spring_ = spring;
  const Point damping = friction.damping / friction.stiffness * friction_rate_;
  tick_.viscous.head<2>() += damping;
  tick_.friction = spring + damping;
  return tick_.friction;
}

/// Where the closest point jumps, at the start of a stroke and at a feature point, a spring that appears at once would
/// throw the pen, and so would one that vanishes at once where guidance ends: the old one is withdrawn in time while
/// the new one sets in.
Point HapticRenderer::fade(const Point& force) noexcept {
  constexpr TickEvent leaps = TickEvent::stroke_started | TickEvent::feature_passed | TickEvent::contact;
  constexpr TickEvent ends = TickEvent::stroke_finished | TickEvent::stroke_abandoned | TickEvent::lift;
  const bool lets_go = has_event(tick_.events, ends) || (regrips_ && !held_);
  const Point tip = tick_.pen_tip.head<2>(), velocity = sensor_.pen().velocity.head<2>();
  if (lets_go || regrips_ || has_event(tick_.events, leaps)) {
    const double seconds = lets_go ? options_.guidance_fade_out : options_.guidance_fade_in;
    released_.take_over(tick_.page_force.head<2>() - tick_.friction - tick_.damping.head<2>(), tip, velocity,
                        effective_.guidance_stiffness(1.0), options_.guidance_damping,
                        seconds / period_);
    faded_ = 0.0;
  }
  regrips_ = false;
  faded_ = std::min(1.0, faded_ + fade_step_);
  const double share = faded_ * faded_ * (3.0 - 2.0 * faded_);
  return released_.next(tip, velocity) + share * force;
}

void HapticRenderer::send(const Eigen::Vector3d& wanted) noexcept {
  const SentForce& sent = output_.update(sensor_.pen(), wanted, tick_.viscous);
  tick_.page_force = sent.page;
  tick_.force = sent.device;
  tick_.damping = sent.damping;
  tick_.energy_given = sent.energy_given;
  tick_.heat = sent.heat;
}

}  // namespace calligraphy
