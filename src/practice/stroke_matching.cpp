#include <calligraphy/practice/stroke_matching.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <calligraphy/base/error.hpp>

#include "other_character.hpp"
#include "require_paths.hpp"
#include "stroke_direction.hpp"
#include "stroke_remarks.hpp"
#include "writing_box.hpp"
#include "writing_order.hpp"

namespace calligraphy {
namespace {

/// Of the pen-downs that wrote nothing and follow each other up to this one, or from it on, one that runs forwards
/// along a stroke.
std::optional<std::size_t> correction_beside(const StrokeReading& reading, std::size_t path, std::size_t stroke) {
  std::vector<bool> is_extra(reading.costs->paths(), false);
  for (const ReadingStep& step : reading.steps) {
    if (step.strokes == 0) is_extra[step.path] = true;
  }
  const auto corrects = [&](std::size_t other) {
    const PairCost& pair = reading.costs->single(other, stroke);
    return !reading.costs->is_tap(other) && !pair.backwards && pair.cost < left_over_cost;
  };
  for (std::size_t next = path + 1; next < is_extra.size() && is_extra[next]; ++next) {
    if (corrects(next)) return next;
  }
  for (std::size_t before = path; before-- > 0 && is_extra[before];) {
    if (corrects(before)) return before;
  }
  return std::nullopt;
}

/// A stroke written backwards and at once again forwards, or the other way round, was written forwards; the attempt
/// backwards is extra.
void prefer_corrections(StrokeReading& reading) {
  for (ReadingStep& wrong : reading.steps) {
    if (wrong.paths != 1 || wrong.strokes != 1) continue;
    if (!reading.costs->single(wrong.path, wrong.stroke).backwards) continue;
    const std::optional<std::size_t> correction = correction_beside(reading, wrong.path, wrong.stroke);
    if (!correction) continue;
    const auto extra = std::find_if(reading.steps.begin(), reading.steps.end(), [&](const ReadingStep& step) {
      return step.strokes == 0 && step.path == *correction;
    });
    std::swap(extra->path, wrong.path);
    wrong.cost = reading.costs->single(wrong.path, wrong.stroke).cost;
  }
}

/// Of both parts where the stroke was broken.
double distance_of(const ReadingStep& step, const StrokeReading& reading, const StrokeOutlines& strokes) {
  const StrokeCosts& costs = *reading.costs;
  const Outline& line = strokes.run(step.stroke, step.strokes).line;
  const Outline wanted = reading.pair(step).backwards ? reversed(line) : line;
  return mean_distance(step.paths > 1 ? costs.placed_with_next(step.path) : costs.placed(step.path), wanted);
}

/// What a pen-down that wrote nothing attempted: the stroke that it resembles most, along or against which it runs.
void find_attempt(DrawnStroke& drawn, std::size_t path, const StrokeReading& reading, const StrokeOutlines& strokes,
                  const StrokeTolerances& tolerances) {
  double least = left_over_cost;
  for (std::size_t stroke = 0; stroke < strokes.count() && !drawn.tap; ++stroke) {
    const double cost = reading.costs->single(path, stroke).cost;
    const WritingDirection direction = direction_of({path, 1, stroke, 1, cost}, reading, strokes, tolerances);
    if (cost > least || direction == WritingDirection::neither) continue;
    least = cost;
    drawn.attempt = static_cast<int>(stroke);
    drawn.direction = direction;
  }
}

void require_valid(const Character& character) {
  const std::vector<ValidationIssue> problems = validate(character);
  if (!problems.empty()) {
    throw ValueError("the character's stroke " + std::to_string(problems[0].stroke) + ": " + problems[0].what);
  }
}

}  // namespace

const char* to_string(WritingDirection direction) noexcept {
  switch (direction) {
    case WritingDirection::forwards:
      return "forwards";
    case WritingDirection::backwards:
      return "backwards";
    case WritingDirection::neither:
      return "neither";
    case WritingDirection::unknown:
      break;
  }
  return "unknown";
}

const char* to_string(StrokeRemarkKind kind) noexcept {
  constexpr std::array names = {"order",   "direction", "shape",     "joined",   "broken",
                                "missing", "extra",     "character", "lookalike"};
  return names[static_cast<std::size_t>(kind)];
}

int MatchResult::count(StrokeRemarkKind kind) const noexcept {
  return static_cast<int>(std::count_if(remarks.begin(), remarks.end(),
                                        [kind](const StrokeRemark& remark) { return remark.kind == kind; }));
}

MatchResult match_strokes(const Character& character, std::span<const PenPath> paths,
                          const StrokeTolerances& tolerances, const CharacterIndex* others) {
  require_valid(character);
  require_paths(paths);
  validate(tolerances);
  const double spacing = pen_spacing * shortening(paths);
  std::vector<PenPath> steady;
  for (const PenPath& path : paths) steady.push_back(without_jitter(path, spacing));
  const StrokeOutlines outlines(character);
  StrokeReading reading = read_strokes(character, outlines, steady, tolerances);
  prefer_corrections(reading);
  MatchResult match;
  match.fit = reading.costs->fit();
  match.drawn.resize(paths.size());
  for (const ReadingStep& step : reading.steps) {
    for (std::size_t path = step.path; path < step.path + step.paths; ++path) {
      DrawnStroke& drawn = match.drawn[path];
      drawn.tap = reading.costs->is_tap(path);
      if (step.strokes > 0) {
        drawn.stroke = static_cast<int>(step.stroke);
        drawn.stroke_count = static_cast<int>(step.strokes);
        drawn.continues = path > step.path;
        drawn.direction = direction_of(step, reading, outlines, tolerances);
        drawn.length = length_share(step, reading, outlines);
        drawn.distance = distance_of(step, reading, outlines);
      } else {
        find_attempt(drawn, path, reading, outlines, tolerances);
      }
    }
  }
  set_in_turn(match.drawn);
  std::optional<OtherCharacter> other;
  if (others) other = other_character(others->features(), character.code, outlines, steady, reading);
  match.remarks = remarks_on(character, paths, match.drawn, match.fit, other);
  return match;
}

}  // namespace calligraphy
