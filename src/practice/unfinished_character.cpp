#include "unfinished_character.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "resemblance.hpp"
#include "stroke_name.hpp"

namespace calligraphy {
namespace {

// What a remark costs [em]. A pen-down that is nothing because a stroke was supposed in its place is absurd.
constexpr double extra_cost = 10.0, missing_cost = 0.05, otherwise_cost = 0.05;

using Lines = std::vector<PenPath>;

/// A path with the rest of the stroke that it has begun, moved to where the path ends.
PenPath finished(PenPath path, const PenPath& stroke) {
  const double length = path_length(path);
  const Point shift = path.back() - outline(stroke, std::min(length, path_length(stroke))).back();
  double reached = 0.0;
  for (std::size_t i = 1; i < stroke.size(); ++i) {
    reached += (stroke[i] - stroke[i - 1]).norm();
    if (reached > length) path.push_back(stroke[i] + shift);
  }
  return path;
}

/// What is to be remarked, and how far the first `count` paths are from their strokes, as a distance [em].
double cost(const MatchResult& result, std::size_t count) {
  double sum = 0.0;
  for (const StrokeRemark& remark : result.remarks) {
    const bool is_extra = remark.kind == StrokeRemarkKind::extra, is_missing = remark.kind == StrokeRemarkKind::missing;
    sum += is_extra ? extra_cost : (is_missing ? missing_cost : otherwise_cost);
  }
  for (std::size_t path = 0; path < count; ++path) sum += result.drawn[path].distance;
  return sum;
}

/// Takes out what was only supposed, the paths from `count` on: their strokes are missing.
void take_back(MatchResult& result, std::size_t count, const Character& character) {
  result.drawn.resize(count);
  std::erase_if(result.remarks, [count](const StrokeRemark& remark) {
    return remark.path >= static_cast<int>(count) || remark.kind == StrokeRemarkKind::missing;
  });
  for (std::size_t i = 0; const Stroke& stroke : strokes(character)) {
    const int index = static_cast<int>(i++);
    const bool written = std::any_of(result.drawn.begin(), result.drawn.end(), [index](const DrawnStroke& drawn) {
      return drawn.stroke <= index && index < drawn.stroke + drawn.stroke_count;
    });
    if (!written) result.remarks.push_back(missing_remark(index, *stroke.type));
  }
}

}  // namespace

MatchResult match_unfinished(const Character& character, std::span<const PenPath> paths, bool is_lifted,
                             const StrokeTolerances& tolerances) {
  Lines lines;
  for (const Stroke& stroke : strokes(character)) lines.push_back(middle_line(stroke, {Point::Zero(), 1.0}));
  const bool goes_on = !is_lifted && path_length(paths.back()) >= tap_length;
  std::vector<std::size_t> begun = {std::min(paths.size(), lines.size())};  // the likeliest number of strokes first
  for (std::size_t i = 0; i <= lines.size(); ++i) {
    if (i != begun.front()) begun.push_back(i);
  }
  MatchResult best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t count : begun) {
    for (const bool as_it_is : {false, true}) {
      if (!as_it_is && (!goes_on || count == 0)) continue;
      Lines supposed(paths.begin(), paths.end());
      if (!as_it_is) supposed.back() = finished(supposed.back(), lines[count - 1]);
      supposed.insert(supposed.end(), lines.begin() + static_cast<std::ptrdiff_t>(count), lines.end());
      MatchResult result = match_strokes(character, supposed, tolerances);
      const double doubt = cost(result, paths.size());
      if (doubt >= least) continue;
      least = doubt;
      best = std::move(result);
    }
  }
  take_back(best, paths.size(), character);
  return best;
}

}  // namespace calligraphy
