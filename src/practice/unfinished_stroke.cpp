#include "unfinished_stroke.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <calligraphy/practice/stroke_matching.hpp>

#include "resemblance.hpp"

namespace calligraphy {
namespace {

constexpr double order_margin = 0.05;  // by which another stroke must fit better than the next one [em]

/// Whether each stroke of the character was written.
std::vector<bool> written_strokes(int stroke_count, const MatchResult& match) {
  std::vector<bool> written(static_cast<std::size_t>(stroke_count), false);
  for (const DrawnStroke& drawn : match.drawn) {
    for (int k = 0; drawn.stroke >= 0 && k < drawn.stroke_count; ++k) {
      written[static_cast<std::size_t>(drawn.stroke + k)] = true;
    }
  }
  return written;
}

/// The next one in order after those that were written, or the first that is left.
std::size_t next_stroke(const std::vector<bool>& written) {
  const auto last = std::find(written.rbegin(), written.rend(), true).base();
  const auto next = std::find(last, written.end(), false);
  return static_cast<std::size_t>((next != written.end() ? next : std::find(written.begin(), written.end(), false)) -
                                  written.begin());
}

/// The rest of a line behind the first `length` of it, moved to where a path ended.
void go_on(PenPath& path, const std::vector<Point>& line, double length) {
  const Point shift = path.back() - outline(line, length).back();
  double reached = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    reached += (line[i] - line[i - 1]).norm();
    if (reached > length) path.push_back(line[i] + shift);
  }
}

}  // namespace

PenPath finish_last(const Character& character, std::span<const PenPath> paths, const StrokeTolerances& tolerances) {
  PenPath last = paths.back();
  const DrawnStroke as_it_is = match_strokes(character, paths, tolerances).drawn.back();
  if (as_it_is.continues || as_it_is.stroke_count > 1) return last;
  const MatchResult others = match_strokes(character, paths.first(paths.size() - 1), tolerances);
  const std::size_t next = next_stroke(written_strokes(character.stroke_count(), others));
  const double length = path_length(last);
  const Outline drawn = outline(last);
  double least = std::numeric_limits<double>::infinity();
  std::vector<Point> nearest;
  for (std::size_t i = 0; const Stroke& stroke : strokes(character)) {
    std::vector<Point> line = middle_line(stroke, {Point::Zero(), 1.0});
    for (const bool backwards : {false, true}) {
      if (backwards) std::reverse(line.begin(), line.end());
      const double margin = i == next && !backwards ? order_margin : 0.0;
      const double cost = mean_distance(drawn, outline(line, std::min(length, path_length(line)))) - margin;
      if (cost >= least) continue;
      least = cost;
      nearest = line;
    }
    ++i;
  }
  go_on(last, nearest, length);
  return last;
}

}  // namespace calligraphy
