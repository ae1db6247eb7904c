#include "pen_down.hpp"

#include <algorithm>

namespace calligraphy {
namespace {

constexpr double max_bounce = 0.05;  // nobody lifts a pen and lowers it again within half a period of 10 Hz [s]

}  // namespace

std::vector<PenDown> pen_downs(const Recording& recording) {
  std::vector<PenDown> result;
  bool was_on_paper = false;
  for (const RecordedSample& sample : recording.samples) {
    const bool on_paper = is_usable(sample) && sample.state != InteractionState::separation;
    if (on_paper) {
      const bool goes_on =
          !result.empty() && (was_on_paper || sample.time <= result.back().samples.back().time + max_bounce);
      if (!goes_on) result.push_back({sample.character, {}, 0.0});
      result.back().pressed += std::max(0.0, sample.force.z());
      result.back().samples.push_back({sample.pen_tip.head<2>(), sample.time});
    }
    was_on_paper = on_paper;
  }
  return result;
}

}  // namespace calligraphy
