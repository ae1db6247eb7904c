#include "stroke_verdict.hpp"

#include <algorithm>

namespace calligraphy {
namespace {

/// With normal tolerances; they follow `coverage` and `corridor`.
constexpr double usual_coverage = 0.9, usual_corridor = 0.06;

/// Least share of the length of a long stroke; of a shorter one so much may be missing [em]. By how much `coverage`
/// changes it.
constexpr double long_share = 0.67, missing = 0.075, by_coverage = 0.7;
/// What may be missing besides if the next stroke decides, and the share that is always needed.
constexpr double doubt = 0.05, least_extent = 0.55;
/// From the share `coverage` less this on it does not matter where the rest is missing; below, at most twice `slack`.
constexpr double nearly = 0.05, one_sided = 2.0;
/// Most of the length that is too much: a share, and a length [em].
constexpr double most_share = 0.3, most_length = 0.12;

/// To and fro, relative to the stroke: of a short one [em], and more of a longer one, up to a length [em], and in a
/// wider corridor [1/em].
constexpr double usual_roughest = 1.35, short_stroke = 0.15, long_stroke = 0.4, by_length = 3.4, by_corridor = 10.0;
/// A stroke bends if it bulges by so much [em], and by this share of its length in addition; what is written for it
/// then bulges by this share of that.
constexpr double bent = 0.045, bent_share = 0.035, flattest = 0.25;

/// Distances that the map may leave in the usual corridor, and those at which the follower is overruled [em].
constexpr double most_misfit = 0.025, overruled_misfit = 0.029;
/// Sine of the turn: that of a long stroke, and more for a short one [em].
constexpr double turn = 0.48, short_turn = 0.03;
constexpr double narrowest = 0.5, least_ahead = 0.5;
/// Distances of the middles, and of the ends: more for a long stroke; and that at which the follower is overruled [em].
constexpr double most_moved = 0.15, end_distance = 0.2, end_of_dot = 0.16, end_share_of_length = 0.1;
constexpr double farthest_end = 0.25;

double scaled(double misfit, const StrokeTolerances& tolerances) {
  return misfit * tolerances.corridor / usual_corridor;
}

bool is_another_shape(const ShapeMatch& match, const StrokeShape& stroke, const StrokeTolerances& tolerances) {
  const double longer = std::clamp(stroke.length - short_stroke, 0.0, long_stroke - short_stroke);
  const double wider = std::max(0.0, tolerances.corridor - usual_corridor);
  const double roughest = usual_roughest + by_length * longer + by_corridor * wider;
  const bool bends = stroke.bulge > bent + bent_share * stroke.length;
  return match.roughness > roughest || (bends && match.bulge < flattest * stroke.bulge);
}

}  // namespace

double least_share_of_way(double length, const StrokeTolerances& tolerances) noexcept {
  const double more = by_coverage * (tolerances.coverage - usual_coverage);
  const double of_short = shortest_share_of_way + std::max(more, 0.0);
  return std::clamp(1.0 - missing / length, of_short, std::max(of_short, long_share + more));
}

bool is_vetoed(const ShapeMatch& match, const StrokeShape& stroke, const StrokeTolerances& tolerances) noexcept {
  // People make a dot three times as long, and the map hardly changes the size of one.
  const double misfit = std::max(1.0, match.ahead) * scaled(overruled_misfit, tolerances);
  return is_another_shape(match, stroke, tolerances) || std::min(match.misfit, match.later_misfit) > misfit ||
         match.own_end > farthest_end + end_share_of_length * stroke.length;
}

StrokeVerdict verdict_on(const ShapeMatch& match, const StrokeShape& stroke, double hidden,
                         const StrokeTolerances& tolerances) noexcept {
  if (is_another_shape(match, stroke, tolerances)) return StrokeVerdict::refused;
  const double length = stroke.length, misfit = scaled(most_misfit, tolerances);
  const double from_end = std::max(end_distance, end_of_dot + end_share_of_length * length) + hidden;
  const bool fits = match.misfit <= misfit && match.turn <= turn + short_turn / length && match.narrowest > narrowest;
  const bool is_there = match.moved <= most_moved && match.end <= from_end && match.ahead >= least_ahead;
  const bool is_as_long = match.extent >= least_extent && match.extent <= 1.0 + most_share + most_length / length;
  if (!fits || !is_there || !is_as_long) return StrokeVerdict::refused;

  const double extent = match.extent + hidden / length, least = least_share_of_way(length, tolerances);
  const double most_missing = one_sided * tolerances.slack;
  const bool is_whole = extent > tolerances.coverage - nearly ||
                        (match.late <= most_missing && match.early - hidden <= most_missing);
  if (extent >= least && is_whole) return StrokeVerdict::finished;
  const bool is_plausible = tolerances.next_decides && extent >= least - doubt;
  return is_plausible ? StrokeVerdict::plausible : StrokeVerdict::refused;
}

}  // namespace calligraphy
