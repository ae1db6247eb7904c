// The whole loop by hand: a writer holds a simulated device, the renderer guides it through one character.
#include <algorithm>
#include <cstdio>
#include <vector>

#include <calligraphy/calligraphy.hpp>

int main() {
  using namespace calligraphy;
  const std::vector<Character> text = {*built_in_characters().find(U'永')};
  const PracticePage page = lay_out(text).at(0);
  const MotionMapping mapping = upright_page(page.width, page.height);

  const WriterSkill skill = WriterSkill::novice();
  SimulatedWriter writer(page, skill, 1);
  const Eigen::Vector3d above_the_page(page.width / 2, page.height / 2, 0.02);
  SimulatedDevice device(device_profile("desktop"), skill.grip, mapping.to_device(above_the_page));
  HapticRenderer renderer(page.characters, mapping, device.capabilities(),
                          RendererOptions::for_device(device.capabilities()));

  constexpr double period = 1e-3;  // [s]
  double largest = 0.0;
  while (!writer.done() && device.time() < 120.0) {
    const HapticTick& tick = renderer.update(device.read());
    device.write(tick.force);
    if (has_event(tick.events, TickEvent::stroke_finished)) std::printf("%6.2f s: a stroke is finished\n", tick.time);
    largest = std::max(largest, tick.force.norm());

    const VisualFeedback sight{tick.pen_tip, tick.character, tick.stroke, tick.state == InteractionState::writing};
    const Intention intention = writer.update(sight, period);
    device.set_intention({mapping.to_device(intention.position), mapping.rotation.transpose() * intention.velocity});
    device.advance(period);
  }
  std::printf("largest force %.2f N\n", largest);
  return renderer.last().character == 1 ? 0 : 1;
}
