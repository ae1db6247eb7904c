// Whole strokes and the path of a pen along each, for what follows a pen from tick to tick.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// A stroke and a pen that is drawn along it.
struct StrokeQueries {
  std::vector<std::vector<Point>> elements;  ///< control points of each, in writing order [m]
  std::vector<Point> path;                   ///< where the pen tip is at each tick [m]
};

struct StrokeQueryOptions {
  double em = 0.04;       ///< edge of a character's square [m]
  double rate = 1000.0;   ///< ticks per second [Hz]
  double speed = 0.05;    ///< along the stroke [m/s]
  double wobble = 0.003;  ///< the pen strays from the stroke by at most this, less on most strokes [m]
  std::uint64_t seed = 1;
};

/// One pen path along each stroke of the characters, from its start to its end. The pen strays smoothly, there and back
/// within some 20 mm, by an amplitude between 0 and `wobble` that is drawn for each stroke. The same on every machine
/// but for the last bits.
/// @throws ValueError when an option is not a positive number (`wobble`: negative)
std::vector<StrokeQueries> stroke_queries(std::span<const Character> characters,
                                          const StrokeQueryOptions& options = {});

}  // namespace calligraphy
