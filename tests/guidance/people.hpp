// People's strokes, as they wrote them, drawn on a page of the character: which of them the renderer takes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "right_pens.hpp"
#include "sequence.hpp"

namespace calligraphy_test {

/// A person's pen-downs as lines on a page: laid on the strokes by one translation and one scale, by least squares over
/// 32 points at equal arc length of each pen-down and its stroke.
std::vector<StrokeLine> laid_on(const std::vector<StrokeLine>& strokes, std::span<const calligraphy::PenPath> paths);

/// A due stroke of a person's character.
struct DueStroke {
  std::size_t pen = 0;  ///< index
  char32_t character = 0;
  int stroke = 0;       ///< from 0
  double length = 0.0;  ///< of the character's stroke, not the person's [em]
};

/// What became of it at the first touch.
struct FirstTouch {
  DueStroke due;
  bool begun = false;
  bool at_lift = false;    ///< finished when it was drawn
  bool with_next = false;  ///< or by the start of the person's next stroke; after the last, in `final_rest` in the air
  bool mistaken = false;   ///< the person's next stroke was taken for it
};

/// Draws the strokes of each person one after another. One that is not finished is drawn exactly, up to three times, to
/// go on; if that fails, the rest of the character counts as neither begun nor finished.
std::vector<FirstTouch> draw_people(const std::vector<RightPen>& pens, const SequenceOptions& options,
                                    const std::function<void(double)>& progress = nullptr);

/// Draws a part of each stroke that is at least `shortest` long, between two shares of the person's stroke [em].
struct PersonsPart {
  double from = 0.0, to = 1.0;
  double shortest = 0.0;
};

/// Draws that part for the stroke, then the person's next stroke, the strokes before drawn as people do.
std::vector<FirstTouch> draw_parts_of_people(const std::vector<RightPen>& pens, const PersonsPart& part,
                                             const SequenceOptions& options,
                                             const std::function<void(double)>& progress = nullptr);

/// A stroke that a person broke off without finishing it, and drew again.
struct Redone {
  DueStroke due;
  bool finished = false;        ///< the stroke, as itself
  bool taken_for_next = false;  ///< the second draw
};

/// Draws each stroke but the last up to a share of its length, then, if that did not finish it, whole.
std::vector<Redone> redo_strokes(const std::vector<RightPen>& pens, double share, const SequenceOptions& options,
                                 const std::function<void(double)>& progress = nullptr);

}  // namespace calligraphy_test
