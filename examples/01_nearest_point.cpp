// The point of a stroke nearest to the pen tip, and the weight of the guidance there.
#include <cstdio>

#include <calligraphy/collision/constraint_space.hpp>
#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/placed_character.hpp>

int main() {
  using namespace calligraphy;
  const Placement placement{{0.02, 0.02}, 0.04};                      // a square of 40 mm on the page
  const Stroke stroke = strokes(built_in_characters().at(U'北'))[3];  // 撇: one curve
  const StrokeElement element = place_elements(stroke, placement).front();
  for (const double offset : {0.0, 0.003, 0.006, 0.009}) {
    const Point tip = element.point(0.5) + Point(0.0, offset);
    const NearestPoint closest = nearest_point(element, tip);
    const double weight = guidance_weight({}, placement.em, element, tip, closest);
    std::printf("pen at (%.4f, %.4f) m: %.4f m from the stroke at t = %.4f, guidance %.0f %%\n", tip.x(), tip.y(),
                closest.distance, closest.parameter, 100.0 * weight);
  }
}
