#include <calligraphy/practice/pointer_lesson.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calligraphy {
namespace {

// A light and well damped hand, which follows the pointer closely round corners, too.
constexpr GripImpedance pointer_grip = {.mass = 0.01, .damping = 12.0, .stiffness = 300.0};
constexpr double hand_fade_in = 0.03;  // of guidance: no real hand is thrown by it [s]
constexpr double pressed = 0.5;        // pressure of a pen on the paper, whatever its own: it must touch the paper

constexpr double period = 1e-3;         // of a tick [s]
constexpr double clock_step = 1e-6;     // times that differ by less are the same [s]
constexpr double delay = 0.016;         // of the pen behind the pointer, when it touches the paper and along it [s]
constexpr double palm_time = 1.5;       // for so long after a pen was seen, a touch is the hand that holds it [s]
constexpr double longest_bounce = 0.15;  // a pointer that is put down this near, the pen still on the paper, goes on [em]
constexpr double away = 0.01;            // a pointer that is put down this far from the pen was not seen coming [em]
constexpr int longest_way = 150;         // of the lifted pen across the page [ticks]
constexpr double longest_rest = 1.0;     // that is spent tick by tick [s]
constexpr double longest_advance = 60.0;  // [s]

/// A pointer that is put down or lifted takes the pen along within some 20 ms.
PointerOptions following(const LessonOptions& options) {
  PointerOptions result;
  result.rate = 1.0 / period;
  result.smoothing_time = 0.01;
  result.max_speed = 2.0;
  result.lifting_speed = 0.6;
  result.hover_height = 0.0045;
  result.paper.linear() = options.mapping->rotation.transpose();
  result.paper.translation() = options.mapping->to_device(Eigen::Vector3d::Zero());
  return result;
}

LessonOptions of_this_hand(LessonOptions options, const std::vector<PracticePage>& pages) {
  options.renderer.grip_stiffness = pointer_grip.stiffness;
  options.renderer.guidance.fade_in = hand_fade_in;
  options.renderer.servo_rate = 1.0 / period;
  options.mapping = pages.empty() ? MotionMapping() : upright_page(pages.front().width, pages.front().height);
  return options;
}

double edge_of(const Lesson& lesson) { return lesson.page().characters.front().placement.em; }

}  // namespace

PointerLesson::PointerLesson(std::vector<PracticePage> pages, const Capabilities& device,
                             const LessonOptions& options)
    : PointerLesson(of_this_hand(options, pages), std::move(pages), device) {}

PointerLesson::PointerLesson(const LessonOptions& options, std::vector<PracticePage> pages, const Capabilities& device)
    : device_(device, pointer_grip, following(options)), lesson_(std::move(pages), device_.capabilities(), options) {
  pointer_.place = Point(0.5 * lesson_.page().width, 0.5 * lesson_.page().height);
  put(pointer_, false);
  tick(0.0);
}

void PointerLesson::change(const LessonOptions& options) { lesson_.change(of_this_hand(options, {lesson_.page()})); }

void PointerLesson::move(const PointerSample& sample) {
  if (std::isfinite(sample.time) && sample.place.allFinite()) samples_.push_back(sample);
}

/// Ticks lie on a grid that begins with the first sample and begins anew with that after a rest, wherever the calls of
/// advance() fall.
void PointerLesson::advance(double time) {
  if (!std::isfinite(time)) return;
  while (true) {
    if (is_at_rest()) {
      if (samples_.empty() && !lesson_.has_commands()) return;
      time_ = std::max(time_, (samples_.empty() ? time - 2.0 * clock_step : samples_.front().time) - period);
    }
    const double next = samples_.empty() ? time : std::min(time, samples_.front().time);
    time_ = std::max(time_, next - longest_advance);
    if (time_ + period + clock_step > time) return;
    time_ += period;
    while (!samples_.empty() && samples_.front().time <= time_ + clock_step) {
      const PointerSample sample = samples_.front();
      samples_.pop_front();
      if (takes(sample)) take(sample);
    }
    tick(time_);
  }
}

bool PointerLesson::is_busy() const noexcept {
  return !samples_.empty() || lesson_.has_commands() || !is_at_rest();
}

/// No time need be spent before the next sample.
bool PointerLesson::is_at_rest() const noexcept {
  if (lesson_.is_waiting()) return false;
  if (lesson_.sees_pen() && (is_down_ || is_on_paper())) return false;
  return !(time_ < last_sample_ + longest_rest);
}

/// Whether a sample is of the pointer that writes, or of one that may.
bool PointerLesson::takes(const PointerSample& sample) {
  if (sample.kind == PointerKind::pen) pen_time_ = sample.time;
  if (is_down_ && sample.id != pointer_.id) {
    if (!sample.is_down) return false;
    const bool was_palm = pointer_.kind == PointerKind::touch && sample.kind == PointerKind::pen;
    if (!was_palm && sample.kind != pointer_.kind) return false;
    PointerSample lifted = pointer_;  // its end was lost, or what it did was no writing
    lifted.is_down = false;
    lifted.is_cancelled = was_palm;
    take(lifted);
    return true;
  }
  return is_down_ || sample.kind != PointerKind::touch || !(sample.time - pen_time_ < palm_time);
}

void PointerLesson::take(const PointerSample& sample) {
  last_sample_ = time_;
  const bool begins = sample.is_down && !is_down_;
  if (begins) {
    const Point from = is_on_paper() ? pointer_.place : Point(tick_.pen_tip.head<2>());
    const double jump = (sample.place - from).norm() / edge_of(lesson_);
    if (jump > (is_on_paper() ? longest_bounce : away)) bring(sample);
    is_ignored_ = false;
  }
  if (sample.is_cancelled) is_ignored_ = true;
  is_down_ = sample.is_down;
  pointer_ = sample;
  places_.emplace_back(std::max(sample.time, places_.empty() ? sample.time : places_.back().first), sample.place);
  put(sample, is_down_);
}

void PointerLesson::put(const PointerSample& sample, bool is_down) {
  device_.move(sample.place.x(), sample.place.y(), is_down ? pressed : 0.0, sample.buttons, sample.stylus);
}

/// Lifts the pen and takes it to where a pointer is put down, in no time of the writer's.
void PointerLesson::bring(const PointerSample& sample) {
  for (int i = 0; i < longest_way && is_on_paper(); ++i) tick(hand_time_);
  put(sample, false);
  places_.clear();
  places_.emplace_back(sample.time, sample.place);
  for (int i = 0; i < longest_way; ++i) tick(hand_time_);
}

void PointerLesson::tick(double time) {
  hand_time_ = time;
  LessonHand hand;
  hand.place = hand_at(time - delay);
  hand.time = time;
  if (is_ignored_ && is_on_paper()) lesson_.ignore();
  tick_ = lesson_.update(device_.read(), &hand);
  device_.write(lesson_.force());
}

/// Where the pointer was, between its samples.
Point PointerLesson::hand_at(double time) {
  while (places_.size() > 1 && places_[1].first <= time) places_.pop_front();
  if (places_.empty()) return pointer_.place;
  const auto& [begin, from] = places_.front();
  if (places_.size() == 1 || time <= begin) return from;
  const auto& [end, to] = places_[1];
  return from + (time - begin) / (end - begin) * (to - from);
}

}  // namespace calligraphy
