// What write.c does through the C interface, in C++.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include <calligraphy/calligraphy.hpp>

using namespace calligraphy;

int main() {
  const PracticePage page = lay_out(std::vector{built_in_characters().at(U'永')}).front();
  const MotionMapping mapping = upright_page(page.width, page.height);
  const Capabilities& capabilities = device_profile("desktop");
  HapticRenderer renderer(page.characters, mapping, capabilities, RendererOptions::for_device(capabilities));
  SimulatedDevice device(capabilities, GripImpedance(), {0.0, 0.0, 0.02});
  Eigen::Vector3d pen(0.08, 0.06, 0.02);
  const auto go = [&](const Eigen::Vector3d& to, int ticks) {
    const Eigen::Vector3d from = pen;
    for (int i = 1; i <= ticks; ++i) {
      pen = from + (to - from) * i / ticks;
      device.set_intention({pen - mapping.offset, Eigen::Vector3d::Zero()});
      const HapticTick& tick = renderer.update(device.read());
      device.write(tick.force);
      device.advance(1e-3);
      for (int k = 0; k < 3; ++k) {
        std::uint64_t bits;
        std::memcpy(&bits, &tick.force[k], sizeof bits);
        std::printf("%016" PRIx64 "%c", bits, k < 2 ? ' ' : '\n');
      }
    }
  };
  const PlacedCharacter& placed = page.characters.front();
  for (const Stroke& stroke : strokes(placed.character)) {
    std::vector<Point> points = stroke_polyline(stroke, 1e-5 / placed.placement.em);
    for (Point& point : points) point = placed.placement.to_page(point);
    go({points[0].x(), points[0].y(), 0.008}, 200);
    for (const Point& point : points) go({point.x() + 0.001, point.y() + 0.001, -0.003}, 20);
    go({pen.x(), pen.y(), 0.008}, 80);
  }
}
