// Workloads for comparing and testing nearest-point methods: curves and queries from easy to adversarial.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// A curve and the queries to it, in order.
struct CurveQueries {
  std::vector<Point> control_points;  ///< four, a cubic
  std::vector<Point> queries;
};

/// All numbers derive from the seed through operations that round identically everywhere, so that every machine gets
/// the same workload (except for the last bits where a compiler fuses multiplications and additions).
struct NearestPointWorkload {
  std::string name;
  std::vector<CurveQueries> curves;
  /// Maximum error of a distance that counts as correct, relative to the diagonal of the bounding box of the control
  /// points: 1e-9, or 1e-6 where the coordinates themselves are not more precise.
  double allowed_error = 1e-9;
};

/// The 19 workloads: random box, random near, real strokes near (1 to 5 mm), real strokes box, hook, loop, cusp,
/// collinear, degenerate, near straight, symmetric, symmetric S, centre of curvature, arc centre, coordinates x 1e8,
/// offset 1e8, size 1e-12, far, on the curve. Each has `queries` queries, spread over 64 curves.
/// @param real_curves control points of cubics [m]
/// @throws ValueError when there are no real curves, one is not a cubic, or `queries` is not positive
std::vector<NearestPointWorkload> nearest_point_workloads(std::span<const std::vector<Point>> real_curves,
                                                          int queries = 16000, std::uint64_t seed = 1);

/// Control points of every cubic CSE of the characters, on squares with an edge length of `em` [m].
std::vector<std::vector<Point>> curve_control_points(std::span<const Character> characters, double em = 0.04);

}  // namespace calligraphy
