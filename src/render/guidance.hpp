// The lateral force: holds the pen to the stroke that is due, leads it to its start, and resists writing it backwards.
#pragma once

#include <exception>
#include <memory>

#include <calligraphy/render/guidance_law.hpp>

#include "assistance.hpp"
#include "effective_options.hpp"
#include "pen_state.hpp"
#include "released_spring.hpp"
#include "writer_state.hpp"

namespace calligraphy {

/// The forces of guidance, in the paper plane except for `normal` [N, page].
struct GuidanceForce {
  Point attraction = Point::Zero();  ///< the law's spring, assistance included, before the fade
  Point wrong_way = Point::Zero();   ///< Fig. 4, before the fade
  Point viscous = Point::Zero();     ///< damping, before the fade
  Point total = Point::Zero();       ///< sum of the three as they fade in, and of what is still being withdrawn
  double normal = 0.0;               ///< normal force of the law, as it fades in
  double assistance = 1.0;           ///< factor from the assist policy [1]
  double power = 0.0;                ///< with which the law may lead the pen on in this tick [W]
};

/// Never allocates, unless the law does.
class Guidance {
 public:
  Guidance(const EffectiveOptions& effective, std::unique_ptr<GuidanceLaw> law);

  /// Computes the force of this tick: none if the device or the law cannot be trusted, the last one while it is held. A
  /// law that fails sets the status of the pen. `sent`: how much of the previous total the device was sent [N, page].
  const GuidanceForce& update(PenState& pen, const WriterState& writer, const Point& sent) noexcept;

  void restart() noexcept;

  /// HapticRenderer::set_assistance().
  void set_assistance(double factor) noexcept { assistance_.set(factor); }

  /// First exception of the law since the restart; null: none.
  const std::exception_ptr& error() const noexcept { return error_; }

 private:
  void release() noexcept;
  void pull(PenState& pen, const WriterState& writer) noexcept;
  void lead(const WriterState& writer) noexcept;
  void show_stroke(const PenState& pen, const WriterState& writer) noexcept;
  GuidanceTerms ask(PenState& pen, const WriterState& writer) noexcept;
  Point way_to_start(const WriterState& writer) const noexcept;
  Point faded(const PenState& pen, const WriterState& writer, const Point& sent) noexcept;

  // First what every tick reads, in few cache lines.
  GuidanceForce force_;
  std::unique_ptr<GuidanceLaw> law_;
  double period_;                 ///< [s]
  double fade_step_;              ///< per tick
  bool begun_ = false;            ///< the law has begun this attempt
  bool guided_ = false;           ///< in the previous tick
  double fade_ = 0.0;             ///< progress of the fade-in since guidance last jumped, took hold or let go, 0 to 1
  double normal_before_ = 0.0;    ///< normal force of the law in the previous tick [N]
  double released_normal_ = 0.0;  ///< the law's normal force at that time [N]
  double normal_left_ = 0.0;      ///< share of it that is left, before the smooth step: 1 to 0
  double normal_step_ = 0.0;      ///< per tick
  Assistance assistance_;
  ReleasedSpring released_;  ///< the guidance before that
  GuidanceInput input_;
  EffectiveOptions effective_;
  std::exception_ptr error_;
};

}  // namespace calligraphy
