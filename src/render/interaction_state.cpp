#include <calligraphy/render/interaction_state.hpp>

#include "base/enum_name.hpp"

namespace calligraphy {

const char* to_string(InteractionState state) noexcept {
  static constexpr const char* names[] = {"SS", "AS", "CS", "WS"};
  return name_of<InteractionState::writing>(state, names, "");
}

InteractionState next_state(InteractionState state, const TransitionInput& input) noexcept {
  if (!input.contact) return InteractionState::separation;
  if (state == InteractionState::writing) {
    if (input.stroke_finished) return InteractionState::calibration;
    return input.inside_box ? InteractionState::writing : InteractionState::adjusting;
  }
  if (!input.inside_box) return InteractionState::adjusting;
  return input.begins && input.may_start ? InteractionState::writing : InteractionState::calibration;
}

}  // namespace calligraphy
