#include "remark_words.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "stroke_name.hpp"

namespace calligraphy {
namespace {

std::string pen_down(int path) { return "pen-down " + std::to_string(path + 1); }

}  // namespace

RemarkWords::RemarkWords(const Character& character, const MatchResult& match, const StrokeReading& reading)
    : strokes_(strokes(character)), match_(match), reading_(reading) {}

std::string RemarkWords::stroke(int index) const {
  const auto stroke = static_cast<std::size_t>(index);
  return stroke_name(stroke, *strokes_[stroke].type);
}

std::string RemarkWords::order(int path) const {
  const int written = match_.drawn[static_cast<std::size_t>(path)].stroke;
  // The first stroke that was still to be written, of those that were written at all, and the last one written before.
  int due = static_cast<int>(strokes_.size()), last = 0;
  for (int i = 0; i < static_cast<int>(match_.drawn.size()); ++i) {
    const DrawnStroke& drawn = match_.drawn[static_cast<std::size_t>(i)];
    if (drawn.stroke < 0) continue;
    if (i < path) last = std::max(last, drawn.stroke + drawn.stroke_count - 1);
    if (i >= path && !drawn.continues) due = std::min(due, drawn.stroke);
  }
  if (written > due) return stroke(written) + " was written where " + stroke(due) + " was due";
  return stroke(written) + " was written only after " + stroke(last);
}

std::string RemarkWords::backwards(int path) const {
  return stroke(match_.drawn[static_cast<std::size_t>(path)].stroke) + " was written backwards";
}

std::string RemarkWords::other_shape(int path) const {
  return pen_down(path) + " runs neither along " + stroke(match_.drawn[static_cast<std::size_t>(path)].stroke) +
         " nor against it: it was drawn as another shape";
}

std::string RemarkWords::joined(int path) const {
  const DrawnStroke& drawn = match_.drawn[static_cast<std::size_t>(path)];
  return stroke(drawn.stroke) + " to " + stroke(drawn.stroke + drawn.stroke_count - 1) +
         " were written as one: connected writing, no mistake of order";
}

std::string RemarkWords::broken(int path) const {
  return stroke(match_.drawn[static_cast<std::size_t>(path)].stroke) + " was written in two pen-downs, " +
         std::to_string(path) + " and " + std::to_string(path + 1);
}

/// Another attempt at a stroke, or nothing that is known.
std::string RemarkWords::extra(int path) const {
  const StrokeCosts& costs = *reading_.costs;
  const auto of = static_cast<std::size_t>(path);
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < costs.strokes(); ++i) {
    if (costs.single(of, i).cost < costs.single(of, nearest).cost) nearest = i;
  }
  const auto index = static_cast<int>(nearest);
  if (costs.strokes() == 0 || costs.single(of, nearest).cost > left_over_cost) {
    return pen_down(path) + " resembles none of the strokes";
  }
  std::string text = pen_down(path) + " is another attempt at " + stroke(index);
  if (costs.single(of, nearest).backwards) text += ", backwards";
  for (std::size_t other = 0; other < match_.drawn.size(); ++other) {
    const DrawnStroke& drawn = match_.drawn[other];
    if (drawn.stroke <= index && index < drawn.stroke + drawn.stroke_count) {
      return text + ", which " + pen_down(static_cast<int>(other)) + " wrote";
    }
  }
  return text;
}

}  // namespace calligraphy
