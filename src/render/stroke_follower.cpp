#include <calligraphy/render/detail/stroke_follower.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace calligraphy {
namespace {

constexpr double spacing = 0.01;  ///< of the points, where the stroke is not too long for that [em]
constexpr int min_points = 5;
constexpr int first_points = 4;  ///< over which the direction of the start is seen

/// A point is abreast of the pen within this distance along the stroke [em], at most this share of the stroke.
constexpr double max_lead = 0.03, max_lead_share = 0.15;

/// The pen is looked at each time it has moved this far [em].
constexpr double step = 0.01;

/// The stroke bends sharply at a point where its directions from this far before and to this far after differ by more
/// than 37 degrees [em].
constexpr double bend = 0.03, bend_cosine = 0.8;

/// The pen's own offset across the stroke follows it over this arc length [em], where it comes back to the stroke over
/// the second one [em].
constexpr double follow = 1.0, give_up = 0.05;

/// The pen's way is measured in chords of this length, which a fine tremor does not lengthen [em].
constexpr double chord = 0.03;

/// Share of the exact way that a pen must have gone, in chords: less is a part of the stroke, however it is stretched.
constexpr double min_way = 0.57;
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

Point left_of(const Point& direction) { return {-direction.y(), direction.x()}; }

}  // namespace

void StrokeFollower::load(const ActiveStroke& stroke, double em, const StrokeTolerances& tolerances) noexcept {
  em_ = em;
  length_ = stroke.length();
  count_ = static_cast<int>(std::clamp(std::ceil(length_ / (spacing * em)) + 1.0, static_cast<double>(min_points),
                                       static_cast<double>(max_points)));
  spacing_ = length_ / (count_ - 1);
  width_ = tolerances.corridor * em;
  share_ = tolerances.coverage;
  slack_ = tolerances.slack * em;
  lead_ = std::max(std::min(max_lead * em, max_lead_share * length_), step * em) + spacing_;

  int element = 0;
  double before = 0.0;
  for (int i = 0; i < count_; ++i) {
    const double arc = i * spacing_;
    while (element + 1 < stroke.element_count() && arc > before + stroke.element(element).length()) {
      before += stroke.element(element++).length();
    }
    const StrokeElement& on = stroke.element(element);
    points_[static_cast<std::size_t>(i)] = on.point(on.parameter_at(arc - before));
  }
  const auto point = [&](int i) { return points_[static_cast<std::size_t>(std::clamp(i, 0, count_ - 1))]; };
  const int apart =
      spacing_ > 0.0 ? std::max(1, static_cast<int>(std::min(bend * em / spacing_, 1.0 * max_points))) : 1;
  corners_ = 0;
  for (int i = 0; i < count_; ++i) {
    const Point chord_here = point(i + 1) - point(i - 1);
    const double size = chord_here.norm();
    tangents_[static_cast<std::size_t>(i)] = size > 0.0 ? Point(chord_here / size) : Point(1.0, 0.0);
    const Point in = point(i) - point(i - apart), out = point(i + apart) - point(i);
    const bool is_inside = i > 0 && i + 1 < count_;
    if (is_inside && in.dot(out) < bend_cosine * in.norm() * out.norm()) corners_ |= std::uint64_t{1} << i;
  }

  // Less than the length where the stroke doubles back.
  begin(point(0), Point::Zero());
  constexpr int parts = 4;
  for (int i = 1; i < count_; ++i) {
    for (int k = 1; k <= parts; ++k) measure(point(i - 1) + (point(i) - point(i - 1)) * k / parts);
  }
  exact_way_ = chords_ + (point(count_ - 1) - chord_from_).norm();
}

void StrokeFollower::begin(const Point& tip, const Point& misplaced) noexcept {
  reached_ = 1;
  own_ = tip - points_[0];
  const Point towards =
      (points_[static_cast<std::size_t>(std::min(first_points, count_ - 1))] - points_[0]).normalized();
  late_ = std::max(0.0, own_.dot(towards)) * towards;
  misplaced_ = misplaced;
  tip_ = seen_ = chord_from_ = tip;
  nearest_ = covered_ = way_ = outside_ = chords_ = 0.0;
  pull_ = Point::Zero();
  to_end_ = length_;
}

void StrokeFollower::update(const Point& tip, const Point& hand) noexcept {
  tip_ = tip;
  pull_ = hand - tip;
  const Point from = seen_;
  const double moved = (tip - from).norm();
  if (moved < step * em_) return;
  // Of the first stretch and of lost samples only the ends are known.
  const int steps = static_cast<int>(std::min(moved / (step * em_), 1.0 * max_points));
  for (int i = 1; i <= steps; ++i) look(from + (tip - from) * i / steps, moved / steps);
}

void StrokeFollower::leave() noexcept { look(tip_, (tip_ - seen_).norm()); }

/// How far a vector from the stroke is across it, beyond all that the writer may be off by: nothing, as the character,
/// or as the stroke.
double StrokeFollower::across(const Point& from_stroke, const Point& normal) const noexcept {
  const double own = own_.dot(normal), misplaced = misplaced_.dot(normal);
  return std::abs(beyond(from_stroke.dot(normal), std::min({0.0, own, misplaced}), std::max({0.0, own, misplaced})));
}

StrokeFollower::Place StrokeFollower::place(const Point& tip, int point) const noexcept {
  const auto i = static_cast<std::size_t>(point);
  const Point from_stroke = tip - points_[i];
  const double own_along = (from_stroke - own_).dot(tangents_[i]), late = late_.dot(tangents_[i]);
  const double along = beyond(own_along, std::min(0.0, -late), std::max(0.0, -late));
  const double aside = across(from_stroke, left_of(tangents_[i]));
  const bool is_outside = (point == 0 && along < 0.0) || (point == count_ - 1 && along > 0.0);
  const bool is_corner = (corners_ >> point & 1) != 0;
  const bool abreast = is_outside || std::abs(along) <= lead_;
  return {along, is_outside ? aside : std::hypot(own_along, aside),
          (abreast && aside <= width_) || (is_corner && std::hypot(along, aside) <= width_)};
}

[[gnu::noinline]] void StrokeFollower::look(const Point& tip, double way) noexcept {
  seen_ = tip;
  way_ += way;
  std::uint64_t reached = 0;
  int nearest = -1;
  double least = 0.0, covered = covered_;
  for (int i = std::countr_zero(reached_); i < count_; ++i) {
    const std::uint64_t from = ((reached_ | reached) << 1 | reached_) >> i;
    if (from == 0) break;
    if ((from & 1) == 0) continue;
    const Place here = place(tip, i);
    if (!here.free) continue;
    reached |= std::uint64_t{1} << i;
    if (nearest < 0 || here.distance < least) {
      nearest = i;
      least = here.distance;
    }
    const bool at_last = i == count_ - 1;
    if (std::abs(here.along) <= spacing_ || (at_last && here.along > 0.0)) {
      covered = std::max(covered, std::min(i * spacing_ + here.along, length_));
    }
    if (at_last) to_end_ = std::min(to_end_, -here.along);
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
  const auto i = static_cast<std::size_t>(nearest);
  const Point normal = left_of(tangents_[i]);
  const double own = own_.dot(normal), off = (tip - points_[i]).dot(normal);
  const bool comes_back = std::min(own, 0.0) <= off && off <= std::max(own, 0.0);
  own_ += gained / (gained + (comes_back ? give_up : follow) * em_) * (off - own) * normal;
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
  return covered_ >= needed && way >= min_way * exact_way_ && outside_ <= max_outside * way_;
}

double StrokeFollower::astray(const Point& hand, const StrokeContact& contact) const noexcept {
  return across(hand - contact.closest.point, left_of(contact.closest.tangent));
}

}  // namespace calligraphy
