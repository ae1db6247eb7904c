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

/// In the paper plane, except for `normal` [N, page].
struct GuidanceForce {
  Point attraction = Point::Zero();  ///< the law's spring, assistance included, before the fade
  Point wrong_way = Point::Zero();   ///< Fig. 4, before the fade
  Point viscous = Point::Zero();     ///< damping, before the fade
  Point total = Point::Zero();       ///< of the three as they fade in, and of what is still being withdrawn
  double normal = 0.0;               ///< of the law, as it fades in
  double assistance = 1.0;           ///< factor from the assist policy [1]
  double power = 0.0;                ///< with which the law may lead the pen on in this tick [W]
};

/// Never allocates, unless the law does.
class Guidance {
 public:
  Guidance(const EffectiveOptions& effective, std::unique_ptr<GuidanceLaw> law);

  /// No force where the device cannot be trusted, the last one while it is held; nor where the law cannot, which the
  /// status of the pen then says. `sent`: what the device got of the total of the tick before [N, page].
  const GuidanceForce& update(PenState& pen, const WriterState& writer, const Point& sent) noexcept;

  void restart() noexcept;

  /// What the law threw first since the restart; null: nothing.
  const std::exception_ptr& error() const noexcept { return error_; }

 private:
  void release() noexcept;
  void pull(PenState& pen, const WriterState& writer) noexcept;
  void lead(const WriterState& writer) noexcept;
  void show_stroke(const PenState& pen, const WriterState& writer) noexcept;
  GuidanceTerms ask(PenState& pen, const WriterState& writer) noexcept;
  Point way_to_start(const WriterState& writer) const noexcept;
  Point faded(const PenState& pen, const WriterState& writer, const Point& sent) noexcept;

  EffectiveOptions effective_;
  double period_;     ///< [s]
  double fade_step_;  ///< per tick
  Assistance assistance_;
  std::unique_ptr<GuidanceLaw> law_;
  GuidanceInput input_;
  bool begun_ = false;  ///< the law knows of this attempt
  std::exception_ptr error_;
  bool guided_ = false;      ///< in the tick before
  ReleasedSpring released_;  ///< what guided before it last jumped, took hold or let go
  double fade_ = 0.0;        ///< progress of the fade-in since then, 0 to 1
  double normal_before_ = 0.0;    ///< of the law, in the tick before [N]
  double released_normal_ = 0.0;  ///< likewise, of the law's normal force [N]
  double normal_left_ = 0.0;      ///< of it, before its smooth step: 1 to 0
  double normal_step_ = 0.0;      ///< per tick
  GuidanceForce force_;
};

}  // namespace calligraphy
