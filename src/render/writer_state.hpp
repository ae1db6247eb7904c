// Where a writer is on the page and in the stroke that is due.
#pragma once

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/render/haptic_tick.hpp>
#include <calligraphy/render/interaction_state.hpp>

#include "writing_phase.hpp"

namespace calligraphy {

struct WriterState {
  InteractionState state = InteractionState::separation;
  WritingPhase phase = WritingPhase::lifted;
  TickEvent events = TickEvent::none;  ///< of this tick
  int character = 0;                   ///< as HapticTick::character
  int stroke = 0;                      ///< as HapticTick::stroke
  /// Contact with that stroke, while it is written or the pen `rests`; in the tick that leaves a stroke, still with
  /// that one.
  StrokeContact contact;
  bool rests = false;               ///< the pen was put down on the stroke, and follows it without writing it
  bool guided = false;              ///< guidance acts
  double covered = 0.0;             ///< as HapticTick::covered [1]
  Point to_start = Point::Zero();   ///< as HapticTick::to_start [m, page]
  Point direction = Point::Zero();  ///< of the stroke's first stretch; unit vector, zero for a stroke without length
  double attraction = 1.0;          ///< attraction factor where the pen is; before the stroke, at its start [1]
  double em = 0.0;                  ///< of the character [m]
  const ActiveStroke* geometry = nullptr;  ///< of the stroke that is due; the last once all are written
};

}  // namespace calligraphy
