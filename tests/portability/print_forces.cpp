// print_forces: a character through the C interface, by a hand that holds a simulated device and by one that follows a
// pointer: forces and more, one number a line, which agree to 1e-9 wherever they are computed, and with those of
// scripted_forces.mjs. How long a tick takes goes to the standard error.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <calligraphy/c/calligraphy.h>

namespace {

using Position = std::array<double, 3>;

void check(calligraphy_status status) {
  if (status == CALLIGRAPHY_OK) return;
  std::fprintf(stderr, "%s\n", calligraphy_last_error());
  std::exit(1);
}

calligraphy_page* page = nullptr;
calligraphy_tick tick = {sizeof tick};
std::uint32_t events = 0;

/// Where the pen means to be, tick by tick [m, page]: 1.5 mm beside each stroke, lifted before and after it.
std::vector<Position> intended_path() {
  std::vector<Position> path;
  const auto go = [&](double x, double y, double z) {
    const auto [x0, y0, z0] = path.empty() ? Position{0.08, 0.06, 0.02} : path.back();
    const double length = std::sqrt((x - x0) * (x - x0) + (y - y0) * (y - y0) + (z - z0) * (z - z0));
    const double count = std::floor(length / 1e-4) + 1;
    for (double i = 1; i <= count; ++i) {
      path.push_back({x0 + ((x - x0) * i) / count, y0 + ((y - y0) * i) / count, z0 + ((z - z0) * i) / count});
    }
  };
  for (int stroke = 0; stroke < 5; ++stroke) {
    std::size_t count = 0;
    check(calligraphy_page_polyline(page, 0, stroke, CALLIGRAPHY_PATH, 0, nullptr, 0, &count));
    std::vector<std::array<double, 2>> points(count);
    check(calligraphy_page_polyline(page, 0, stroke, CALLIGRAPHY_PATH, 0, points[0].data(), count, &count));
    go(points.front()[0] + 0.0015, points.front()[1], 0.008);
    for (const auto& [x, y] : points) go(x + 0.0015, y, -0.003);
    go(points.back()[0] + 0.0015, points.back()[1], 0.008);
  }
  return path;
}

void print() {
  for (const double value : tick.force) std::printf("%.17g\n", value);
  for (const double value : tick.pen_tip) std::printf("%.17g\n", value);
  for (const double value : tick.attraction) std::printf("%.17g\n", value);
  std::printf("%.17g\n%d\n%d\n", tick.energy_given, tick.state, tick.hint);
  events |= tick.events;
}

}  // namespace

int main() {
  calligraphy_set* set = nullptr;
  check(calligraphy_set_built_in(&set));
  check(calligraphy_page_lay_out(set, "永", nullptr, nullptr, &page));
  const std::vector<Position> path = intended_path();
  calligraphy_capabilities profile = {sizeof profile};
  calligraphy_mapping mapping = {sizeof mapping};
  calligraphy_renderer_options options = {sizeof options};

  // A hand that holds a simulated device.
  check(calligraphy_device_profile("touch", &profile));
  check(calligraphy_page_mapping(page, CALLIGRAPHY_UPRIGHT, 1, &mapping));
  check(calligraphy_renderer_options_for(&profile, CALLIGRAPHY_PRESET_EVERYTHING, 1, CALLIGRAPHY_TOLERANCE_NORMAL,
                                         &options));
  calligraphy_renderer* renderer = nullptr;
  check(calligraphy_renderer_create(page, &mapping, &profile, &options, &renderer));
  std::vector<Position> on_device = path;
  for (Position& point : on_device) {
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] -= mapping.offset[axis];  // upright, scale 1
  }
  calligraphy_device* device = nullptr;
  check(calligraphy_simulated_device_create(&profile, nullptr, on_device[0].data(), &device));
  std::vector<calligraphy_device_state> states;
  for (const Position& position : on_device) {
    calligraphy_device_state state = {sizeof state};
    check(calligraphy_device_intend(device, position.data(), nullptr));
    check(calligraphy_device_read(device, &state));
    check(calligraphy_renderer_update(renderer, &state, &tick));
    check(calligraphy_device_write(device, tick.force));
    check(calligraphy_device_advance(device, 1e-3));
    print();
    states.push_back(state);
  }

  // A servo, and a hand that follows a pointer on the desk.
  check(calligraphy_device_profile("ideal", &profile));
  check(calligraphy_page_mapping(page, CALLIGRAPHY_DESK, 1.5, &mapping));
  calligraphy_device* pointer = nullptr;
  check(calligraphy_pointer_device_create(&profile, nullptr, nullptr, &mapping, &pointer));
  calligraphy_renderer* on_desk = nullptr;
  check(calligraphy_renderer_create(page, &mapping, &profile, nullptr, &on_desk));
  calligraphy_servo* servo = nullptr;
  check(calligraphy_servo_create(pointer, on_desk, &servo));
  for (std::size_t i = 0; i < path.size(); ++i) {
    check(calligraphy_device_move_pointer(pointer, path[i][0], path[i][1], path[i][2] < 0 ? 0.6 : 0, 0));
    check(calligraphy_servo_step(servo, static_cast<double>(i) * 1e-3, &tick));
    print();
  }
  if ((events & CALLIGRAPHY_PAGE_FINISHED) == 0) {
    std::fprintf(stderr, "the page was not finished\n");
    return 1;
  }

  // The samples again: what a tick takes, the median of several rounds.
  constexpr int passes = 20;  // as in scripted_forces.mjs
  std::vector<double> rounds(21);
  for (double& round : rounds) {
    const auto start = std::chrono::steady_clock::now();
    for (int pass = 0; pass < passes; ++pass) {
      check(calligraphy_renderer_restart(renderer));
      for (const calligraphy_device_state& state : states) check(calligraphy_renderer_update(renderer, &state, &tick));
    }
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    round = time.count() / static_cast<double>(passes * states.size());
  }
  std::sort(rounds.begin(), rounds.end());
  std::fprintf(stderr, "%.0f ns per tick in C++\n", rounds[10]);
  for (void* const handle : {static_cast<void*>(servo), static_cast<void*>(on_desk), static_cast<void*>(pointer),
                             static_cast<void*>(device), static_cast<void*>(renderer), static_cast<void*>(page),
                             static_cast<void*>(set)}) {
    check(calligraphy_free(handle));
  }
}
