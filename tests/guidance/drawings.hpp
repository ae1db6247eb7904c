// Lines that are drawn for a stroke: the stroke as people draw it who mean it, and others that are not it.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <calligraphy/base/random.hpp>

#include "stroke_line.hpp"

namespace calligraphy_test {

// Honest: a character that is meant.

enum class Noise {
  none,
  displacement,  ///< of each stroke, constant along it
  distortion,    ///< of each stroke: constant, half and whole wave along it, equally strong
  warp           ///< of the square: waves of half an em to one and a half, so that neighbours are distorted alike
};

/// How people draw a character that they know.
struct PeopleDraw {
  double shift = 0.05;  ///< of the whole character, uniform in a disc of this radius [em]
  Noise noise = Noise::displacement;
  double noise_size = 0.02;  ///< RMS displacement of a point by noise [em]
  double scale = 0.0;        ///< each stroke about its start, uniform up to this share
  double rounding = 0.0;     ///< corners are cut by a mean over this length [em]
  double tremor = 0.0;       ///< amplitude of a tremor of 10 Hz across the stroke [em]
  double ends = 0.0;         ///< each end too short or too long, uniform up to this, at most a fifth of the stroke [em]
};

/// The strokes of a character as one person draws them once; `em` [m].
std::vector<StrokeLine> drawn_by_people(const std::vector<StrokeLine>& lines, const PeopleDraw& people, double em,
                                        std::uint64_t seed);

// Dishonest: none of them is the due stroke.

struct Attempt {
  StrokeLine line;
  double figure = 0.0;  ///< how different it is, or how long the stroke, where that is of interest [em]
  bool goes_on = false;  ///< the exact next stroke is drawn after it, as by one who takes the due stroke for written
};

/// What is drawn for a due stroke, all of them in turn.
using Attempts = std::function<std::vector<Attempt>(const std::vector<StrokeLine>& lines, std::size_t due,
                                                    calligraphy::Random& random)>;

/// Each later stroke that differs from the due one by more than `different` [em]: mean distance of the points that are
/// equally far along. Distorted by `noise` [em, RMS].
Attempts later_strokes(double em, double noise = 0.0, double different = 0.05);

/// The part between two shares of the length, of strokes that are at least `shortest` long [m].
Attempts part_of_stroke(double from, double to, double shortest = 0.0);

/// The same lines, each with the exact next stroke after it.
Attempts going_on(const Attempts& attempts);

/// From the end to the start.
Attempts backwards();

/// To a share of the length, and back to the start.
Attempts doubled_back(double share);

/// The line from the start to the end of each stroke that bends: that differs from it by more than `different` [em].
Attempts chord(double em, double different = 0.05);

/// The stroke, displaced across the line from its start to its end; to the left if `distance` is above 0 [m].
Attempts displaced_sideways(double distance);

/// A wave of this amplitude about the stroke, on a wavelength, or the stroke's length if that is shorter: at least one
/// whole period. [em]
struct Zigzag {
  double amplitude = 0.1, wavelength = 0.2;
  bool sine = false;        ///< or else a triangle
  bool at_extreme = false;  ///< begins there, or else on the stroke
};
StrokeLine zigzag_about(const StrokeLine& line, const Zigzag& zigzag, double em);
/// Of four wavelengths, 0.1 to 0.5 em, each beginning on the stroke and at an extreme.
Attempts zigzags(double em, double amplitude, bool sine);

inline constexpr double shortest_line = 0.2;  ///< shorter strokes are called short [em]

/// About short strokes, a tremor that goes farther aside than the stroke is thick: sine waves of 0.02, 0.03 and 0.04 em
/// on wavelengths of 0.03 and 0.05 em, six in all.
Attempts tremors(double em);

/// Loops of this radius whose centre goes along the stroke: one per two radii of the way, so that they overlap, and at
/// least three. [em]
StrokeLine loops_along(const StrokeLine& line, double radius, bool clockwise, double em);
/// Of radii of 0.03 and 0.05 em, either way, four in all: along short strokes, or along the others.
Attempts circling(double em, bool along_short);

}  // namespace calligraphy_test
