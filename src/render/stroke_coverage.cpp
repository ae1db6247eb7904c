#include <calligraphy/render/detail/stroke_coverage.hpp>

#include <algorithm>

namespace calligraphy {
namespace {

/// The nearest point on the inside of a bend is faster than the pen by at most this; what it skips is not covered.
constexpr double max_lead = 3.0;

/// A corner is passed before it is reached: the nearest point leaps by at most this, in corridors, and counts once the
/// pen is there.
constexpr double max_corner = 1.5;

/// A pen that keeps to the corridor is outside for at most this share of its way.
constexpr double max_outside = 0.1;

}  // namespace

void StrokeCoverage::restart(const Point& begin, const StrokeStart& start) noexcept {
  *this = {};
  start_ = start;
  offset_ = tolerated_ = begin - start.point;
  ahead_ = offset_.dot(start.direction);
  last_ = begin;
}

void StrokeCoverage::update(const Point& tip, const StrokeContact& contact, double length, double corridor) noexcept {
  const double step = (tip - last_).norm();
  last_ = tip;

  const Point& tangent = contact.arc < start_.stretch ? start_.direction : contact.closest.tangent;
  const Point normal(-tangent.y(), tangent.x());
  const Point deviation = tip - contact.closest.point;
  // The nearest point stays at an end of the stroke that the pen goes beyond.
  const double beyond = deviation.dot(tangent);
  const bool is_beyond = (contact.finished && beyond > 0.0) || (!(contact.arc > 0.0) && beyond < 0.0);
  // Past a corner the offset has another share along the stroke: as much of it is believed as across.
  const double turned = std::clamp(offset_.dot(tangent) - ahead_, -corridor, corridor);
  const double arc = std::min(contact.arc, length) + (is_beyond ? beyond : 0.0) - ahead_ - turned;

  const double across = deviation.dot(normal);
  const double kept = tolerated_.dot(normal);
  const double off = kept >= 0.0 ? std::max({across - kept, -across, 0.0}) : std::max({kept - across, across, 0.0});
  const double still = kept >= 0.0 ? std::clamp(across, 0.0, kept) : std::clamp(across, kept, 0.0);
  tolerated_ += (still - kept) * normal;

  way_ += step;
  if (off > corridor) outside_ += step;

  const double gained = arc - furthest_;
  if (contact.passed_feature) {
    owed_ = std::clamp(gained, 0.0, max_corner * corridor);
  } else if (gained > 0.0 && gained <= max_lead * step && off <= corridor) {
    covered_ += gained;
  }
  if (off <= corridor) {
    covered_ += owed_;
    owed_ = 0.0;
  }
  if (gained > 0.0) furthest_ = arc;
}

bool StrokeCoverage::keeps_in_corridor() const noexcept { return outside_ <= max_outside * way_; }

double StrokeCoverage::share(double length) const noexcept { return covered_ < length ? covered_ / length : 1.0; }

}  // namespace calligraphy
