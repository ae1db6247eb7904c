// The motion of a pen as research on handwriting measures it: speed, velocity peaks, smoothness.
#pragma once

#include <limits>
#include <span>

#include <calligraphy/judge/pen_trace.hpp>

namespace calligraphy {

/// Motion of one pen-down. Its path is low-passed first (pen_kinematics()); the unit is that of its points, for example
/// em or m.
struct PenKinematics {
  double begin = 0.0;        ///< time of the first sample [s]
  double duration = 0.0;     ///< from the first sample to the last [s]
  double path_length = 0.0;  ///< of the low-passed path [unit]
  /// path_length / duration; NaN for a pen-down of less than 50 ms [unit/s]
  double mean_speed = std::numeric_limits<double>::quiet_NaN();
  /// Largest speed along the low-passed path; NaN for a pen-down of less than 50 ms [unit/s]
  double peak_speed = std::numeric_limits<double>::quiet_NaN();
  /// Number of velocity peaks: 1 for a single fluent motion, more if the pen slows down in between or hesitates; 0 only
  /// for a pen-down of less than 50 ms or a resting pen.
  int velocity_peaks = 0;
  /// Spectral arc length (SPARC) of the speed, below 0 and higher for a smoother motion: about -1.4 for a single fluent
  /// one, whatever its size and duration; NaN for a pen-down of less than 50 ms or a resting pen [1]
  double smoothness = std::numeric_limits<double>::quiet_NaN();
};

/// Measures a pen-down with samples at any intervals; of samples with the same time, the last counts.
///
/// It is resampled by linear interpolation at even steps from the first sample to the last, as close to 5 ms (200 Hz)
/// as possible. There are at most 4,096 points, so a pen-down of more than 20 s has longer steps.
///
/// A Gaussian low-passes the path without delay. It is 3 dB down at 10 Hz, where the motion of a hand ends (Teulings
/// and Maarse 1984, Hum. Mov. Sci. 3:193-217): its standard deviation is sqrt(ln 2) / (2 pi 10 Hz) = 13.25 ms. It is
/// cut at four of them and normalised. Beyond its ends the path is continued by point reflection about them, as often
/// as needed, so that the ends stay in place and a straight uniform motion remains as it is. The speed is the norm of
/// the central difference.
///
/// A velocity peak is a local maximum of the speed that stands out from the minima beside it, on each side up to a
/// higher maximum, by at least 5 % of the peak speed (its prominence); before and after the pen-down the speed counts
/// as 0. Such peaks, or the inversions of velocity, are counted as a measure of fluency (Meulenbroek and van Galen
/// 1988; Mavrogiorgou et al. 2001); the threshold is this library's own.
///
/// SPARC (Balasubramanian, Melendez-Calderon, Roby-Brami and Burdet 2015, J. NeuroEng. Rehabil. 12:112) has its usual
/// parameters. The speed is padded with zeros to 2^4 times the next power of two (padlevel 4). Its magnitude spectrum,
/// divided by that at 0 Hz, is a curve from 0 to the last frequency up to 10 Hz at which it is at least 0.05.
/// Smoothness is minus the length of this curve, with its frequencies divided by the last.
///
/// Without samples, everything is 0 or NaN as in a new PenKinematics.
/// @throws ValueError when a number is not finite or a time before the previous one
PenKinematics pen_kinematics(std::span<const TimedPoint> pen_down);

}  // namespace calligraphy
