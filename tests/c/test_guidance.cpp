// Guidance laws that are functions of the program.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "allocation_counter.hpp"
#include "c_interface.hpp"
#include "pen_path.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

/// What a law in C was told, and when it fails.
struct Told {
  std::vector<const calligraphy_active_stroke*> begun;
  std::vector<calligraphy_guidance_input> inputs;
  std::size_t early = 0;  ///< inputs before the first stroke
  bool fails = false;
};

void begin(void* user, const calligraphy_active_stroke* stroke) { static_cast<Told*>(user)->begun.push_back(stroke); }

/// The linear law.
int32_t pull(void* user, const calligraphy_guidance_input* in, calligraphy_guidance_terms* terms) {
  Told& told = *static_cast<Told*>(user);
  told.inputs.push_back(*in);
  told.early += told.begun.empty();
  for (int i = 0; i < 2; ++i) terms->spring[i] = in->stiffness * in->share * (in->target[i] - in->tip[i]);
  return told.fails ? -1 : 0;
}

calligraphy_guidance_functions functions_of(Told& told, double stiffness = 0.0) {
  auto result = sized<calligraphy_guidance_functions>();
  result.user = &told;
  result.begin = begin;
  result.force = pull;
  result.stiffness = stiffness;
  return result;
}

Owned<calligraphy_renderer> renderer_with(const calligraphy_guidance_functions& functions,
                                          calligraphy_stiffness_check check = CALLIGRAPHY_STIFFNESS_REJECT) {
  auto device = profile();
  device.simulated = 1;
  auto options = options_for(device);
  options.stiffness_check = check;
  options.guidance_law = CALLIGRAPHY_GUIDANCE_OWN;
  options.guidance_functions = &functions;
  return renderer_of(page_of("永").get(), device, &options);
}

/// The same page, device and options in C++.
HapticRenderer renderer_in_cpp(GuidanceFactory force) {
  Capabilities device = device_profile("desktop");
  device.simulated = true;
  RendererOptions options = RendererOptions::for_device(device);
  options.stiffness_check = StiffnessCheck::reject;
  options.guidance.force = std::move(force);
  const PracticePage page = page_in_cpp(U"永");
  return {page.characters, upright_page(page.width, page.height), device, options};
}

/// Gives a pen that writes 永 beside its strokes, by `offset` [m], to a function, as position of the device at a time.
void write_beside(const std::function<void(double, const Eigen::Vector3d&)>& update, double offset = 0.0015) {
  const PracticePage page = page_in_cpp(U"永");
  double time = 0.0;
  const auto go = [&](const Point& at, double z) {
    update(time += 1e-3, upright_page(page.width, page.height).to_device({at.x(), at.y(), z}));
  };
  for (const Stroke& stroke : strokes(page.characters[0].character)) {
    const auto way = beside(path_of(stroke, page.characters[0].placement, 0.0002), offset);
    for (int i = 0; i < 100; ++i) go(way.front(), 5e-3 - 6e-5 * i);
    for (const Point& point : way) go(point, -0.001);
    for (int i = 0; i < 100; ++i) go(way.back(), -1e-3 + 6e-5 * i);
  }
}

/// One sample through C.
calligraphy_tick update(calligraphy_renderer* renderer, double time, const Eigen::Vector3d& position) {
  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  state.time = time;
  std::memcpy(state.position, position.data(), sizeof state.position);
  if (calligraphy_renderer_update(renderer, &state, &tick) != CALLIGRAPHY_OK) FAIL(last_error());
  return tick;
}

bool same(const Point& a, const double (&b)[2]) { return a.x() == b[0] && a.y() == b[1]; }

/// Every member of both.
bool same(const GuidanceInput& a, const calligraphy_guidance_input& b) {
  return b.size == sizeof b && same(a.tip, b.tip) && same(a.velocity, b.velocity) && same(a.target, b.target) &&
         same(a.way, b.way) && same(a.tangent, b.tangent) && a.stiffness == b.stiffness && a.damping == b.damping &&
         a.attraction == b.attraction && a.weight == b.weight && a.share == b.share && a.resistance == b.resistance &&
         a.writing == (b.writing != 0) && same(a.nearest, b.nearest) && a.distance == b.distance &&
         a.curvature == b.curvature && same(a.feature, b.feature) && a.arc == b.arc && a.left == b.left &&
         a.backwards == b.backwards && same(a.to_start, b.to_start) && a.depth == b.depth && a.em == b.em &&
         a.dt == b.dt && a.max_stiffness == b.max_stiffness;
}

}  // namespace

TEST_CASE("the linear law, written in C, is told what one in C++ is, with the built-in forces to the last bit") {
  Told told;
  std::vector<GuidanceInput> inputs;
  HapticRenderer built_in = renderer_in_cpp(linear_guidance);
  HapticRenderer watched = renderer_in_cpp({[&](const GuidanceInput& in) -> Point {
                                              inputs.push_back(in);
                                              return in.stiffness * in.share * in.way;
                                            },
                                            {.stiffness = 300.0}});
  const auto functions = functions_of(told, 300.0);
  const auto renderer = renderer_with(functions);
  std::size_t different = 0, pulled = 0;
  write_beside([&](double time, const Eigen::Vector3d& position) {
    DeviceState state;
    state.time = time;
    state.position = position;
    watched.update(state);
    const HapticTick& expected = built_in.update(state);
    const calligraphy_tick found = update(renderer.get(), time, position);
    different += std::memcmp(expected.force.data(), found.force, sizeof found.force) != 0;
    pulled += std::hypot(found.attraction[0], found.attraction[1]) > 0.1;
  });
  CHECK(different == 0);
  CHECK(pulled > 500);
  REQUIRE(told.inputs.size() == inputs.size());
  bool alike = true;
  for (std::size_t i = 0; i < inputs.size(); ++i) alike = alike && same(inputs[i], told.inputs[i]);
  CHECK(alike);
}

TEST_CASE("a law in C is told of each stroke before it is asked for a force") {
  Told told;
  const auto functions = functions_of(told);
  auto renderer = renderer_with(functions);
  auto place = sized<calligraphy_stroke_place>();
  std::size_t wrong = 0, bends = 0;  // of the places on the stroke where the pen is
  write_beside([&](double time, const Eigen::Vector3d& position) {
    update(renderer.get(), time, position);
    REQUIRE(told.early == 0);
    if (told.inputs.empty() || !told.inputs.back().writing) return;
    const calligraphy_guidance_input& in = told.inputs.back();
    // At the corner from which an element leads on, the place is still that of the element before.
    wrong += calligraphy_active_stroke_at(told.begun.back(), in.arc + 1e-9, &place) != CALLIGRAPHY_OK;
    wrong += std::hypot(place.point[0] - in.nearest[0], place.point[1] - in.nearest[1]) > 1e-6;
    wrong += std::abs(place.length - in.arc - in.left) > 1e-12;
    if (std::hypot(in.feature[0] - in.nearest[0], in.feature[1] - in.nearest[1]) < 1e-6) return;
    bends += in.curvature != 0.0;
    wrong += std::hypot(place.tangent[0] - in.tangent[0], place.tangent[1] - in.tangent[1]) > 1e-3 ||
             std::abs(place.curvature - in.curvature) > 1e-3 * std::abs(in.curvature);
  });
  CHECK(told.begun.size() >= 5);
  CHECK(wrong == 0);
  CHECK(bends > 100);
  renderer.reset();
  CHECK(calligraphy_active_stroke_at(told.begun[0], 0.0, &place) == CALLIGRAPHY_INVALID_HANDLE);
}

TEST_CASE("a law in C that fails is no force within 50 ms, and a status, until it answers again") {
  Told told;
  told.inputs.reserve(10'000);
  auto functions = functions_of(told, 300.0);
  functions.begin = nullptr;
  const auto renderer = renderer_with(functions);
  std::vector<double> forces;  // of the ticks in which it fails
  std::size_t allocated = 0, answered = 0, begin = 0;  // of its failure, while it guides
  double felt = 0.0;
  write_beside([&](double time, const Eigen::Vector3d& position) {
    if (begin == 0 && felt > 0.15 && told.inputs.size() > 400) begin = told.inputs.size();
    told.fails = begin > 0 && told.inputs.size() < begin + 100;
    const std::size_t asked = told.inputs.size(), before = allocations();
    const calligraphy_tick tick = update(renderer.get(), time, position);
    const std::size_t allocated_now = allocations() - before;
    felt = std::hypot(tick.force[0], tick.force[1]);
    if (told.inputs.size() == asked) return;
    CHECK((tick.status == CALLIGRAPHY_TICK_BAD_LAW) == told.fails);
    if (told.fails) {
      allocated += allocated_now;
      forces.push_back(std::hypot(tick.force[0], tick.force[1], tick.force[2]));
    } else {
      answered += !forces.empty() && std::hypot(tick.attraction[0], tick.attraction[1]) > 0.1;
    }
  });
  REQUIRE(forces.size() == 100);
  CHECK(forces.front() > 0.0);
  CHECK(forces[50] == 0.0);
  CHECK(allocated == 0);
  CHECK(answered > 100);
}

TEST_CASE("what is said of a law in C arrives, and the options in effect name it without its functions") {
  Told told;
  auto functions = functions_of(told, 5000.0);
  functions.name = "stiff";
  functions.begin = nullptr;
  functions.never_lets_go = 1;
  const auto clipped = renderer_with(functions, CALLIGRAPHY_STIFFNESS_CLIP);
  const char* lines = nullptr;
  REQUIRE(calligraphy_renderer_clipped(clipped.get(), &lines) == CALLIGRAPHY_OK);
  CHECK(std::string(lines).find("guidance law \"stiff\": stiffness = 5000 N/m is above") != std::string::npos);
  auto options = sized<calligraphy_renderer_options>();
  REQUIRE(calligraphy_renderer_effective_options(clipped.get(), &options) == CALLIGRAPHY_OK);
  CHECK(options.guidance_law == CALLIGRAPHY_GUIDANCE_OWN);
  CHECK(options.guidance_functions == nullptr);
  functions.stiffness = 0.0;
  const auto renderer = renderer_with(functions);
  REQUIRE(calligraphy_renderer_effective_options(renderer.get(), &options) == CALLIGRAPHY_OK);
  CHECK(options.energy_budget == 0.1);  // its stiffness is not known
  write_beside([&](double time, const Eigen::Vector3d& at) { update(renderer.get(), time, at); }, 0.006);
  const auto is_at_edge = [](const auto& in) { return in.weight < 0.9; };
  REQUIRE(std::count_if(told.inputs.begin(), told.inputs.end(), is_at_edge) > 100);
  for (const auto& in : told.inputs) REQUIRE(in.share == 1.0);  // and not `weight`: it never lets go
  functions.power = 11.0;
  options.guidance_functions = &functions;
  const auto device = profile();
  calligraphy_renderer* refused = nullptr;
  CHECK(calligraphy_renderer_create(page_of("永").get(), nullptr, &device, &options, &refused) ==
        CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("guidance law \"stiff\": power = 11 W"));
}
