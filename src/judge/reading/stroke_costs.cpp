#include "stroke_costs.hpp"

#include <algorithm>
#include <limits>

#include "judge/judge_constants.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr double impossible = 9.0;  // finite, because assign() computes differences [em]
constexpr double never = std::numeric_limits<double>::infinity();
constexpr PairCost impossible_pair = {never, 0.0, 0.0, false};

StrokeRun run_along(std::span<const Point> line, double length) {
  const Outline whole = outline(line);
  return {whole, centred(whole), length, length_of(whole)};
}

PairCost pair_cost(const Outline& line, const Outline& shape, const StrokeRun& run) {
  const double turned = judge_constants.turned_cost * trust_in_direction(run.length);
  const double with = accord(shape, run.shape), against = accord(shape, reversed(run.shape));
  const double forwards = mean_distance(line, run.line) + turned * (1.0 - with);
  const double backwards =
      mean_distance(line, reversed(run.line)) + turned * (1.0 - against) + judge_constants.backwards_cost;
  return {std::min(forwards, backwards), with, against, backwards < forwards};
}

}  // namespace

StrokeOutlines::StrokeOutlines(const Character& character) : lines_(middle_lines(character)) {
  for (std::size_t first = 0; first < lines_.size(); ++first) {
    std::vector<Point> line;
    double length = 0.0;
    for (std::size_t count = 1; count <= max_joined && first + count <= lines_.size(); ++count) {
      const std::vector<Point>& last = lines_[first + count - 1];
      line.insert(line.end(), last.begin(), last.end());
      length += path_length(last);
      runs_[count - 1].push_back(run_along(line, length));
    }
  }
}

bool StrokeOutlines::are_near(std::size_t first, std::size_t other) const {
  if (other == first || other == first + 1) return false;
  return (lines_[other].front() - lines_[first].back()).norm() <= judge_constants.max_apart_gap;
}

StrokeRun StrokeOutlines::apart(std::size_t first, std::size_t other) const {
  std::vector<Point> line = lines_[first];
  line.insert(line.end(), lines_[other].begin(), lines_[other].end());
  return run_along(line, length(first) + length(other));
}

double trust_in_direction(double length) {
  return std::min(1.0, judge_constants.least_trust + length / judge_constants.trust_length);
}

std::vector<DrawnLine> drawn_lines(std::span<const PenPath> paths) {
  std::vector<DrawnLine> lines;
  for (std::size_t path = 0; path < paths.size(); ++path) {
    DrawnLine& drawn = lines.emplace_back();
    drawn = {outline(paths[path]), paths[path].front(), paths[path].back(), {}};
    PenPath all = paths[path];
    for (std::size_t next = path + 1; next < std::min(path + max_broken, paths.size()); ++next) {
      all.insert(all.end(), paths[next].begin(), paths[next].end());
      drawn.with_next.push_back(outline(all));
    }
  }
  return lines;
}

StrokeCosts::StrokeCosts(const StrokeOutlines& strokes, std::span<const DrawnLine> drawn, const AffineMap& fit)
    : strokes_(&strokes), fit_(fit) {
  const auto place = [&](const Outline& line) {
    return Outline((line * fit.linear.transpose()).rowwise() + fit.offset.transpose());
  };
  for (const DrawnLine& path : drawn) {
    auto& lines = placed_.emplace_back();
    const Outline& line = lines[0] = place(path.line);
    for (std::size_t i = 0; i < path.with_next.size(); ++i) lines[i + 1] = place(path.with_next[i]);
    shapes_.push_back(centred(line));
    lengths_.push_back(length_of(line));
  }
  joined_.assign(drawn.size() * strokes.count() * max_joined, impossible_pair);
  broken_.assign(drawn.size() * strokes.count() * max_broken, impossible_pair);
  for (std::size_t path = 0; path < drawn.size(); ++path) compare_singles(path);
  for (std::size_t path = 0; path < drawn.size(); ++path) {
    compare_joined(path);
    double gap = 0.0;
    for (std::size_t next = path + 1; next < std::min(path + max_broken, drawn.size()); ++next) {
      gap = std::max(gap, (fit.linear * (drawn[next].begin - drawn[next - 1].end)).norm());
      compare_broken(path, next - path + 1, gap);
    }
  }
}

PairCost StrokeCosts::compare(const Outline& line, const Outline& shape, const StrokeRun& run) {
  ++comparisons_;
  return pair_cost(line, shape, run);
}

PairCost StrokeCosts::of_run(std::size_t path, const StrokeRun& run) const {
  return pair_cost(placed(path), shapes_[path], run);
}

void StrokeCosts::compare_singles(std::size_t path) {
  for (std::size_t stroke = 0; stroke < strokes(); ++stroke) {
    const StrokeRun& run = strokes_->run(stroke, 1);
    if (!is_tap(path)) {
      singles_.push_back(compare(placed(path), shapes_[path], run));
      continue;
    }
    const bool is_dot = run.length <= judge_constants.max_dot_length;
    const double cost = is_dot ? mean_distance(placed(path), run.line) : impossible;
    singles_.push_back({cost, 1.0, 1.0, false});
    ++comparisons_;
  }
}

void StrokeCosts::compare_joined(std::size_t path) {
  const double share =
      placed_.size() < strokes() ? judge_constants.max_joined_share_of_few : judge_constants.max_joined_share;
  for (std::size_t first = 0; first < strokes(); ++first) {
    double alone = single(path, first).cost;
    for (std::size_t count = 2; count <= std::min(max_joined, strokes() - first); ++count) {
      const StrokeRun& run = strokes_->run(first, count);
      alone = std::min(alone, single(path, first + count - 1).cost);
      if (lengths_[path] < judge_constants.min_joined_length * run.line_length) continue;
      const PairCost pair = compare(placed(path), shapes_[path], run);
      if (pair.cost >= std::min(judge_constants.max_joined_or_broken_cost, share * alone)) continue;
      joined_[(path * strokes() + first) * max_joined + count - 1] = pair;
    }
  }
}

void StrokeCosts::compare_broken(std::size_t path, std::size_t count, double gap) {
  for (std::size_t part = path; part < path + count; ++part) {
    if (is_tap(part)) return;
  }
  const Outline &all = placed(path, count), shape = centred(all);
  for (std::size_t stroke = 0; stroke < strokes(); ++stroke) {
    if (gap > judge_constants.max_broken_gap * strokes_->length(stroke)) continue;
    const PairCost pair = compare(all, shape, strokes_->run(stroke, 1));
    double alone = never;
    for (std::size_t part = path; part < path + count; ++part) alone = std::min(alone, single(part, stroke).cost);
    const double most = std::min(judge_constants.max_joined_or_broken_cost, alone + judge_constants.broken_doubt);
    if (pair.cost < most) broken_[(path * strokes() + stroke) * max_broken + count - 1] = pair;
  }
}

}  // namespace calligraphy
