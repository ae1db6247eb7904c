// How what a pen has written lies to a stroke, in another size, slant and place: worked out a little in each tick.
#pragma once

#include <array>
#include <cstddef>

#include "stroke_shape.hpp"
#include "written_path.hpp"

namespace calligraphy {

/// What a fit tells. Distances are in em, the mean offset of the character taken off.
struct ShapeMatch {
  double misfit = 0.0;        ///< mean distance (RMS) that the map from the stroke to the pen leaves
  double later_misfit = 0.0;  ///< the same without the first quarter of the pen's path: guidance may pull it aside
  double turn = 0.0;          ///< sine of the angle by which the pen's path is turned; 2 beyond a right angle
  double narrowest = 1.0;     ///< least singular value of the map [1]
  double moved = 0.0;         ///< distance of the middles
  double end = 0.0;           ///< distance of the ends
  double own_end = 0.0;       ///< the same with the starts on each other
  double late = 0.0;          ///< how far after the start it was begun, along the stroke
  double early = 0.0;         ///< how far before the end it was ended, likewise
  double extent = 1.0;        ///< length of the pen's way, as a share of an exact one's [1]
  double ahead = 1.0;         ///< how far apart the pen's ends are along the stroke's, as a share of these [1]
  double roughness = 1.0;     ///< relative to the stroke's [1]
  double bulge = 0.0;         ///< ShapeNodes::bulge() of the pen's path
};

/// Three rounds of an affine map, by least squares, and of pairing the nodes of both in order, by dynamic time warping
/// (Sakoe and Chiba, Dynamic programming algorithm optimization for spoken word recognition, 1978). Only additions,
/// products, divisions and square roots: the same to the last bit everywhere. Never allocates.
class ShapeFit {
 public:
  /// The path as it is in the first step. The character is misplaced by `misplaced` [m]. Both must stay where they are.
  void begin(const WrittenPath& written, const StrokeShape& stroke, const Point& misplaced) noexcept;
  /// Works on, for at most about 0.2 us. Returns whether match() is known.
  bool step() noexcept;
  bool is_done() const noexcept { return round_ > rounds; }
  const ShapeMatch& match() const noexcept { return match_; }

  static constexpr int max_steps = 20;  ///< after which it is done

 private:
  static constexpr int rounds = 3;
  static constexpr std::size_t nodes = ShapeNodes::count;
  /// Nodes that are paired are at most this far from each other along both paths.
  static constexpr std::size_t band = 5;

  void read_path() noexcept;
  void map() noexcept;
  void add_rows() noexcept;
  void pair_up() noexcept;
  void measure() noexcept;

  const WrittenPath* written_ = nullptr;
  const StrokeShape* stroke_ = nullptr;
  ShapeNodes pen_;     ///< relative to the stroke's first point
  ShapeNodes mapped_;  ///< the stroke's, to where the pen's lie
  Point misplaced_ = Point::Zero();
  double turned_ = 0.0, along_ = 0.0;  ///< sine and cosine of the similarity nearest to the map, times its size
  int round_ = rounds + 1;  ///< from 1; 0 before the path is read
  bool is_mapped_ = false;  ///< in this round
  std::size_t row_ = 0;     ///< the next one of the sums
  /// Least sums of squared distances up to each pair of nodes: sums_[i][j - i + band + 1], infinite beyond the band.
  std::array<std::array<double, 2 * band + 3>, nodes> sums_;
  std::array<unsigned char, 2 * nodes> pen_paired_, stroke_paired_;
  std::size_t pairs_ = 0, later_pairs_ = 0;
  double square_ = 0.0, later_square_ = 0.0;  ///< sums of their squared distances; later: as in ShapeMatch
  ShapeMatch match_;
};

}  // namespace calligraphy
