// What a pen is doing to the stroke that is due (docs/capture.md draws it).
#pragma once

#include <cstdint>

#include <calligraphy/render/haptic_tick.hpp>

namespace calligraphy {

/// Refines the paper's states: `lifted` and `in_doubt` are SS, `guided` and `released` are WS, `page_written` is AS,
/// and the others are CS in the character's box and AS outside it.
enum class WritingPhase : std::uint8_t {
  lifted,        ///< not on the paper
  in_doubt,      ///< likewise, and perhaps the stroke that is due was written: what is begun next decides
  page_written,  ///< no stroke is due
  finished,      ///< has just finished the previous stroke, and must be lifted
  away,          ///< too far from the start
  in_middle,     ///< put down on the stroke, elsewhere than at its start
  at_end,        ///< put down on the stroke, and now on its last quarter
  at_start,      ///< at the start, the first stretch not yet written
  turned_away,   ///< at the start, setting out another way
  other_stroke,  ///< writes another stroke, until it is lifted
  guided,        ///< writes the stroke
  released       ///< writes it, too far away or pulled too far for guidance, which has let go
};

/// What a display tells the writer.
constexpr WritingHint hint_in(WritingPhase phase) noexcept {
  switch (phase) {
    case WritingPhase::lifted:
    case WritingPhase::page_written:
    case WritingPhase::guided:
      return WritingHint::none;
    case WritingPhase::in_doubt:
      return WritingHint::lifted_early;
    case WritingPhase::finished:
      return WritingHint::lift_first;
    case WritingPhase::away:
      return WritingHint::too_far;
    case WritingPhase::in_middle:
      return WritingHint::in_middle;
    case WritingPhase::at_end:
      return WritingHint::at_end;
    case WritingPhase::at_start:
      return WritingHint::write;
    case WritingPhase::turned_away:
      return WritingHint::wrong_direction;
    case WritingPhase::other_stroke:
      return WritingHint::another_stroke;
    case WritingPhase::released:
      return WritingHint::off_stroke;
  }
  return WritingHint::none;
}

}  // namespace calligraphy
