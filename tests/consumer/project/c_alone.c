// Presses the pen of a simulated device on a page, using only the C interface.
#include <stdio.h>

#include <calligraphy/c/calligraphy.h>

int main(void) {
  calligraphy_set* set = NULL;
  calligraphy_page* page = NULL;
  calligraphy_renderer* renderer = NULL;
  calligraphy_capabilities device = {.size = sizeof device};
  calligraphy_device_state state = {.size = sizeof state};
  calligraphy_tick tick = {.size = sizeof tick};
  unsigned failed = calligraphy_set_built_in(&set);
  failed |= calligraphy_page_lay_out(set, "\xE6\xB0\xB8", NULL, NULL, &page);
  failed |= calligraphy_device_profile("desktop", &device);
  failed |= calligraphy_renderer_create(page, NULL, &device, NULL, &renderer);
  for (int i = 0; i < 300; ++i) {
    state.time = 1e-3 * i;
    state.position[2] = 1e-3 - 1e-5 * i;
    failed |= calligraphy_renderer_update(renderer, &state, &tick);
  }
  printf("calligraphy %s: pressed out of the paper by %.2f N%s%s\n", calligraphy_version(), tick.force[2],
         failed ? ": " : "", calligraphy_last_error());
  failed |= calligraphy_free(set);
  failed |= calligraphy_free(page);
  failed |= calligraphy_free(renderer);
  return failed != 0 || !(tick.force[2] > 0.5) ? 1 : 0;
}
