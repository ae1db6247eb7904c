// 250 replugs without leaking descriptors; memory is checked by the address sanitizer.
#include <filesystem>
#include <iterator>

#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

std::ptrdiff_t open_descriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
}

}  // namespace

TEST_CASE("a link survives 250 replugs without leaking a descriptor", "[plugs]") {
  // One on a serial line has nothing to do with the form of hidapi: once is enough.
  const bool hid = CALLIGRAPHY_TEST_HIDRAW ? GENERATE(true, false) : true;
  PluggedTouch touch(hid ? hid_touch() : serial_touch());
  touch.open();
  std::ptrdiff_t after_warming_up = 0;
  constexpr int plugs = 250;
  for (int i = 1; i <= plugs; ++i) {
    touch.device.unplug(i % 2 == 0 ? UnplugOrder::error_first : UnplugOrder::gone_first);
    REQUIRE(touch.listener.wait_for_changes(2 * static_cast<std::size_t>(i)));
    touch.device.plug_in(1 + i % 9, std::to_string(1 + i % 5));
    REQUIRE(touch.listener.wait_for_changes(2 * static_cast<std::size_t>(i) + 1));
    REQUIRE(touch.device.wait(listens));
    touch.exchange(numbered(static_cast<std::uint8_t>(i), report_size));
    if (i == 20) after_warming_up = open_descriptors();
  }
  CHECK(touch.link->counts().opened == plugs + 1);
  // One node of an earlier plug may still be on its way out, with the test bed's ends of its sockets.
  CHECK(open_descriptors() <= after_warming_up + 12);
  const Faults changes = touch.listener.changes();
  REQUIRE(changes.size() == 2 * plugs + 1);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    REQUIRE(changes[i] == (i % 2 == 0 ? DeviceFault::none : DeviceFault::unplugged));
  }
}
