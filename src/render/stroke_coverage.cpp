#include <calligraphy/render/detail/stroke_coverage.hpp>

#include <algorithm>

namespace calligraphy {

void StrokeCoverage::restart(const Point& begin, const Point& offset, const Point& direction) noexcept {
  *this = {};
  offset_ = tolerated_ = offset;
  late_ = std::max(0.0, offset.dot(direction));
  last_ = begin;
}

void StrokeCoverage::update(const Point& tip, const StrokeContact& contact, double length, double corridor) noexcept {
  way_ += (tip - last_).norm();
  last_ = tip;

  const Point& tangent = contact.closest.tangent;
  const Point normal(-tangent.y(), tangent.x());
  const Point deviation = tip - contact.closest.point;
  // The nearest point stays at an end of the stroke that the pen goes beyond.
  const double beyond = deviation.dot(tangent);
  const bool is_beyond = (contact.finished && beyond > 0.0) || (!(contact.arc > 0.0) && beyond < 0.0);
  const double arc = std::min(contact.arc, length) + (is_beyond ? beyond : 0.0) - offset_.dot(tangent);

  const double across = deviation.dot(normal);
  const double kept = tolerated_.dot(normal);
  const double off = kept >= 0.0 ? std::max({across - kept, -across, 0.0}) : std::max({kept - across, across, 0.0});
  const double still = kept >= 0.0 ? std::clamp(across, 0.0, kept) : std::clamp(across, kept, 0.0);
  tolerated_ += (still - kept) * normal;

  if (!(arc > furthest_)) return;  // false for NaN too
  if (off <= corridor) passed_ += arc - furthest_;
  furthest_ = arc;
}

double StrokeCoverage::share(double length) const noexcept {
  const double covered = std::min(passed_, way_);
  return covered < length ? covered / length : 1.0;
}

}  // namespace calligraphy
