#include <calligraphy/render/paper_friction.hpp>

#include <algorithm>

namespace calligraphy {

Point PaperFriction::update(const FrictionOptions& options, const Point& tip, double normal) noexcept {
  if (!holds_) {
    anchor_ = tip;
    holds_ = true;
  }
  const double longest = options.coefficient * std::max(0.0, normal) / options.stiffness;
  const Point way = tip - anchor_;
  const double length = way.norm();
  if (!(length > longest)) return -options.stiffness * way;
  const Point held = way * (longest / length);
  anchor_ = tip - held;
  return -options.stiffness * held;
}

}  // namespace calligraphy
