#include "recorded_page.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/collision/nearest_stroke_point.hpp>

#include "base/require.hpp"
#include "pen_down.hpp"

namespace calligraphy {
namespace {

/// Limit on the median distance from a finished stroke of where the pen began or left it, for the same page [em].
constexpr double max_finish_distance = 0.25;

[[noreturn]] void refuse(const std::string& why) { throw ValueError("the recording is of another page: " + why); }

int stroke_count(const PracticePage& page, int character) {
  const auto i = static_cast<std::size_t>(character);
  return i < page.characters.size() ? page.characters[i].character.stroke_count() : 0;
}

void require_indices(const PracticePage& page, const RecordedSample& sample, std::size_t index) {
  const auto require = [&](const char* what, int value, int most) {
    if (0 <= value && value <= most) return;
    refuse("sample " + std::to_string(index) + ": " + what + ' ' + std::to_string(value) + ", expected 0 to " +
           std::to_string(most));
  };
  require("character", sample.character, static_cast<int>(page.characters.size()));
  require("stroke", sample.stroke, stroke_count(page, sample.character));
  if (has_event(sample.events, TickEvent::stroke_finished) && sample.character == 0) {
    require("finished stroke", sample.stroke - 1, stroke_count(page, 0));
  }
}

/// Distance of the nearer of the two tips from the stroke [em].
double distance_from(const PracticePage& page, const StrokeIndex& finished, const std::array<Point, 2>& tips) {
  const auto [character, stroke] = finished;
  const PlacedCharacter& placed = page.characters[character];
  std::array<StrokePoint, 2> nearest;
  nearest_points(place_elements(strokes(placed.character)[stroke], placed.placement), tips, nearest);
  return std::min(nearest[0].closest.distance, nearest[1].closest.distance) / placed.placement.em;
}

}  // namespace

StrokeIndex finished_stroke(const PracticePage& page, const RecordedSample& sample) {
  const bool is_same = sample.stroke > 0;
  const int character = is_same ? sample.character : sample.character - 1;
  const int stroke = is_same ? sample.stroke - 1 : stroke_count(page, character) - 1;
  return {static_cast<std::size_t>(character), static_cast<std::size_t>(stroke)};
}

void require_same_page(const PracticePage& page, const Recording& recording) {
  const std::uint32_t id = page_id(page);
  if (recording.page != 0 && recording.page != id) {
    refuse("its page_id() is " + std::to_string(recording.page) + ", that of the page " + std::to_string(id));
  }
  std::vector<double> distances;
  double time = -std::numeric_limits<double>::infinity();
  // Where the pen began the stroke that it wrote last, and where it left it: it may be elsewhere when that is decided.
  std::optional<Point> begin, end;
  for (std::size_t i = 0; i < recording.samples.size(); ++i) {
    const RecordedSample& sample = recording.samples[i];
    require_indices(page, sample, i);
    if (is_usable(sample)) {
      if (sample.time < time) {
        throw ValueError("the recording's sample " + std::to_string(i) + ": time " + number_text(sample.time) +
                         " s is before that of a sample before it, " + number_text(time) + " s");
      }
      time = sample.time;
    }
    if (has_event(sample.events, TickEvent::stroke_finished) && begin) {
      distances.push_back(distance_from(page, finished_stroke(page, sample), {*begin, *end}));
    }
    if (sample.state != InteractionState::writing || !is_usable(sample)) continue;
    end = sample.pen_tip.head<2>();
    if (has_event(sample.events, TickEvent::stroke_started) || !begin) begin = end;
  }
  if (distances.empty()) return;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  if (*middle > max_finish_distance) {
    refuse("the strokes that it finished are " + number_text(*middle) + " em from the pen (median)");
  }
}

}  // namespace calligraphy
