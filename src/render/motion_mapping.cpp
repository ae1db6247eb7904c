#include <calligraphy/render/motion_mapping.hpp>

#include <Eigen/LU>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// Keeps every force finite, as does its inverse.
constexpr double min_motion_scale = 1e-6;

}  // namespace

void validate(const MotionMapping& mapping) {
  const bool is_rotation =
      mapping.rotation.allFinite() && mapping.rotation.isUnitary(1e-9) && mapping.rotation.determinant() > 0.0;
  if (!is_rotation) throw ValueError("motion mapping: rotation is not a rotation matrix");
  if (!mapping.offset.allFinite()) throw ValueError("motion mapping: offset is not finite");
  require_within("motion mapping: scale", mapping.scale, "", min_motion_scale, 1.0 / min_motion_scale);
}

MotionMapping upright_page(double width, double height, double scale) {
  MotionMapping mapping;
  mapping.scale = scale;
  mapping.offset = {0.5 * width, 0.5 * height, 0.0};
  return mapping;
}

MotionMapping desk_page(double width, double height, double scale) {
  MotionMapping mapping = upright_page(width, height, scale);
  mapping.rotation << 1.0, 0.0, 0.0,  //
      0.0, 0.0, -1.0,                 //
      0.0, 1.0, 0.0;
  return mapping;
}

}  // namespace calligraphy
