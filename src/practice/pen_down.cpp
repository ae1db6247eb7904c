#include "pen_down.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "render/stroke_capture.hpp"

namespace calligraphy {
namespace {

constexpr double rounding = 1e-6;    // of times [s]
constexpr double max_lost = 0.1;     // or lifts it and lowers it at the next stroke within this time [s]

/// The index of its character.
std::size_t character_of(const PenDown& down, const PracticePage& page) {
  Point middle = Point::Zero();
  for (const TimedPoint& sample : down.samples) middle += sample.point / static_cast<double>(down.samples.size());
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < page.characters.size(); ++i) {
    const Placement& placement = page.characters[i].placement;
    const Eigen::AlignedBox2d square(placement.origin, placement.origin + Point::Constant(placement.em));
    const double distance = square.exteriorDistance(middle);
    const bool is_active = static_cast<int>(i) == down.character;
    if (distance < least || (distance == least && is_active)) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace

std::vector<PenDown> pen_downs(const Recording& recording) {
  std::vector<PenDown> result;
  bool was_on_paper = false;  // in the last usable sample
  bool was_lost = false;      // since then
  std::size_t written = 0;    // the pen-down that wrote last
  for (const RecordedSample& sample : recording.samples) {
    if (!is_usable(sample)) {
      was_lost = true;
      continue;
    }
    const bool on_paper = sample.state != InteractionState::separation;
    if (on_paper) {
      const double longest = was_on_paper ? max_lost : max_bounce;
      const bool continues = !result.empty() && ((was_on_paper && !was_lost) ||
                                                 sample.time <= result.back().samples.back().time + longest + rounding);
      if (!continues) result.emplace_back().character = sample.character;
    }
    // What became of a stroke may be known only in the air, or once the next pen-down has begun.
    if (has_event(sample.events, TickEvent::stroke_finished) && !result.empty()) result[written].finished_stroke = true;
    if (on_paper) {
      PenDown& down = result.back();
      if (has_event(sample.events, TickEvent::stroke_started) && !down.finished_stroke) {
        down.captured = down.samples.size();
        down.stroke = sample.stroke;
      }
      down.pressed += std::max(0.0, sample.force.z());
      down.samples.push_back({sample.pen_tip.head<2>(), sample.time});
      if (sample.state == InteractionState::writing) written = result.size() - 1;
    }
    was_on_paper = on_paper;
    was_lost = false;
  }
  if (was_on_paper) result.back().lifted = false;
  return result;
}

std::vector<std::vector<PenDown>> pen_downs_by_character(const PracticePage& page, const Recording& recording) {
  std::vector<std::vector<PenDown>> own(page.characters.size());
  for (PenDown& down : pen_downs(recording)) own[character_of(down, page)].push_back(std::move(down));
  return own;
}

std::size_t writing_begin(const PenDown& down, const PracticePage& page, const Recording& recording) {
  std::size_t begin = down.captured;
  const auto character = static_cast<std::size_t>(down.character), stroke = static_cast<std::size_t>(down.stroke);
  if (begin == 0 || character >= page.characters.size()) return 0;
  const StrokeTolerances tolerances = recording.setup ? recording.setup->renderer.tolerances : StrokeTolerances();
  const std::vector<StrokeStart> starts = stroke_starts(page.characters[character], tolerances);
  if (stroke >= starts.size()) return 0;
  const Point captured = down.samples[begin].point;
  while (begin > 0 && (down.samples[begin].point - captured).norm() < starts[stroke].stretch) --begin;
  return begin;
}

std::vector<PenPath> pen_paths(const Recording& recording, const Placement& placement) {
  std::vector<PenPath> paths;
  for (const PenDown& down : pen_downs(recording)) {
    PenPath& path = paths.emplace_back();
    for (const TimedPoint& sample : down.samples) path.push_back((sample.point - placement.origin) / placement.em);
  }
  return paths;
}

}  // namespace calligraphy
