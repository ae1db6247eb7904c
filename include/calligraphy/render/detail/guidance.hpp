// The lateral force: holds the pen to the stroke that is due, leads it to its start, and resists writing it backwards.
#pragma once

#include <calligraphy/render/detail/assistance.hpp>
#include <calligraphy/render/detail/effective_options.hpp>
#include <calligraphy/render/detail/pen_state.hpp>
#include <calligraphy/render/detail/released_spring.hpp>
#include <calligraphy/render/detail/writer_state.hpp>

namespace calligraphy {

/// In the paper plane [N, page].
struct GuidanceForce {
  Point attraction = Point::Zero();  ///< eq. (8), assistance included, before the fade
  Point wrong_way = Point::Zero();   ///< Fig. 4, before the fade
  Point viscous = Point::Zero();     ///< damping, before the fade
  Point total = Point::Zero();       ///< of the three as they fade in, and of what is still being withdrawn
  double assistance = 1.0;           ///< factor from the assist policy [1]
};

/// Never allocates.
class Guidance {
 public:
  explicit Guidance(const EffectiveOptions& effective);

  /// No force where the device cannot be trusted, the last one while it is held. `sent`: what the device got of the
  /// total of the tick before [N, page].
  const GuidanceForce& update(const PenState& pen, const WriterState& writer, const Point& sent) noexcept;

  void restart() noexcept;

 private:
  void release() noexcept;
  void pull(const PenState& pen, const WriterState& writer) noexcept;
  Point way_to_start(const WriterState& writer) const noexcept;
  Point faded(const PenState& pen, const WriterState& writer, const Point& sent) noexcept;

  EffectiveOptions effective_;
  double period_;     ///< [s]
  double fade_step_;  ///< per tick
  Assistance assistance_;
  bool guided_ = false;      ///< in the tick before
  ReleasedSpring released_;  ///< what guided before it last jumped, took hold or let go
  double fade_ = 0.0;        ///< progress of the fade-in since then, 0 to 1
  GuidanceForce force_;
};

}  // namespace calligraphy
