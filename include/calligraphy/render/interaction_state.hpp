// The interaction states and the graph of their transitions (Wang 2006, sec. 2.3, Table 1, Fig. 6).
#pragma once

#include <cstdint>

namespace calligraphy {

/// Where the pen is, and whether it writes (Table 1, Fig. 6).
enum class InteractionState : std::uint8_t {
  separation,   ///< SS: the pen does not touch the paper
  adjusting,    ///< AS: the pen touches the paper outside the active character's box
  calibration,  ///< CS: the pen touches the paper inside the box, but does not write the active stroke
  writing       ///< WS: the active stroke is being written
};

/// "SS", "AS", "CS" or "WS".
const char* to_string(InteractionState state) noexcept;

/// The inputs of a transition, with hysteresis already applied.
struct TransitionInput {
  bool contact = false;     ///< the pen touches the paper
  bool inside_box = false;  ///< inside the active character's box
  bool begins = false;      ///< has written the first stretch of the active stroke
  bool may_start = false;   ///< there is an active stroke and, if required, the pen was lifted since the last one
  /// The active stroke has just been finished: it is covered, at its end or where the pen leaves it.
  bool stroke_finished = false;
};

/// The state graph as a pure function:
///
/// | from | first condition that holds                 | to |
/// |------|--------------------------------------------|----|
/// | any  | no contact                                 | SS |
/// | WS   | stroke finished                            | CS |
/// | WS   | outside the box                            | AS |
/// | WS   | otherwise                                  | WS |
/// | SS, AS, CS | inside the box, has begun a stroke that may start | WS |
/// | SS, AS, CS | inside the box                       | CS |
/// | SS, AS, CS | outside the box                      | AS |
///
/// Leaving WS without finishing abandons the stroke: its stack of feature points is refilled (sec. 4.3).
InteractionState next_state(InteractionState state, const TransitionInput& input) noexcept;

}  // namespace calligraphy
