// Whole strokes with a pen path along each, for testing methods that track a pen from tick to tick.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// A stroke and the path of a pen along it.
struct StrokeQueries {
  std::vector<std::vector<Point>> elements;  ///< control points of each, in writing order [m]
  std::vector<Point> path;                   ///< position of the pen tip at each tick [m]
};

/// Control points of each element of a stroke, on a square with an edge length of `em` [m].
std::vector<std::vector<Point>> elements_of(const Stroke& stroke, double em);

struct StrokeQueryOptions {
  double em = 0.04;       ///< edge length of a character's square [m]
  double rate = 1000.0;   ///< ticks per second [Hz]
  double speed = 0.05;    ///< along the stroke [m/s]
  double wobble = 0.003;  ///< maximum deviation of the pen from the stroke; less on most strokes [m]
  std::uint64_t seed = 1;
};

/// One pen path along each stroke of the characters, from start to end. The pen deviates smoothly, with a period of
/// about 20 mm and an amplitude between 0 and `wobble` that is drawn for each stroke. The paths are the same on every
/// machine except for the last bits.
/// @throws ValueError when an option is not a positive number (`wobble`: negative)
std::vector<StrokeQueries> stroke_queries(std::span<const Character> characters,
                                          const StrokeQueryOptions& options = {});

}  // namespace calligraphy
