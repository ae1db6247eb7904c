// Curves and queries on which nearest-point methods are compared and tested, from easy to hostile.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// Queries to one curve, in the order in which they are to be asked.
struct CurveQueries {
  std::vector<Point> control_points;  ///< four, a cubic
  std::vector<Point> queries;
};

/// All numbers come from the seed and from operations that round alike everywhere, so that two machines compare the
/// same (but where a compiler fuses multiplications and additions: the last bits).
struct NearestPointWorkload {
  std::string name;
  std::vector<CurveQueries> curves;
  /// Largest error of a distance that counts as right, relative to the diagonal of the control points' box: 1e-9, or
  /// 1e-6 where the coordinates themselves are no finer.
  double allowed_error = 1e-9;
};

/// The 19 workloads: random box, random near, real strokes near (1 to 5 mm), real strokes box, hook, loop, cusp,
/// collinear, degenerate, near straight, symmetric, symmetric S, centre of curvature, arc centre, coordinates x 1e8,
/// offset 1e8, size 1e-12, far, on the curve. `queries` of each, spread over 64 curves.
/// @param real_curves cubics [m]
/// @throws ValueError when there are no real curves, one is no cubic, or `queries` is not positive
std::vector<NearestPointWorkload> nearest_point_workloads(std::span<const std::vector<Point>> real_curves,
                                                          int queries = 16000, std::uint64_t seed = 1);

/// Control points of every cubic CSE of the characters, written on squares of `em` [m].
std::vector<std::vector<Point>> curve_control_points(std::span<const Character> characters, double em = 0.04);

}  // namespace calligraphy
