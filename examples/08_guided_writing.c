// Guided writing in C: a hand that aims 3 mm above the strokes of 永 is pulled towards them, on a simulated device.
#include <calligraphy/c/calligraphy.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// Ends the program if a function failed.
static void check(calligraphy_status status) {
  if (status == CALLIGRAPHY_OK) return;
  fprintf(stderr, "%s\n", calligraphy_last_error());
  exit(EXIT_FAILURE);
}

int main(void) {
  calligraphy_set* set;
  calligraphy_page* page;
  calligraphy_device* device;
  calligraphy_renderer* renderer;
  calligraphy_mapping mapping = {.size = sizeof mapping};
  calligraphy_capabilities desktop = {.size = sizeof desktop};
  calligraphy_device_state state = {.size = sizeof state};
  calligraphy_tick tick = {.size = sizeof tick};
  check(calligraphy_set_built_in(&set));
  check(calligraphy_page_lay_out(set, "永", NULL, NULL, &page));
  check(calligraphy_page_mapping(page, CALLIGRAPHY_UPRIGHT, 1.0, &mapping));
  check(calligraphy_device_profile("desktop", &desktop));
  check(calligraphy_pointer_device_create(&desktop, NULL, NULL, &mapping, &device));  // in a hand that follows a pointer
  check(calligraphy_renderer_create(page, &mapping, &desktop, NULL, &renderer));

  for (int stroke = 0; tick.character == 0; ++stroke) {
    double path[2 * 256], ticks = 0.0, error = 0.0, force = 0.0;
    size_t points;
    check(calligraphy_page_polyline(page, 0, stroke, CALLIGRAPHY_PATH, 0.0, path, 256, &points));
    double x = path[0], y = path[1];  // what the hand follows: it rests at the start, then moves on at 40 mm/s
    for (size_t ms = 0, next = 0; next < points + 500; ++ms) {
      const double* to = path + 2 * (next < points ? next : points - 1);
      const double dx = to[0] - x, dy = to[1] - y, share = fmin(1.0, 40e-6 / hypot(dx, dy));
      x += share * dx, y += share * dy;
      if (ms > 800 && share == 1.0) ++next;  // past the last point, it counts the ticks of rest
      check(calligraphy_device_move_pointer(device, x, y + 0.003, ms > 500 && next < points + 200 ? 0.5 : 0.0, 0));
      check(calligraphy_device_read(device, &state));  // a millisecond after the last sample
      check(calligraphy_renderer_update(renderer, &state, &tick));
      check(calligraphy_device_write(device, tick.force));
      if (tick.events & CALLIGRAPHY_STROKE_FINISHED) {
        printf("stroke %d finished, %.1f mm beside it on average, up to %.1f N\n", stroke + 1, error / ticks, force);
      }
      if (tick.state != CALLIGRAPHY_WRITING) continue;
      ticks += 1.0, error += 1e3 * tick.distance;
      force = fmax(force, hypot(tick.page_force[0], tick.page_force[1]));
    }
  }
  void* const handles[] = {renderer, device, page, set};
  for (int i = 0; i < 4; ++i) check(calligraphy_free(handles[i]));
}
