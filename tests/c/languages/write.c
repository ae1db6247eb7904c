// 永, written in C11 by a scripted pen in the hand that holds a simulated device: prints the bits of every force. The
// same in C++ is write_in_cpp.cpp and in Python test_languages.py.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <calligraphy/c/calligraphy.h>

static void check(calligraphy_status status) {
  if (status == CALLIGRAPHY_OK) return;
  fprintf(stderr, "%s\n", calligraphy_last_error());
  exit(1);
}

static calligraphy_mapping mapping = {.size = sizeof mapping};
static calligraphy_device* device;
static calligraphy_renderer* renderer;
static double pen[3] = {0.08, 0.06, 0.02};

static void tick(void) {
  calligraphy_device_state state = {.size = sizeof state};
  calligraphy_tick result = {.size = sizeof result};
  double position[3];
  for (int i = 0; i < 3; ++i) position[i] = pen[i] - mapping.offset[i];  // the page is upright
  check(calligraphy_device_intend(device, position, NULL));
  check(calligraphy_device_read(device, &state));
  check(calligraphy_renderer_update(renderer, &state, &result));
  check(calligraphy_device_write(device, result.force));
  check(calligraphy_device_advance(device, 1e-3));
  for (int i = 0; i < 3; ++i) {
    uint64_t bits;
    memcpy(&bits, &result.force[i], sizeof bits);
    printf("%016" PRIx64 "%c", bits, i < 2 ? ' ' : '\n');
  }
}

static void go(double x, double y, double z, int ticks) {
  const double from[3] = {pen[0], pen[1], pen[2]}, to[3] = {x, y, z};
  for (int i = 1; i <= ticks; ++i) {
    for (int k = 0; k < 3; ++k) pen[k] = from[k] + (to[k] - from[k]) * i / ticks;
    tick();
  }
}

int main(void) {
  calligraphy_set* set;
  calligraphy_page* page;
  calligraphy_capabilities capabilities = {.size = sizeof capabilities};
  calligraphy_placed_character character = {.size = sizeof character};
  check(calligraphy_set_built_in(&set));
  check(calligraphy_page_lay_out(set, "永", NULL, NULL, &page));
  check(calligraphy_page_mapping(page, CALLIGRAPHY_UPRIGHT, 1.0, &mapping));
  check(calligraphy_page_character(page, 0, &character));
  check(calligraphy_device_profile("desktop", &capabilities));
  check(calligraphy_renderer_create(page, &mapping, &capabilities, NULL, &renderer));
  const double start[3] = {0.0, 0.0, 0.02};
  check(calligraphy_simulated_device_create(&capabilities, NULL, start, &device));
  for (int stroke = 0; stroke < character.stroke_count; ++stroke) {
    size_t count;
    check(calligraphy_page_polyline(page, 0, stroke, CALLIGRAPHY_PATH, 1e-5, NULL, 0, &count));
    double(*points)[2] = malloc(count * sizeof *points);
    check(calligraphy_page_polyline(page, 0, stroke, CALLIGRAPHY_PATH, 1e-5, points[0], count, &count));
    go(points[0][0], points[0][1], 0.008, 200);
    for (size_t i = 0; i < count; ++i) go(points[i][0] + 0.001, points[i][1] + 0.001, -0.003, 20);
    go(pen[0], pen[1], 0.008, 80);
    free(points);
  }
  check(calligraphy_free(device));
  check(calligraphy_free(renderer));
  check(calligraphy_free(page));
  check(calligraphy_free(set));
  return calligraphy_free(set) == CALLIGRAPHY_INVALID_HANDLE ? 0 : 1;
}
