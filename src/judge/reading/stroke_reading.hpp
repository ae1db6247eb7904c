// How the pen-downs of a character are read: which of them wrote which strokes.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>

#include "stroke_costs.hpp"

namespace calligraphy {

/// Pen-downs and the strokes they are read as. No pen-down: a missing stroke; no stroke: an extra pen-down;
/// several strokes: joined strokes; several pen-downs: a broken stroke. A pen-down that wrote one stroke may have gone
/// on to another that is not the next: joined out of turn.
struct ReadingStep {
  std::size_t path = 0, paths = 0;
  std::size_t stroke = 0, strokes = 0;
  double cost = 0.0;
  std::optional<std::size_t> also = std::nullopt;  ///< the stroke joined out of turn

  bool is_written() const { return paths > 0 && strokes > 0; }
  bool takes_the_same(const ReadingStep& other) const {
    return paths == other.paths && strokes == other.strokes && (paths == 0 || path == other.path) &&
           (strokes == 0 || stroke == other.stroke) && also == other.also;
  }
};

/// A reading, in which every pen-down and every stroke is in exactly one step.
struct StrokeReading {
  std::vector<ReadingStep> steps;
  double cost = 0.0;                         ///< cost of all steps, before leftovers were paired [em]
  std::shared_ptr<const StrokeCosts> costs;  ///< costs at the fit of this reading
  long comparisons = 0;                      ///< comparisons of pen-downs with strokes that led to it
  /// Evidence that strokes were written in another order, if they were: 1 if it is just believed [1].
  double order_evidence = std::numeric_limits<double>::infinity();

  /// The cost of a step, which must be is_written().
  PairCost pair(const ReadingStep& step) const;
  /// Mean cost of a pen-down or a stroke, large for a careless hand [em].
  double mean_cost() const;
  /// The price of believing this reading, in which so many strokes were written out of order: for choosing among
  /// several accepted orders or forms [em].
  double price(std::size_t out_of_order) const;
};

/// The strokes of a step, which must be is_written(), as the pen draws them.
StrokeRun run_of(const ReadingStep& step, const StrokeOutlines& strokes);

/// The reading with the least cost. An order other than the right one is chosen only if it fits clearly better: by
/// twice the mean cost of this hand, or by a factor of 2, where the two orders differ.
StrokeReading read_strokes(const Character& character, const StrokeOutlines& strokes, std::span<const PenPath> paths);

}  // namespace calligraphy
