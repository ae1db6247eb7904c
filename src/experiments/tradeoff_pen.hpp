// A pen drawn along strokes and curves: how accurate each tick's closest point is, and what the hand feels.
#pragma once

#include <vector>

#include <calligraphy/experiments/tradeoff.hpp>

#include "stroke_queries.hpp"

namespace calligraphy {

/// An error of the distance above this is not due to rounding [sizes of the curve].
inline constexpr double wrong_branch = 1e-3;
/// The method that every answer is compared with.
inline constexpr NearestPointOptions reference = {.method = NearestPointMethod::exact, .tolerance = 1e-12};

/// A stroke and the path of a pen over it.
struct TracedStroke {
  std::vector<StrokeElement> elements;
  std::vector<Point> path;
  std::vector<double> distances;  ///< to the nearest element, exact
  double size = 0.0;              ///< of the largest element
};

using TracedStrokes = std::vector<TracedStroke>;

TracedStrokes drawn_strokes(const std::vector<StrokeQueries>& queries);

/// Groups of a few strokes, short enough that most are timed undisturbed.
std::vector<TracedStrokes> in_groups(const TracedStrokes& strokes);

/// Errors of the distance at every tick, in sizes of the stroke's largest element.
std::vector<double> tick_errors(const TracedStrokes& strokes, const NearestPointOptions& options);

/// Time for all ticks [s].
double tick_time(const TracedStrokes& strokes, const NearestPointOptions& options);

/// A pen drawn along one curve: the guidance of the active element alone.
struct DrawnCurve {
  StrokeElement element;
  std::vector<Point> path;
};

/// The part of each pen path that belongs to a curve. `step`: how far the pen goes along the stroke in a tick [m].
std::vector<DrawnCurve> drawn_curves(const TracedStrokes& strokes, double step);

/// Arcs of 90 degrees, 15 to 40 mm in radius, with the pen at a constant distance of 1 to 4 mm.
std::vector<DrawnCurve> gentle_arcs(double step);

PenFeel feel(const std::vector<DrawnCurve>& curves, const NearestPointOptions& options, double stiffness);

}  // namespace calligraphy
