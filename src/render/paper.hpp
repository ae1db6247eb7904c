// The paper under the pen: its surface presses back, and rubs.
#pragma once

#include <Eigen/Core>

#include <calligraphy/render/paper_friction.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "pen_state.hpp"
#include "writer_state.hpp"

namespace calligraphy {

/// The forces of the paper on the pen [N, page].
struct PaperForce {
  double normal = 0.0;                                ///< eq. (9), damping included
  Point friction = Point::Zero();                     ///< damping included
  Eigen::Vector3d viscous = Eigen::Vector3d::Zero();  ///< damping in both
};

/// Never allocates.
class Paper {
 public:
  explicit Paper(const RendererOptions& options);

  /// Computes the force of this tick: none if the device cannot be trusted, the last one while it is held. `pressure`:
  /// normal force that was sent in the previous tick [N].
  const PaperForce& update(const PenState& pen, const WriterState& writer, double pressure) noexcept;

  /// Drops the force and the anchor of the friction.
  void release() noexcept;

 private:
  void release_friction() noexcept;
  void press(const PenState& pen) noexcept;
  void rub(const Point& point, double pressure) noexcept;

  PaperForce force_;
  PaperOptions options_;
  double period_;       ///< [s]
  double rate_filter_;  ///< coefficient of the low-pass on the rate of the friction spring
  PaperFriction friction_;
  Point spring_ = Point::Zero();       ///< of friction, in the previous tick [N, page]
  Point spring_rate_ = Point::Zero();  ///< its filtered change [N/s, page]
};

}  // namespace calligraphy
