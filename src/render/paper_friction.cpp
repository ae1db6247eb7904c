#include <calligraphy/render/paper_friction.hpp>

#include <algorithm>
#include <cmath>

namespace calligraphy {
namespace {

/// Where alpha of Hayward and Armstrong rises, as a fraction of z_max.
constexpr double stick_share = 0.75;

/// alpha(z) z_max.
double creep(double share) noexcept {
  const double ratio = share / stick_share;
  const double square = ratio * ratio;
  const double eighth = square * square * square * square;
  return eighth / (1.0 + eighth);
}

Point no_longer_than(const Point& vector, double longest) noexcept {
  const double length = vector.norm();
  return length > longest ? Point(vector * (longest / length)) : vector;
}

}  // namespace

Point PaperFriction::update(const FrictionOptions& options, const Point& tip, double normal) noexcept {
  const double most = options.coefficient * std::max(0.0, normal);
  if (!holds_) {
    anchor_ = tip_ = tip;
    holds_ = true;
  }
  const Point force = -options.stiffness * stretch(options, tip, most / options.stiffness);
  tip_ = tip;
  return force;
}

/// z = x - w after the anchor has followed the tip.
Point PaperFriction::stretch(const FrictionOptions& options, const Point& tip, double longest) noexcept {
  if (options.model == FrictionModel::hayward_armstrong) {
    const double length = (tip - anchor_).norm();
    if (length < longest) {  // otherwise it slides, as below; longest > 0
      const double followed = (tip - tip_).norm() * creep(length / longest) / longest;
      anchor_ += std::min(1.0, followed) * (tip - anchor_);
    }
  }
  const Point held = no_longer_than(tip - anchor_, longest);
  if (held != tip - anchor_) anchor_ = tip - held;
  return held;
}

}  // namespace calligraphy
