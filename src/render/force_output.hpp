// The last stage: how much of the page's forces the device is sent, and what energy that gives the hand.
#pragma once

#include <Eigen/Core>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

#include "energy_budget.hpp"
#include "force_limiter.hpp"
#include "guidance.hpp"
#include "paper.hpp"
#include "pen_state.hpp"
#include "thermal_budget.hpp"

namespace calligraphy {

struct SentForce {
  Eigen::Vector3d page = Eigen::Vector3d::Zero();     ///< page axes [N]
  Eigen::Vector3d device = Eigen::Vector3d::Zero();   ///< device axes [N]
  Point guidance = Point::Zero();                     ///< `page` in the plane, less the friction that was wanted [N]
  Eigen::Vector3d viscous = Eigen::Vector3d::Zero();  ///< as HapticTick::viscous [N, page]
  double energy_given = 0.0;                          ///< to the hand, as observed; 0 without an account of it [J]
  double heat = 0.0;                                  ///< of the motors; 0 without thermal budget [1]
  bool is_warm = false;                               ///< heat permits less force than was wanted
};

/// Limits the forces by energy budget, by peak and heat, which preserve the direction, and by rate. The energy is that
/// of the force at work. Never allocates.
class ForceOutput {
 public:
  /// `max_guidance_stiffness`: maximum stiffness at which guidance follows the pen [N/m]. `has_own_law`: the guidance
  /// law is not a built-in one, so nothing about it is certain.
  /// @throws ValueError unless the device has a peak force
  ForceOutput(const RendererOptions& options, const Capabilities& capabilities, const MotionMapping& mapping,
              double max_guidance_stiffness, bool has_own_law);

  /// Limits the forces to what may be sent. While samples are briefly stale, the last force is held; if the device
  /// cannot be trusted, the force goes to zero at the limited rate.
  const SentForce& update(const PenState& pen, const GuidanceForce& guidance, const PaperForce& paper) noexcept;

  void restart() noexcept;

  const SentForce& last() const noexcept { return sent_; }
  /// As HapticRenderer::max_force_step() [N, page].
  double max_step() const noexcept;

 private:
  /// Sum of all springs and dampers that act in one direction.
  struct Impedance {
    double stiffness;  ///< [N/m]
    double damping;    ///< [N s/m]
    double force(double way, double velocity) const noexcept { return stiffness * way + damping * velocity; }
  };

  ForceAllowance allowance(const PenState& pen) const noexcept;
  ForceAllowance allowance(Point way, Point velocity_change) const noexcept;
  void account(const PenState& pen) noexcept;
  Eigen::Vector3d affordable(const PenState& pen, const Eigen::Vector3d& wanted) noexcept;

  SentForce sent_;
  MotionMapping mapping_;
  ForceLimiter limiter_;
  bool observes_energy_;
  ThermalBudget thermal_;  ///< peak 0: disabled
  double time_ = 0.0;      ///< of the previous sample [s]
  double period_;          ///< [s]
  Impedance in_plane_, normal_;
  double paper_onset_;     ///< depth over which the damper of the paper sets in [m]
  EnergyBudget energy_;
};

}  // namespace calligraphy
