// Assistance as needed: measures how well strokes are written, and adapts the guidance after each of them.
#pragma once

#include <calligraphy/render/assist_policy.hpp>

#include "writer_state.hpp"

namespace calligraphy {

/// Never allocates.
class Assistance {
 public:
  explicit Assistance(const AssistPolicy& policy) noexcept : policy_(policy) {}

  /// The pen tip is at `tip` [m, page].
  void update(const Point& tip, const WriterState& writer) noexcept;
  void restart() noexcept { *this = Assistance(policy_); }

  /// Goes on from a factor, unless it is none or guidance does not adapt.
  void set(double factor) noexcept {
    if (policy_.enabled && factor >= 0.0 && factor <= 1.0) factor_ = factor;
  }

  /// Factor on the guidance [1].
  double factor() const noexcept { return factor_; }

 private:
  void measure(const Point& tip, const WriterState& writer) noexcept;

  AssistPolicy policy_;
  double factor_ = 1.0;
  double square_ = 0.0;        ///< squared lateral error, integrated along the path on the stroke [m^3]
  double way_ = 0.0;           ///< length of that path [m]
  double em_ = 1.0;            ///< of the character [m]
  Point tip_ = Point::Zero();  ///< at the last measurement [m]
};

}  // namespace calligraphy
