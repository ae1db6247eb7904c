// print_bits: nearest points and forces as bits, one number a line, which must be the same on every processor. The last
// line on stderr counts and hashes them.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

#include <calligraphy/base/random.hpp>
#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

using namespace calligraphy;

namespace {

std::uint64_t count = 0, hash = 14695981039346656037u;  // FNV-1a

void print(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  hash = (hash ^ bits) * 1099511628211u;
  ++count;
  std::printf("%016" PRIx64 "\n", bits);
}

void print(const NearestPoint& found) {
  for (const double value :
       {found.parameter, found.distance, found.point.x(), found.point.y(), found.tangent.x(), found.tangent.y()}) {
    print(value);
  }
}

Point random_point(Random& random, double low, double high) {
  const double x = random.between(low, high);
  return {x, random.between(low, high)};
}

/// Lines and curves of every degree, from what can just be told from a point to what is just too large.
void print_nearest_points() {
  Random random(1);
  for (const double size : {1.0, 0.04, 1e-12, 1e8, 1e-160, 1e-290, 1e149}) {
    for (int i = 0; i < (size == 1.0 ? 160 : 16); ++i) {
      std::vector<Point> points;
      for (int k = 0; k < 2 + i % 4; ++k) points.push_back(size * random_point(random, 0.0, 1.0));
      const StrokeElement element = prepare_element(points);
      std::vector<Point> queries;
      for (int k = 0; k < 32; ++k) queries.push_back(size * random_point(random, -1.0, 2.0));
      std::vector<NearestPoint> batch(queries.size());
      nearest_points(element, queries, batch);
      for (std::size_t k = 0; k < queries.size(); ++k) {
        print(batch[k]);
        for (const NearestPointMethod method : {NearestPointMethod::exact, NearestPointMethod::tracked,
                                                NearestPointMethod::sampled, NearestPointMethod::wang2006}) {
          NearestPointOptions options;
          options.method = method;
          print(nearest_point(element, queries[k], options));
        }
      }
    }
  }
}

/// Every stroke of a character by a pen that wanders about it, pressed into the paper.
void print_forces(const PlacedCharacter& placed, const Capabilities& device, const RendererOptions& options) {
  MotionMapping tilted;
  tilted.rotation << 0.48, 0.64, -0.6, -0.8, 0.6, 0.0, 0.36, 0.48, 0.8;
  HapticRenderer renderer({placed}, tilted, device, options);
  Random random(2);
  double time = 0.0;
  const auto go = [&](const Point& point, double z) {
    DeviceState state;
    state.position = renderer.mapping().to_device({point.x(), point.y(), z});
    state.time = time;
    time += 1.0 / renderer.options().servo_rate;
    const HapticTick& tick = renderer.update(state);
    for (const double value : tick.force) print(value);
    for (const double value : tick.attraction) print(value);
  };
  for (const Stroke& stroke : strokes(placed.character)) {
    const std::vector<StrokeElement> elements = place_elements(stroke, placed.placement);
    Point aside(0.0, 0.0);
    for (int i = 0; i < 100; ++i) go(elements.front().point(0.0), 0.005 - 8e-5 * i);
    for (const StrokeElement& element : elements) {
      for (int i = 0; i <= 300; ++i) {
        aside += random_point(random, -2e-4, 2e-4);
        go(element.point(i / 300.0) + aside, -0.003 + random.between(-1e-4, 1e-4));
      }
    }
    for (int i = 0; i < 100; ++i) go(elements.back().point(1.0) + aside, -0.003 + 8e-5 * i);
  }
}

}  // namespace

int main() {
  print_nearest_points();
  for (const char* name : {"desktop", "omni"}) {
    const Capabilities device = device_profile(name);
    RendererOptions printed = RendererOptions::wang2006();
    printed.paper.stiffness = printed.guidance.stiffness = 200.0;
    printed.guidance.wrong_way_stiffness = 100.0;
    for (const RendererOptions& options :
         {RendererOptions::for_device(device), printed, RendererOptions::everything(device)}) {
      for (const char32_t code : {U'永', U'北', U'和'}) {
        print_forces({*built_in_characters().find(code), {{0.02, 0.02}, 0.04}}, device, options);
      }
    }
  }
  std::fprintf(stderr, "%" PRIu64 " numbers, hash %016" PRIx64 "\n", count, hash);
}
