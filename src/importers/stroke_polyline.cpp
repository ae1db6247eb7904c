#include "stroke_polyline.hpp"

#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::recognition {

Path flattened(const StrokeInput& stroke) {
  return calligraphy::stroke_polyline(
      {&typical_stroke(stroke.id), stroke.composition().elements(), 3, stroke.control_points, {}});
}

}  // namespace calligraphy::recognition
