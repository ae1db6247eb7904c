#include "character_form.hpp"

#include <algorithm>
#include <cmath>

#include "judge/judge_constants.hpp"
#include "judge/pens/resemblance.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr double within_line = 0.02;  // share of a line at either end in which a foot does not count as beside it [1]
constexpr std::size_t least_points_beside = 2;
// Of strokes that count in relations, and of those that are parallel [em, or 1].
constexpr double shortest_related = 0.08, shortest_with_hook = 0.15;
constexpr double least_parallel = 0.95, most_parallel_bow = 0.08, least_difference = 0.1, farthest_parallel = 0.5;
constexpr double farthest_related = 0.6;
constexpr double clearly_across = 0.7;  // cosine of the chords of straight strokes that lie side by side nowhere
constexpr double least_share_beside = 0.35, least_share_parallel = 0.3;
constexpr double least_parallel_neighbours = 0.85, least_one_sided = 0.95, least_gap = 0.06, most_gap = 0.6;

Point direction_at(const FormLine& line, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, form_points - 1);
  return line.points[after] - line.points[before];
}

double share_of(std::size_t count) { return static_cast<double>(count) / static_cast<double>(form_points); }

}  // namespace

const Point& end_of(const FormLine& line, StrokeEnd end) {
  return end == StrokeEnd::start ? line.points.front() : line.points.back();
}

std::vector<DeepCrossing> deep_crossings(const FormLine& one, const FormLine& other) {
  std::vector<DeepCrossing> found;
  for (const Crossing& each : calligraphy::crossings(one, other)) {
    const std::array<double, 4> tails = {each.on_one, one.length() - each.on_one, each.on_other,
                                         other.length() - each.on_other};
    const auto least = static_cast<std::size_t>(std::min_element(tails.begin(), tails.end()) - tails.begin());
    found.push_back({tails[least], each.on_one / std::max(one.length(), 1e-9),
                     each.on_other / std::max(other.length(), 1e-9), least < 2,
                     least % 2 == 0 ? StrokeEnd::start : StrokeEnd::end});
  }
  return found;
}

Beside beside(const FormLine& line, const FormLine& other, const std::vector<bool>& among) {
  Beside result;
  result.points.assign(form_points, false);
  double sum = 0.0, signed_sum = 0.0, parallel = 0.0;
  for (std::size_t k = 0; k < form_points; ++k) {
    if (!among.empty() && !among[k]) continue;
    const NearestPlace foot = nearest_place(line.points[k], other);
    if (foot.along <= within_line * other.length() || foot.along >= (1.0 - within_line) * other.length()) continue;
    result.points[k] = true;
    ++result.count;
    sum += foot.distance;
    signed_sum += foot.side * foot.distance;
    const double place = foot.along / std::max(other.length(), 1e-9) * static_cast<double>(form_points - 1);
    const Point here = direction_at(line, k), there = direction_at(other, static_cast<std::size_t>(std::lround(place)));
    parallel += std::abs(here.dot(there)) / std::max(here.norm() * there.norm(), 1e-9);
  }
  if (result.count < least_points_beside) return result;
  const auto count = static_cast<double>(result.count);
  result.gap = sum / count;
  result.signed_gap = signed_sum / count;
  result.parallel = parallel / count;
  return result;
}

CharacterForm::CharacterForm(const Character& character) {
  for (const Stroke& stroke : calligraphy::strokes(character)) {
    strokes.push_back(form_line(middle_line(stroke)));
    const bool may_have_hook = stroke.type->code.ends_with('G') && strokes.back().length() > shortest_with_hook;
    hooks.push_back(may_have_hook ? hook_of(strokes.back()) : std::nullopt);
    bodies.push_back(hooks.back() ? without_hook(strokes.back()) : strokes.back());
  }
  const std::size_t n = count();
  std::vector<double> bows;
  for (const FormLine& body : bodies) bows.push_back(bow(body));
  crossings.resize(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) crossings[i * n + j] = deep_crossings(bodies[i], bodies[j]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const FormLine &one = bodies[i], &other = bodies[j];
      if (i == j || other.length() < shortest_related) continue;
      if (one.box.exteriorDistance(other.box) > farthest_related) continue;
      for (const StrokeEnd end : {StrokeEnd::start, StrokeEnd::end}) {
        if (end == StrokeEnd::end && hooks[i]) continue;
        const NearestPlace foot = nearest_place(end_of(one, end), other);
        if (foot.distance > judge_constants.loose_meeting_distance) continue;
        meetings.push_back({i, end, j, foot.distance, foot.along, other.length() - foot.along});
      }
      if (!crossings_of(std::min(i, j), std::max(i, j)).empty() || one.length() < shortest_related) continue;
      const Point u = one.chord(), v = other.chord();
      const bool are_straight = std::max(std::abs(bows[i]), std::abs(bows[j])) < most_parallel_bow;
      if (are_straight && std::abs(u.dot(v)) < clearly_across * u.norm() * v.norm()) continue;
      Beside aside = beside(one, other);
      const double longer_by = one.length() - other.length();
      const bool are_parallel = are_straight && std::abs(u.dot(v)) > least_parallel * u.norm() * v.norm();
      if (i < j && are_parallel && std::abs(longer_by) > least_difference &&
          share_of(aside.count) > least_share_parallel && least_distance(one, other) < farthest_parallel) {
        parallels.push_back({i, j, longer_by});
      }
      if (share_of(aside.count) >= least_share_beside && aside.parallel > least_parallel_neighbours &&
          std::abs(aside.signed_gap) > least_one_sided * aside.gap && aside.gap >= least_gap && aside.gap <= most_gap) {
        neighbours.push_back({i, j, std::move(aside)});
      }
    }
  }
}

}  // namespace calligraphy
