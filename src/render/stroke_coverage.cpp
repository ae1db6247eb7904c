#include <calligraphy/render/detail/stroke_coverage.hpp>

#include <algorithm>

namespace calligraphy {
namespace {

/// The nearest point on the inside of a bend is faster than the pen by at most this; what it skips is not covered.
constexpr double max_lead = 3.0;

/// At a corner, which is passed before it is reached, it leaps by at most this, in corridors.
constexpr double max_corner = 2.5;

}  // namespace

void StrokeCoverage::restart(const Point& begin, const Point& offset, const Point& direction) noexcept {
  *this = {};
  offset_ = tolerated_ = offset;
  ahead_ = offset.dot(direction);
  last_ = begin;
}

void StrokeCoverage::update(const Point& tip, const StrokeContact& contact, double length, double corridor) noexcept {
  const double step = (tip - last_).norm();
  last_ = tip;

  const Point& tangent = contact.closest.tangent;
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

  const double gained = arc - furthest_;
  is_turning_ = is_turning_ || contact.passed_feature;
  if (off > corridor) {
    // The nearest point leaps at a corner, maybe to where the pen has yet to go: nothing is lost.
    if (gained > 0.0 && !is_turning_) furthest_ = arc;
    return;
  }
  if (!(gained > 0.0)) return;  // NaN too
  const double leap = is_turning_ ? max_corner * corridor : max_lead * step;
  if (gained <= leap) covered_ += gained;
  furthest_ = arc;
  is_turning_ = false;
}

double StrokeCoverage::share(double length) const noexcept { return covered_ < length ? covered_ / length : 1.0; }

}  // namespace calligraphy
