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

/// Least share of a stroke that finishes it, however much friction hides: well above half.
constexpr double min_coverage = 0.75;

/// Where guidance lets go of a pen: the tube's weight has fallen to this, or the hand is this far across [em].
constexpr double slipping_weight = 0.5, slipping_detour = 0.12;

/// A pen put down on the stroke this far along it is at its end.
constexpr double late_share = 0.75;

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
      guidance_(effective_),
      paper_(options_),
      output_(options_, capabilities, mapping_, effective_.guidance_stiffness(effective_.max_attraction)) {
  for (const PlacedCharacter& placed : page_) {
    const double em = placed.placement.em;
    Eigen::AlignedBox2d box = bounding_box(placed);
    box.min().array() -= options.box_margin * em;
    box.max().array() += options.box_margin * em;
    prepared_.push_back({strokes(placed.character), stroke_starts(placed, options.tolerances), box, em});
  }
  const double dry = capabilities.coulomb_friction + options_.friction.coefficient * usual_pressure;
  hidden_way_ = mapping.scale * dry / options.grip_stiffness;
  restart();
}

void HapticRenderer::restart() noexcept {
  tick_ = {};
  writer_ = {};
  inside_box_ = false;
  lifted_ = true;
  sensor_.restart();
  output_.restart();
  paper_.release();
  guidance_.restart();
  capture_.restart();
  activate(0, 0);
}

double HapticRenderer::max_force_step() const noexcept { return output_.max_step() * mapping_.scale; }

const HapticTick& HapticRenderer::update(const DeviceState& state) noexcept {
  tick_.events = writer_.events = TickEvent::none;
  tick_.time = state.time;
  const PenState& pen = sensor_.update(state);
  tick_.status = pen.status;
  tick_.device_point = pen.device_point;
  tick_.pen_tip = pen.tip;
  tick_.penetration = pen.penetration;
  output_.observe(state.force, pen);
  if (pen.status == TickStatus::ok) {
    follow(sense());
    const SentForce& sent = output_.last();
    const Point guidance_sent = sent.page.head<2>() - paper_.last().friction - sent.damping.head<2>();
    const GuidanceForce& guidance = guidance_.update(pen, writer_, guidance_sent);
    const PaperForce& paper = paper_.update(pen, writer_, sent.page.z());
    tick_.attraction = guidance.attraction;
    tick_.wrong_way = guidance.wrong_way;
    tick_.assistance = guidance_.assistance();
    tick_.normal = paper.normal;
    tick_.friction = paper.friction;
    tick_.viscous = paper.viscous;
    tick_.viscous.head<2>() += guidance.viscous;
    const Point in_plane = guidance.total + paper.friction;
    send({in_plane.x(), in_plane.y(), paper.normal});
    return tick_;
  }
  if (pen.holds_force) {
    send(tick_.page_force);
    return tick_;
  }
  guidance_.release();
  paper_.release();
  tick_.attraction = tick_.wrong_way = tick_.friction = Point::Zero();
  tick_.viscous.setZero();
  tick_.normal = 0.0;
  send(Eigen::Vector3d::Zero());
  return tick_;
}

TransitionInput HapticRenderer::sense() noexcept {
  const bool writing = writer_.state == InteractionState::writing;
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
    if (writer_.state == InteractionState::separation) put_down(tip);
    input.at_start = begins(tip);
  }
  return input;
}

void HapticRenderer::write_on(const Point& tip, TransitionInput& input) noexcept {
  const StrokeTolerances& tolerances = options_.tolerances;
  if (input.contact) {
    writer_.contact = active_.update(tip, options_.stroke);
    if (writer_.contact.passed_feature) writer_.events |= TickEvent::feature_passed;
    if (sensor_.pen().on_paper) {
      coverage_.update(tip, writer_.contact, active_.length(), tolerances.corridor * active_character().em);
    }
    writer_.covered = coverage_.share(active_.length());
  }
  const bool is_covered = writer_.covered >= needed_coverage() && coverage_.keeps_in_corridor();
  const bool leaves = !input.contact || !input.inside_box;
  input.stroke_finished = leaves ? is_covered && tolerances.coverage > 0.0 : is_covered && writer_.contact.finished;
}

/// A hand cannot help what dry friction hides, the device's and that of the paper, at both ends of a stroke.
double HapticRenderer::needed_coverage() const noexcept {
  const StrokeTolerances& tolerances = options_.tolerances;
  const double length = active_.length();
  if (!(length > 0.0)) return tolerances.coverage;
  const double late = writer_.contact.finished ? std::min(tolerances.late_start, coverage_.late() / length) : 0.0;
  const double needed = tolerances.coverage * (1.0 - late);
  return std::max(needed - 2.0 * hidden_way_ / length, std::min(needed, min_coverage));
}

void HapticRenderer::put_down(const Point& tip) noexcept {
  if (!has_event(writer_.events, TickEvent::stroke_finished)) writer_.covered = 0.0;
  capture_.put_down(tip, active_character().starts, static_cast<std::size_t>(writer_.stroke));
  if (options_.tolerances.coverage == 0.0) return;
  const StrokeContact nearest = active_.nearest(tip, options_.stroke);
  writer_.rests = nearest.closest.distance <= options_.tolerances.corridor * active_character().em;
  if (writer_.rests) active_.rest(nearest);
}

bool HapticRenderer::begins(const Point& tip) noexcept {
  const PreparedCharacter& character = active_character();
  const CaptureVerdict verdict =
      capture_.update(tip, character.starts, static_cast<std::size_t>(writer_.stroke), character.em, options_.tolerances);
  if (verdict == CaptureVerdict::begun) return true;
  if (verdict == CaptureVerdict::another_stroke) writer_.rests = false;
  if (writer_.rests) writer_.contact = active_.update(tip, options_.stroke);
  return false;
}

WritingHint HapticRenderer::hint() const noexcept {
  if (writer_.state == InteractionState::separation || all_written()) return WritingHint::none;
  if (writer_.state == InteractionState::writing) {
    const bool guided = writer_.guided || has_event(writer_.events, TickEvent::stroke_started);
    return guided ? WritingHint::none : WritingHint::off_stroke;
  }
  if (!may_start()) return WritingHint::lift_first;
  if (capture_.verdict() == CaptureVerdict::another_stroke) return WritingHint::another_stroke;
  // The first stretch leads away from the start.
  const double put_down = (capture_.begin() - active_.start()).norm();
  const double from_start = std::min(writer_.to_start.norm(), put_down);
  const bool is_late = writer_.rests && writer_.contact.arc > late_share * active_.length();
  if (is_late && (tick_.pen_tip.head<2>() - active_.end()).norm() < from_start) return WritingHint::at_end;
  if (from_start <= options_.tolerances.start_distance * active_character().em) {
    return capture_.verdict() == CaptureVerdict::wrong_direction ? WritingHint::wrong_direction : WritingHint::write;
  }
  return writer_.rests ? WritingHint::in_middle : WritingHint::too_far;
}

void HapticRenderer::follow(const TransitionInput& input) noexcept {
  const InteractionState before = writer_.state;
  const InteractionState after = next_state(before, input);
  writer_.state = after;
  if (after != InteractionState::separation && before == InteractionState::separation) {
    writer_.events |= TickEvent::contact;
  }
  if (before == InteractionState::writing && after != InteractionState::writing) {
    if (input.stroke_finished) {
      finish_stroke();
    } else {
      active_.reload();
      writer_.events |= TickEvent::stroke_abandoned;
    }
    if (!character_done_ && !all_written()) put_down(tick_.pen_tip.head<2>());
    writer_.rests = false;
  }
  if (after == InteractionState::writing && before != InteractionState::writing) {
    writer_.events |= TickEvent::stroke_started;
    active_.begin(capture_.begin());
    coverage_.restart(capture_.begin(), start_of_stroke());
    writer_.covered = 0.0;
    writer_.rests = false;
    TransitionInput written;
    written.contact = written.inside_box = true;
    write_on(tick_.pen_tip.head<2>(), written);
  }
  if (after == InteractionState::separation && before != InteractionState::separation) {
    writer_.events |= TickEvent::lift;
    lifted_ = true;
    if (character_done_) activate(writer_.character + 1, 0);
  }
  writer_.to_start = all_written() ? Point(Point::Zero()) : Point(active_.start() - tick_.pen_tip.head<2>());
  writer_.page_written = all_written();
  if (!all_written()) {
    writer_.em = active_character().em;
    writer_.direction = start_of_stroke().direction;
    writer_.attraction =
        after == InteractionState::writing ? writer_.contact.attraction : active_.first_attraction();
  }
  writer_.guided = is_guided();
  tick_.hint = hint();
  tick_.state = writer_.state;
  tick_.events = writer_.events;
  tick_.character = writer_.character;
  tick_.stroke = writer_.stroke;
  tick_.contact = writer_.contact;
  tick_.covered = writer_.covered;
  tick_.to_start = writer_.to_start;
}

void HapticRenderer::finish_stroke() noexcept {
  writer_.events |= TickEvent::stroke_finished;
  capture_.written(active_.start());
  lifted_ = false;
  const int next = writer_.stroke + 1;
  if (next < static_cast<int>(active_character().strokes.size())) {
    activate(writer_.character, next);
    return;
  }
  writer_.events |= TickEvent::character_finished;
  if (writer_.character + 1 == static_cast<int>(page_.size())) writer_.events |= TickEvent::page_finished;
  if (options_.lift_between_strokes) {
    // The box of the next character is elsewhere, and outside a box the paper does not press back: it would give way
    // under a pen that still rests on this character.
    writer_.stroke = next;
    character_done_ = true;
  } else {
    activate(writer_.character + 1, 0);
  }
}

void HapticRenderer::activate(int character, int stroke) noexcept {
  if (character != writer_.character) {
    inside_box_ = false;
    capture_.restart();
  }
  writer_.character = character;
  writer_.stroke = stroke;
  character_done_ = writer_.rests = false;
  if (all_written()) return;
  active_.load(active_character().strokes[static_cast<std::size_t>(stroke)],
               page_[static_cast<std::size_t>(character)].placement);
}

/// Guidance lets go, in time, of a pen that is far from the stroke or that the hand pulls elsewhere, and takes hold
/// again where both are back: a pen that slipped out of the tube would be thrown, and one that another stroke was meant
/// for would be dragged along. Before the stroke it leads a pen that is likely to begin it.
bool HapticRenderer::is_guided() const noexcept {
  if (writer_.state == InteractionState::writing) {
    if (options_.stroke.space.rule != ConstraintSpaceRule::tube || options_.guidance == GuidanceLaw::saturating)
      return true;
    if (has_event(writer_.events, TickEvent::stroke_started)) return true;
    const StrokeContact& contact = writer_.contact;
    const double em = active_character().em;
    const double astray = coverage_.astray(hand(), contact);
    if (writer_.guided) return contact.weight >= slipping_weight && astray <= slipping_detour * em;
    return contact.closest.distance <= options_.tolerances.corridor * em && astray <= 0.5 * slipping_detour * em;
  }
  if (writer_.state != InteractionState::calibration || !may_start()) return false;
  if (options_.guide_to_start) return capture_.verdict() != CaptureVerdict::another_stroke;
  return hint() == WritingHint::write && capture_.is_nearest();
}

/// Where the hand means to be, as far as the force at work shows, if the device says what that is [m, page].
Point HapticRenderer::hand() const noexcept {
  const Point tip = tick_.pen_tip.head<2>();
  const Eigen::Vector3d& force = sensor_.pen().force;
  if (!force.allFinite()) return tip;
  return tip - force.head<2>() * (mapping_.scale * mapping_.scale / options_.grip_stiffness);
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
