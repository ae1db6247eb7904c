// Friction between pen and paper, which the paper lacks: "slippery" (Wang 2006, sec. 7.3).
#pragma once

#include <calligraphy/model/point.hpp>

namespace calligraphy {

enum class FrictionModel {
  /// Hard break-away: the pen hangs on a spring from a point w of the paper, which it draws along once the spring is
  /// stretched by mu N / stiffness. Below that w does not move at all: no drift. The force depends on the path alone,
  /// not on the rate. The limit of Hayward and Armstrong 2000 for an infinitely steep alpha.
  breakaway,
  /// Hayward and Armstrong 2000, "A new computational model of friction applied to haptic rendering", with
  /// alpha(z) = z^8 / (z_stick^8 + z^8) / z_max: w creeps below break-away too, smoothly. Drifts under vibration.
  hayward_armstrong,
  /// Karnopp 1985, with the spring of Richard and Cutkosky 2002 while it sticks: below `stick_speed` the pen holds to
  /// where it stopped, up to `static_ratio` mu N; above it mu N opposes the motion.
  karnopp
};

struct FrictionOptions {
  FrictionModel model = FrictionModel::breakaway;
  double coefficient = 0.0;    ///< mu, force within the paper over the force along its normal; 0: no friction [1]
  double stiffness = 500.0;    ///< of the pen's hold on the paper [N/m]
  double static_ratio = 1.2;   ///< karnopp: break-away over sliding friction, at least 1 [1]
  double stick_speed = 0.002;  ///< karnopp [m/s]
};

/// The pen's hold on the paper. Never allocates.
class PaperFriction {
 public:
  /// The force on a pen at `tip` [m, page] that is pressed on by `normal` [N], after `seconds` since the last call; the
  /// first call after release() takes hold, without force.
  Point update(const FrictionOptions& options, const Point& tip, double normal, double seconds) noexcept;
  /// The pen is off the paper.
  void release() noexcept { holds_ = false; }

 private:
  Point stretch(const FrictionOptions& options, const Point& tip, double longest) noexcept;
  Point karnopp(const FrictionOptions& options, const Point& tip, double most, double seconds) noexcept;

  bool holds_ = false;
  bool sticks_ = false;           ///< karnopp
  Point anchor_ = Point::Zero();  ///< w [m]
  Point tip_ = Point::Zero();     ///< of the last call [m]
};

}  // namespace calligraphy
