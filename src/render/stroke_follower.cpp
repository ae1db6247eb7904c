#include "stroke_follower.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "collision/pair.hpp"
#include "stroke_verdict.hpp"

namespace calligraphy {
namespace {

constexpr double spacing = 0.01;  ///< of the points, where the stroke is not too long for that [em]
constexpr int min_points = 5;
constexpr int first_points = 4;  ///< over which the direction of the start is measured

/// A point is abreast of the pen within this distance along the stroke [em], at most this share of the stroke.
constexpr double max_lead = 0.03, max_lead_share = 0.15;

/// The pen is looked at each time it has moved this far [em].
constexpr double step = 0.01;

constexpr double looks_a_second = 2000.0;  ///< at a first stretch, at least one a tick
constexpr int all_looks = std::numeric_limits<int>::max();

/// The stroke bends sharply at a point where its directions from this far before and to this far after differ by more
/// than 37 degrees [em].
constexpr double bend = 0.03, bend_cosine = 0.8;

/// Arc length over which the pen's own offset follows the pen, and the one over which it does so when the pen comes
/// back to the stroke [em].
constexpr double follow = 1.0, give_up = 0.05;

/// The pen's way is measured in chords of this length, which a fine tremor does not lengthen [em].
constexpr double chord = WrittenPath::chord;

/// A pen that begins the stroke after its start makes up for that on the way to the end: for at most this share of it.
constexpr double max_late_share = 0.25;
/// Share of the stroke that must be covered in order, however short it is: half of it, less what counts as abreast.
constexpr double min_coverage = 0.42;
/// Share of the pen's path that may lie outside the corridor.
constexpr double max_outside = 0.1;
/// The end is reached within this share of what counts as abreast.
constexpr double end_share_of_lead = 0.5;

/// How far a value is beyond a range, with a sign.
double beyond(double value, double low, double high) {
  return value > high ? value - high : std::min(value - low, 0.0);
}

Pair beyond(Pair values, Pair low, Pair high) { return larger(values - high, Pair{}) + smaller(values - low, Pair{}); }

/// Component of a vector to the left of a direction.
double left(const Point& vector, const Point& direction) {
  return vector.y() * direction.x() - vector.x() * direction.y();
}

}  // namespace

void StrokeFollower::load(const ActiveStroke& stroke, double em, const StrokeTolerances& tolerances,
                          double servo_rate) {
  em_ = em;
  const double looks_a_tick = servo_rate > 0.0 ? std::ceil(looks_a_second / servo_rate) : max_points;
  looks_a_tick_ = static_cast<int>(std::min(looks_a_tick, 1.0 * max_points));
  length_ = stroke.length();
  count_ = static_cast<int>(std::clamp(std::ceil(length_ / (spacing * em)) + 1.0, static_cast<double>(min_points),
                                       static_cast<double>(max_points)));
  spacing_ = length_ / (count_ - 1);
  width_ = tolerances.corridor * em;
  share_ = tolerances.coverage;
  slack_ = tolerances.slack * em;
  lead_ = std::max(std::min(max_lead * em, max_lead_share * length_), step * em) + spacing_;

  row_.clear();
  row_.reserve(static_cast<std::size_t>(count_) + 1);
  for (int i = 0; i < count_; ++i) row_.push_back({stroke.at(i * spacing_).point, Point(1.0, 0.0)});
  row_.push_back(row_.back());
  const auto point = [&](int i) { return row(std::clamp(i, 0, count_ - 1)).point; };
  const int apart =
      spacing_ > 0.0 ? std::max(1, static_cast<int>(std::min(bend * em / spacing_, 1.0 * max_points))) : 1;
  special_ = std::uint64_t{1} | std::uint64_t{1} << (count_ - 1);
  for (int i = 0; i < count_; ++i) {
    const Point chord_here = point(i + 1) - point(i - 1);
    const double size = chord_here.norm();
    if (size > 0.0) row_[static_cast<std::size_t>(i)].tangent = chord_here / size;
    const Point in = point(i) - point(i - apart), out = point(i + apart) - point(i);
    const bool is_inside = i > 0 && i + 1 < count_;
    if (is_inside && in.dot(out) < bend_cosine * in.norm() * out.norm()) special_ |= std::uint64_t{1} << i;
  }

  // The path measured in chords is shorter than the stroke where that doubles back.
  begin(point(0), Point::Zero());
  constexpr int parts = 4;
  for (int i = 1; i < count_; ++i) {
    for (int k = 1; k <= parts; ++k) measure(point(i - 1) + (point(i) - point(i - 1)) * k / parts);
  }
  const double exact_way = chords_ + (point(count_ - 1) - chord_from_).norm();
  shortest_way_ = shortest_share_of_way * exact_way;
  least_way_ = exact_way > 0.0 ? least_share_of_way(length_ / em, tolerances) * exact_way : 0.0;
}

void StrokeFollower::begin(const Point& tip, const Point& misplaced) noexcept {
  reached_ = 1;
  own_ = tip - row_.front().point;
  const Point towards = (row(std::min(first_points, count_ - 1)).point - row_.front().point).normalized();
  late_ = std::clamp(own_.dot(towards), 0.0, max_late_share * length_) * towards;
  misplaced_ = misplaced;
  tip_ = seen_ = chord_from_ = tip;
  nearest_ = covered_ = way_ = outside_ = chords_ = 0.0;
  pull_ = Point::Zero();
  is_first_leg_ = true;
  is_behind_ = false;
  most_way_ = 0.0;
  to_end_ = length_;
}

void StrokeFollower::update(const Point& tip, const Point& hand) noexcept {
  const Point pull = hand - tip;
  if (is_first_leg_ || is_behind_) [[unlikely]] lengthen_way(tip, pull);
  tip_ = tip;
  pull_ = pull;
  if (is_behind_) {
    wait();
  } else if ((tip - seen_).squaredNorm() >= step * em_ * (step * em_)) {
    look_along();
  }
}

void StrokeFollower::leave() noexcept {
  if (is_behind_) catch_up_entirely();
  look(tip_, (tip_ - seen_).norm());
}

[[gnu::noinline]] void StrokeFollower::lengthen_way(const Point& tip, const Point& pull) noexcept {
  most_way_ += (tip - tip_).norm() + (pull - pull_).norm();
}

/// Fills in between samples: of lost ones, and of a first stretch that does not bend, only the ends are known. The tick
/// that brings a first stretch has enough to do: that is looked at in the next ones, while the samples wait.
[[gnu::noinline]] void StrokeFollower::look_along() noexcept {
  begin_leg({tip_, pull_});
  is_behind_ = is_first_leg_ && leg_steps_ > looks_a_tick_ && !may_be_accepted();
  is_first_leg_ = false;
  waiting_ = next_ = 0;
  if (!is_behind_) catch_up_entirely();
}

void StrokeFollower::begin_leg(const Sample& to) noexcept {
  leg_from_ = seen_;
  leg_ = to.tip - seen_;
  leg_pull_ = to.pull;
  leg_way_ = leg_.norm();
  leg_steps_ = static_cast<int>(std::min(leg_way_ / (step * em_), 1.0 * max_points));
  leg_step_ = 0;
}

/// Whether accepts() may be true once all is looked at: it must not be so late. The way that counts is at most that of
/// the hand, apart from rounding.
bool StrokeFollower::may_be_accepted() const noexcept { return 1.001 * most_way_ >= shortest_way_; }

[[gnu::noinline]] void StrokeFollower::wait() noexcept {
  samples_[static_cast<std::size_t>(waiting_++)] = {tip_, pull_};
  catch_up(waiting_ == max_waiting || may_be_accepted() ? all_looks : looks_a_tick_);
}

[[gnu::noinline]] void StrokeFollower::catch_up_entirely() noexcept { catch_up(all_looks); }

/// Looks at what it would have looked at, had it done so at once.
void StrokeFollower::catch_up(int looks) noexcept {
  const Point pull = pull_;
  for (;; --looks) {
    while (leg_step_ == leg_steps_ && next_ < waiting_) begin_leg(samples_[static_cast<std::size_t>(next_++)]);
    is_behind_ = leg_step_ < leg_steps_;
    if (!is_behind_ || looks == 0) break;
    pull_ = leg_pull_;
    ++leg_step_;
    look(leg_from_ + leg_ * leg_step_ / leg_steps_, leg_way_ / leg_steps_);
  }
  pull_ = pull;
}

/// How far a vector from the stroke reaches across it, beyond the offsets that the writer may have: none, that of the
/// character, or that of the stroke.
double StrokeFollower::across(const Point& from_stroke, const Point& tangent) const noexcept {
  const double own = left(own_, tangent), misplaced = left(misplaced_, tangent);
  const double low = std::min(0.0, std::min(own, misplaced)), high = std::max(0.0, std::max(own, misplaced));
  return std::abs(beyond(left(from_stroke, tangent), low, high));
}

/// Places two points at a time, this one and the next.
[[gnu::always_inline]] inline void StrokeFollower::place(const Point& tip, int point, Places& places) const noexcept {
  const RowPoint &one = row(point), &other = row(point + 1);
  const Pair x = tip.x() - Pair{one.point.x(), other.point.x()}, y = tip.y() - Pair{one.point.y(), other.point.y()};
  const Pair tx = {one.tangent.x(), other.tangent.x()}, ty = {one.tangent.y(), other.tangent.y()};
  const Pair zero = {};
  const Pair own_along = (x - own_.x()) * tx + (y - own_.y()) * ty;
  Pair along = own_along;
  if (late_ != Point::Zero()) {
    const Pair late = late_.x() * tx + late_.y() * ty;
    along = beyond(own_along, smaller(-late, zero), larger(-late, zero));
  }
  const Pair own = own_.y() * tx - own_.x() * ty, misplaced = misplaced_.y() * tx - misplaced_.x() * ty;
  const Pair off =
      beyond(y * tx - x * ty, smaller(smaller(own, misplaced), zero), larger(larger(own, misplaced), zero));
  const Pair square = off * off;

  const Pair width = {width_ * width_, width_ * width_}, lead = {lead_, lead_};
  const Pair away = own_along * own_along + square;
  const auto i = static_cast<std::size_t>(point);
  std::memcpy(&places.along[i], &along, sizeof along);
  std::memcpy(&places.square[i], &away, sizeof away);
  places.free |= static_cast<std::uint64_t>(at_most(square, width) & at_most(larger(along, -along), lead)) << i;
  for (std::uint64_t special = special_ >> i & 3; special != 0; special &= special - 1) {
    const int k = std::countr_zero(special);
    pass_special(point + k, square[k], places);
  }
}

/// An end is also passed by a pen beyond it, and a corner by one that is near.
[[gnu::noinline]] void StrokeFollower::pass_special(int point, double square, Places& places) const noexcept {
  const auto i = static_cast<std::size_t>(point);
  const double along = places.along[i], width = width_ * width_;
  bool is_free = along * along + square <= width;
  if (point == 0 || point == count_ - 1) {
    const bool is_beyond = point == 0 ? along < 0.0 : along > 0.0;
    if (is_beyond) places.square[i] = square;
    is_free = is_beyond && square <= width;
  }
  places.free |= static_cast<std::uint64_t>(is_free) << i;
}

void StrokeFollower::look(const Point& tip, double way) noexcept {
  seen_ = tip;
  way_ += way;
  const std::uint64_t next = reached_ | reached_ << 1;
  Places places;
  places.free = 0;
  // Only as far as the pen can have come: on through points that it passes.
  int end = std::countr_zero(reached_) & ~1;
  do {
    place(tip, end, places);
    end += 2;
  } while (end < count_ && (next >> end != 0 || (places.free >> (end - 1) & 1) != 0));
  if (count_ % 2 != 0) places.free &= (std::uint64_t{1} << count_) - 1;
  // The carries of the sum propagate through the free points.
  const std::uint64_t seeds = next & places.free;
  const std::uint64_t reached = (((places.free + seeds) ^ places.free) & places.free) | seeds;

  int nearest = -1;
  double least = 0.0, covered = covered_;
  for (std::uint64_t left = reached; left != 0; left &= left - 1) {
    const int i = std::countr_zero(left);
    const double along = places.along[static_cast<std::size_t>(i)], square = places.square[static_cast<std::size_t>(i)];
    if (nearest < 0 || square < least) {
      nearest = i;
      least = square;
    }
    const bool at_last = i == count_ - 1;
    if (std::abs(along) <= spacing_ || (at_last && along > 0.0)) {
      covered = std::max(covered, std::min(i * spacing_ + along, length_));
    }
    if (at_last) to_end_ = std::min(to_end_, -along);
  }
  if (nearest < 0) {
    outside_ += way;
    return;
  }
  reached_ = reached;
  covered_ = covered;
  measure(tip + pull_);
  const double arc = nearest * spacing_, gained = arc - nearest_;
  if (!(gained > 0.0)) return;
  nearest_ = arc;
  const Point& tangent = row(nearest).tangent;
  const double own = left(own_, tangent), off = left(tip - row(nearest).point, tangent);
  const bool comes_back = std::min(own, 0.0) <= off && off <= std::max(own, 0.0);
  own_ += gained / (gained + (comes_back ? give_up : follow) * em_) * (off - own) * Point(-tangent.y(), tangent.x());
}

/// Counts a chord once the pen is far enough from where it began.
void StrokeFollower::measure(const Point& tip) noexcept {
  const double size = (tip - chord_from_).norm();
  if (size < chord * em_) return;
  chords_ += size;
  chord_from_ = tip;
}

double StrokeFollower::covered() const noexcept { return covered_ < length_ ? covered_ / length_ : 1.0; }

bool StrokeFollower::is_at_end(double hidden) const noexcept { return to_end_ <= end_share_of_lead * lead_ + hidden; }

bool StrokeFollower::accepts(double hidden) const noexcept {
  const double needed = std::max(min_coverage * length_, share_ * length_ - slack_ - hidden);
  const double way = chords_ + (seen_ + pull_ - chord_from_).norm();
  return covered_ >= needed && way >= shortest_way_ && way + hidden >= least_way_ && outside_ <= max_outside * way_;
}

double StrokeFollower::astray(const Point& hand, const StrokeContact& contact) noexcept {
  const Point from_stroke = hand - contact.closest.point, &tangent = contact.closest.tangent;
  // Offsets that are allowed for only make it less.
  if (is_behind_ && std::abs(left(from_stroke, tangent)) > width_) [[unlikely]] catch_up_entirely();
  return across(from_stroke, tangent);
}

}  // namespace calligraphy
