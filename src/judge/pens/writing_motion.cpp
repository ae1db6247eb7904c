#include <calligraphy/judge/writing_motion.hpp>

#include <algorithm>
#include <cmath>

namespace calligraphy {

WritingMotion writing_motion(std::span<const PenKinematics> pen_downs) noexcept {
  WritingMotion result;
  if (pen_downs.empty()) return result;
  double smoothness = 0.0;
  int smooth = 0;
  for (const PenKinematics& pen_down : pen_downs) {
    result.time_on_paper += pen_down.duration;
    result.path_length += pen_down.path_length;
    result.peak_speed = std::fmax(result.peak_speed, pen_down.peak_speed);  // of a number and NaN, the number
    result.velocity_peaks += pen_down.velocity_peaks;
    if (std::isnan(pen_down.smoothness)) continue;
    smoothness += pen_down.smoothness;
    ++smooth;
  }
  result.duration = pen_downs.back().begin + pen_downs.back().duration - pen_downs.front().begin;
  result.time_in_air = std::max(0.0, result.duration - result.time_on_paper);
  result.pen_ups = static_cast<int>(pen_downs.size()) - 1;
  if (result.time_on_paper > 0.0) result.mean_speed = result.path_length / result.time_on_paper;
  if (smooth > 0) result.smoothness = smoothness / smooth;
  return result;
}

}  // namespace calligraphy
