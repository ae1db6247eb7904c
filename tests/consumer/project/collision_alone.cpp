// Finds the nearest point on a stroke with nothing but the collision component.
#include <cstdio>

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/model/character_list.hpp>

int main() {
  const calligraphy::Character* const one = calligraphy::built_in_characters().find(U'一');
  if (one == nullptr) return 1;
  calligraphy::ActiveStroke stroke;
  stroke.load(calligraphy::strokes(*one)[0], {});
  const auto closest = calligraphy::nearest_point(stroke.element(0), stroke.start());
  std::printf("%g m\n", closest.distance);
  return closest.distance < 1e-12 ? 0 : 1;
}
