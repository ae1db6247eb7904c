#include "unfinished_character.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "judge/judge_constants.hpp"
#include "judge/pens/resemblance.hpp"
#include "judge/reading/stroke_direction.hpp"
#include "judge/reading/writing_order.hpp"
#include "judge/remarks/remarks_on.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;
constexpr double absurd_cost = 10.0;  // cost of a pen-down left over only because its stroke was supposed [em]

/// The path, continued with the rest of the stroke that it began, moved to where the path ends.
PenPath finished(PenPath path, const PenPath& stroke) {
  const double length = path_length(path);
  const Point shift = path.back() - points_along(stroke, std::min(length, path_length(stroke)), 2).back();
  double reached = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    reached += (stroke[i] - stroke[i - 1]).norm();
    if (reached > length) path.push_back(stroke[i] + shift);
  }
  return path;
}

bool is_written(const MatchResult& match, std::size_t stroke) {
  const auto index = static_cast<int>(stroke);
  return std::any_of(match.drawn.begin(), match.drawn.end(), [index](const DrawnStroke& drawn) {
    return (drawn.stroke <= index && index < drawn.stroke + drawn.stroke_count) || drawn.also == index;
  });
}

/// Cost of a path that wrote no stroke, as an attempt at one: its distance from the nearest beginning of a stroke,
/// forwards or backwards. Absurd if that stroke was only supposed, that is, from `count` on.
double extra_cost(const PenPath& path, const std::vector<PenPath>& lines, std::size_t count) {
  const double length = path_length(path);
  const Outline drawn = outline(path);
  double least = judge_constants.max_extra_cost - judge_constants.extra_attempt_cost;
  bool is_supposed = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const PenPath back(lines[i].rbegin(), lines[i].rend());
    for (const PenPath& line : {lines[i], back}) {
      const double distance = mean_distance(drawn, outline(line, std::min(length, path_length(line))));
      if (distance >= least) continue;
      least = distance;
      is_supposed = i >= count;
    }
  }
  return is_supposed ? absurd_cost : judge_constants.extra_attempt_cost + least;
}

/// The remarks and how far the paths are from their strokes, as one distance [em].
double cost(const MatchResult& result, std::span<const PenPath> paths, const std::vector<PenPath>& lines,
            std::size_t count) {
  double sum = 0.0;
  for (const StrokeRemark& remark : result.remarks) {
    if (remark.kind == StrokeRemarkKind::missing) {
      sum += judge_constants.missing_cost;
    } else if (remark.kind == StrokeRemarkKind::extra) {
      const auto path = static_cast<std::size_t>(remark.path);
      sum += path < paths.size() ? extra_cost(paths[path], lines, count) : absurd_cost;
    } else {
      sum += judge_constants.other_remark_cost;
    }
  }
  for (std::size_t path = 0; path < paths.size(); ++path) sum += result.drawn[path].distance;
  return sum;
}

/// Gives a stroke that was just begun when the character was broken off the direction in which it was begun, however
/// little of it there is.
void set_begun_direction(DrawnStroke& drawn, const PenPath& path, const AffineMap& fit, const PenPath& line) {
  if (drawn.direction != WritingDirection::neither || drawn.length >= judge_constants.least_share) return;
  const std::vector<Point> ends = points_along(line, std::min(path_length(line), path_length(path)), 2);
  const Point begun = fit.linear * (path.back() - path.front());
  drawn.direction =
      begun.dot(ends.back() - ends.front()) >= 0.0 ? WritingDirection::forwards : WritingDirection::backwards;
  drawn.evidence = drawn.direction == WritingDirection::forwards ? 0.0 : 1.0;
}

/// Removes what was only supposed: all but the paths that were drawn. Its strokes then count as missing.
void take_back(MatchResult& result, std::span<const PenPath> paths, const Character& character,
               const std::vector<PenPath>& lines, double least_evidence) {
  result.drawn.resize(paths.size());
  DrawnStroke& last = result.drawn.back();
  if (last.stroke >= 0) {
    set_begun_direction(last, paths.back(), result.fit, lines[static_cast<std::size_t>(last.stroke)]);
  }
  set_in_turn(result.drawn);
  double of_order = std::numeric_limits<double>::infinity();
  for (const StrokeRemark& remark : result.remarks) {
    if (remark.kind == StrokeRemarkKind::order) of_order = remark.evidence;
  }
  result.remarks = remarks_on(character, paths, result.drawn, result.fit, {of_order, least_evidence});
}

/// The match for the continuation of a character that leaves the least to remark.
/// @param others what the other paths wrote, if the last path may continue; null: it may not
MatchResult match_supposing(const Character& character, std::span<const PenPath> paths,
                            const JudgeTolerances& tolerances, const std::vector<PenPath>& lines,
                            const MatchResult* others) {
  MatchResult best;
  double least = std::numeric_limits<double>::infinity();
  // Supposes that the strokes from `count` on are still to come, and that the last path is this one.
  const auto suppose = [&](std::size_t count, const PenPath& last) {
    std::vector<PenPath> supposed(paths.begin(), paths.end());
    supposed.back() = last;
    supposed.insert(supposed.end(), lines.begin() + static_cast<std::ptrdiff_t>(count), lines.end());
    MatchResult result = match_strokes(character, supposed, {.form = false});
    const double doubt = cost(result, paths, lines, count);
    if (doubt >= least) return;
    least = doubt;
    best = std::move(result);
  };
  for (std::size_t count = 0; count <= lines.size(); ++count) {
    if (others != nullptr && count > 0 && !is_written(*others, count - 1)) {
      PenPath stroke = lines[count - 1];
      suppose(count, finished(paths.back(), stroke));
      std::reverse(stroke.begin(), stroke.end());
      suppose(count, finished(paths.back(), stroke));
    }
    suppose(count, paths.back());
  }
  take_back(best, paths, character, lines, tolerances.evidence);
  return best;
}

}  // namespace

MatchResult match_unfinished(const Character& character, std::span<const PenPath> paths,
                             const JudgeTolerances& tolerances) {
  const std::vector<PenPath> lines = middle_lines(character);
  if (path_length(paths.back()) < tap_length) return match_supposing(character, paths, tolerances, lines, nullptr);
  MatchResult others;
  if (paths.size() > 1) others = match_supposing(character, paths.first(paths.size() - 1), tolerances, lines, nullptr);
  return match_supposing(character, paths, tolerances, lines, &others);
}

}  // namespace calligraphy
