// The motion of a pen over several pen-downs, such as those of a character.
#pragma once

#include <limits>
#include <span>

#include <calligraphy/judge/pen_kinematics.hpp>

namespace calligraphy {

/// Motion over several pen-downs, in the unit of theirs. NaN where there is nothing to measure.
struct WritingMotion {
  double duration = 0.0;                                         ///< from the first touch to the last lift [s]
  double time_on_paper = 0.0;                                    ///< sum of the durations of the pen-downs [s]
  double time_in_air = 0.0;                                      ///< between the pen-downs [s]
  int pen_ups = 0;                                               ///< lifts between the first pen-down and the last
  double path_length = 0.0;                                      ///< total on the paper [unit]
  double mean_speed = std::numeric_limits<double>::quiet_NaN();  ///< path_length / time_on_paper [unit/s]
  double peak_speed = std::numeric_limits<double>::quiet_NaN();  ///< the largest of the pen-downs [unit/s]
  int velocity_peaks = 0;                                        ///< total over all pen-downs
  double smoothness = std::numeric_limits<double>::quiet_NaN();  ///< mean SPARC of the pen-downs that have one [1]
};

/// Sums up pen-downs in the order of writing.
WritingMotion writing_motion(std::span<const PenKinematics> pen_downs) noexcept;

}  // namespace calligraphy
