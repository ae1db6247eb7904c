// How the pen-downs of a character are read: which of them wrote which strokes.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>

#include "stroke_costs.hpp"
#include "stroke_outlines.hpp"

namespace calligraphy {

/// Pen-downs and the strokes that they are taken for. Without pen-downs: a stroke that is missing; without strokes: an
/// extra pen-down; several strokes: joined; two pen-downs: a broken stroke.
struct ReadingStep {
  std::size_t path = 0, paths = 0;
  std::size_t stroke = 0, strokes = 0;
  double cost = 0.0;

  bool is_written() const { return paths > 0 && strokes > 0; }
  bool takes_the_same(const ReadingStep& other) const {
    return paths == other.paths && strokes == other.strokes && (paths == 0 || path == other.path) &&
           (strokes == 0 || stroke == other.stroke);
  }
};

/// Every pen-down and every stroke is in one step.
struct StrokeReading {
  std::vector<ReadingStep> steps;
  double cost = 0.0;                         ///< of all steps, before what was left over was paired
  std::shared_ptr<const StrokeCosts> costs;  ///< at the fit of this reading
  long comparisons = 0;                      ///< of a pen-down with strokes, that led to it
  /// That strokes were written in another order, if they were: 1 where it is just believed.
  double order_evidence = std::numeric_limits<double>::infinity();

  /// Of a step that is_written().
  const PairCost& pair(const ReadingStep& step) const;
  /// The mean cost of a pen-down or a stroke: large of a careless hand.
  double mean_cost() const;
  /// What it takes to believe this reading, in which so many strokes were written out of order: to choose among several
  /// orders or forms that are accepted [em].
  double price(std::size_t out_of_order) const;
};

/// The reading of least cost; another order than the right one only where it fits clearly better: by twice the mean
/// cost of this hand, or by that factor where the two orders differ.
StrokeReading read_strokes(const Character& character, const StrokeOutlines& strokes, std::span<const PenPath> paths);

}  // namespace calligraphy
