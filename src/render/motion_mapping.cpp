#include <calligraphy/render/motion_mapping.hpp>

namespace calligraphy {

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
