// Friction between pen and paper. The paper's own pen is frictionless, "slippery" (Wang 2006, sec. 7.3).
#pragma once

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Typical force with which people press a pen on paper [N].
inline constexpr double usual_pressure = 1.0;

/// Friction between pen and paper, with hard break-away: a spring connects the pen to an anchor w on the paper, and
/// drags the anchor along once it is stretched by mu N / stiffness. Below that w does not move at all: no drift. The
/// force depends on the path alone, not on the rate. The limit of Hayward and Armstrong 2000, "A new computational
/// model of friction applied to haptic rendering", for an infinitely steep alpha; their smooth version drifts under
/// vibration.
struct FrictionOptions {
  double coefficient = 0.0;  ///< mu, tangential over normal force; 0: no friction [1]
  double stiffness = 500.0;  ///< stiffness of the spring between pen and anchor [N/m]
  double damping = 2.5;      ///< damping of that spring: none while the anchor slides along with the pen [N s/m]
};

/// Computes the friction force on the pen. Never allocates.
class PaperFriction {
 public:
  /// Friction force on a pen at `tip` [m, page] that presses with `normal` [N]; the first call after release() sets the
  /// anchor and returns zero.
  Point update(const FrictionOptions& options, const Point& tip, double normal) noexcept;
  /// Call this when the pen leaves the paper.
  void release() noexcept { holds_ = false; }

 private:
  bool holds_ = false;
  Point anchor_ = Point::Zero();  ///< w [m]
};

}  // namespace calligraphy
