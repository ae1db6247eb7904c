#include <calligraphy/model/typical_ink.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "base/require.hpp"
#include "typical_ink_table.hpp"

namespace calligraphy {
namespace {

static_assert(std::size(typical_inks) == typical_stroke_count);

const TypicalInk& row_of(int id) { return typical_inks[typical_stroke(id).id - 1]; }

double length_of(const Stroke& stroke) {
  constexpr double shortest = 0.05;  // [em]; for a dot that is a point
  const std::vector<Point> path = stroke_polyline(stroke);
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return std::max(length, shortest);
}

}  // namespace

double typical_half_width(int id, int stroke_count, double length) {
  require_above_zero("stroke count", stroke_count, "");
  require_above_zero("length", length, "em");
  return row_of(id).scale * std::pow(stroke_count, strokes_exponent) * std::pow(length, length_exponent);
}

StrokeInk typical_ink(int id, double half_width) {
  StrokeInk ink = row_of(id).ink;
  ink.start *= half_width;
  ink.end *= half_width;
  for (double& value : ink.shifts) value *= half_width;
  for (double& value : ink.half_widths) value *= half_width;
  for (double& value : ink.offsets) value *= half_width;
  return ink;
}

Character with_typical_ink(Character character) {
  if (!character.physics.ink.empty()) return character;
  std::vector<StrokeInk> ink;
  for (const Stroke& stroke : strokes(character)) {
    const int id = stroke.type->id;
    StrokeInk own = typical_ink(id, typical_half_width(id, character.stroke_count(), length_of(stroke)));
    own.start = own.end = 0.0;
    ink.push_back(own);
  }
  character.physics.ink = std::move(ink);
  return character;
}

}  // namespace calligraphy
