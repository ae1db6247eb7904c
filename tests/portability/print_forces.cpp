// print_forces: a character through the C interface, by a hand that holds a simulated device, by one that follows a
// pointer, and in a lesson: forces, events and more, one number a line, which agree to 1e-9 wherever they are computed,
// and with those of scripted_forces.mjs. How long a tick takes goes to the standard error.
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

/// A lesson written by pointers of every kind, with misses, a palm, a touch that the system takes, a bounce and
/// commands: prints its events, and the last point of each piece of ink.
class PointerScript {
 public:
  PointerScript() {
    calligraphy_capabilities profile = {sizeof profile};
    check(calligraphy_device_profile("ideal", &profile));
    calligraphy_lesson_options held = {sizeof held, CALLIGRAPHY_LESSON_GUIDED, 0, 1, 0.6, 0.0};
    check(calligraphy_lesson_create_for_pointer(page, &profile, nullptr, &held, &lesson_));
  }
  ~PointerScript() { check(calligraphy_free(lesson_)); }
  PointerScript(const PointerScript&) = delete;
  PointerScript& operator=(const PointerScript&) = delete;

  void run() {
    write(CALLIGRAPHY_POINTER_MOUSE, 1, 0, false, 1.0, -1.0, false);
    write(CALLIGRAPHY_POINTER_TOUCH, 2, 1, true, 1.0, -1.0, false);
    write(CALLIGRAPHY_POINTER_TOUCH, 3, 1, false, 0.6, -1.0, true);
    move(CALLIGRAPHY_POINTER_TOUCH, 4, 0.1, 0.03, true, false);  // a palm: a pen comes
    write(CALLIGRAPHY_POINTER_PEN, 5, 1, false, 1.0, -1.0, false);
    write(CALLIGRAPHY_POINTER_TOUCH, 6, 2, false, 1.0, -1.0, false);  // too soon after the pen
    write(CALLIGRAPHY_POINTER_PEN, 5, 2, false, 0.3, -1.0, false);
    write(CALLIGRAPHY_POINTER_PEN, 5, 2, false, 1.0, 0.5, false);
    check(calligraphy_lesson_send(lesson_, CALLIGRAPHY_LESSON_UNDO));
    write(CALLIGRAPHY_POINTER_PEN, 5, 2, false, 1.0, -1.0, false);
    check(calligraphy_lesson_send(lesson_, CALLIGRAPHY_LESSON_SKIP));
    write(CALLIGRAPHY_POINTER_MOUSE, 1, 4, false, 1.0, -1.0, false);
    check(calligraphy_lesson_advance(lesson_, now_ + 2.0, nullptr));
    print();
  }

 private:
  void move(std::int32_t kind, std::int32_t id, double x, double y, bool is_down, bool is_cancelled) {
    now_ += 0.009;
    calligraphy_pointer_sample sample = {sizeof sample, kind, id, is_down, is_cancelled, 0, now_, {x, y}};
    check(calligraphy_lesson_move_pointer(lesson_, &sample, nullptr));
  }

  /// A share of a stroke, in steps of at most 1 mm, the pointer lifted for one of them at `bounce`.
  void write(std::int32_t kind, std::int32_t id, int stroke, bool backwards, double share, double bounce,
             bool is_cancelled) {
    std::size_t count = 0;
    check(calligraphy_page_polyline(page, 0, stroke, CALLIGRAPHY_PATH, 0, nullptr, 0, &count));
    std::vector<std::array<double, 2>> points(count), line;
    check(calligraphy_page_polyline(page, 0, stroke, CALLIGRAPHY_PATH, 0, points[0].data(), count, &count));
    if (backwards) std::reverse(points.begin(), points.end());
    line.push_back(points[0]);
    for (std::size_t k = 1; k < count; ++k) {
      const auto [x0, y0] = points[k - 1];
      const auto [x1, y1] = points[k];
      const double steps = std::floor(std::sqrt((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)) / 1e-3) + 1;
      for (double i = 1; i <= steps; ++i) line.push_back({x0 + ((x1 - x0) * i) / steps, y0 + ((y1 - y0) * i) / steps});
    }
    const auto total = static_cast<double>(line.size());
    const double last = std::floor(share * (total - 1)), lifted = std::floor(bounce * total);
    if (kind != CALLIGRAPHY_POINTER_TOUCH) move(kind, id, line[0][0], line[0][1], false, false);
    for (double i = 0; i <= last; ++i) {
      const auto [x, y] = line[static_cast<std::size_t>(i)];
      move(kind, id, x, y, i != lifted, false);
    }
    const auto [x, y] = line[static_cast<std::size_t>(last)];
    move(kind, id, x, y, false, is_cancelled);
    now_ += 0.5;
    check(calligraphy_lesson_advance(lesson_, now_, nullptr));
  }

  void print() {
    calligraphy_lesson_view view = {sizeof view};
    check(calligraphy_lesson_look(lesson_, &view));
    calligraphy_lesson_event event = {sizeof event};
    for (std::int32_t found = 0; check(calligraphy_lesson_take_event(lesson_, &event, &found)), found;) {
      std::printf("%d\n%d\n%d\n%d\n%d\n%d\n%.17g\n", event.kind, event.reason, event.hint, event.stroke, event.misses,
                  event.pen_down, static_cast<double>(event.tick));
      std::printf("%.17g\n%.17g\n", event.place[0], event.place[1]);
    }
    for (std::int32_t i = 0; i < view.ink_count; ++i) {
      calligraphy_lesson_ink ink = {sizeof ink};
      check(calligraphy_lesson_read_ink(lesson_, i, &ink));
      std::array<double, 6> point = {};
      std::size_t count = 0;
      check(calligraphy_lesson_ink_points(lesson_, ink.end - 1, point.data(), 1, &count));
      std::printf("%d\n%d\n%d\n%.17g\n%.17g\n%.17g\n", ink.begin, ink.end, ink.fate, point[0], point[1], point[4]);
    }
  }

  calligraphy_lesson* lesson_ = nullptr;
  double now_ = 1.0;  ///< [s]
};

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

  PointerScript().run();

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
