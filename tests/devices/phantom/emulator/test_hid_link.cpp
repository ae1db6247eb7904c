// The link over hidapi to an emulated HID: once through hidapi-hidraw, once through hidapi-libusb.
#include <cerrno>
#include <vector>

#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

/// hidapi-hidraw and hidapi-libusb report different events: the latter ignores errors of reports.
constexpr bool through_hidraw = CALLIGRAPHY_TEST_HIDRAW;

}  // namespace

TEST_CASE("reports of a HID are delivered unchanged and in order", "[hid]") {
  PluggedTouch touch(hid_touch());
  touch.open();
  std::vector<Octets> sent;
  for (int i = 0; i < 200; ++i) {
    sent.push_back(numbered(static_cast<std::uint8_t>(i), report_size));
    touch.exchange(sent.back());
  }
  CHECK(touch.listener.packets() == sent);
  CHECK(touch.link->counts().received == 200);
  CHECK(touch.listener.changes() == Faults{DeviceFault::none});
  CHECK(touch.link->description() == "2988:0304 on bus 1, port 2, serial 540-00001");
}

TEST_CASE("a report to a HID without numbers reaches it unchanged", "[hid]") {
  PluggedTouch touch(hid_touch());
  std::vector<Octets> taken;
  touch.device.on_packet([&](std::span<const std::byte> packet) {
    taken.emplace_back();
    for (const std::byte byte : packet) taken.back().push_back(std::to_integer<std::uint8_t>(byte));
  });
  touch.open();
  touch.link->command(as_packet(numbered(0, 16)));
  for (std::uint8_t i = 1; i < 50; ++i) {
    REQUIRE(touch.link->send(as_packet(numbered(i, 16))));
    REQUIRE(touch.device.wait_for_packets(i + 1u));
  }
  REQUIRE(taken.size() == 50);
  for (std::uint8_t i = 0; i < 50; ++i) CHECK(taken[i] == numbered(i, 16));
  CHECK_FALSE(touch.link->send(as_packet(Octets(4096))));
}

TEST_CASE("an unplugged HID is reported once, found again elsewhere by its serial number, and writes again", "[hid]") {
  PluggedTouch touch(hid_touch());
  EmulatedDevice stranger(touch.bed, hid_touch("540-99999"));
  touch.open();
  touch.exchange(numbered(1, report_size));
  touch.device.unplug(GENERATE(UnplugOrder::error_first, UnplugOrder::gone_first));
  REQUIRE(touch.listener.wait_for_changes(2));
  CHECK_THROWS_WITH(touch.link->command(as_packet(numbered(2))), Catch::Contains("not plugged in"));
  stranger.plug_in(1, "2");
  touch.device.plug_in(2, "1.4");
  REQUIRE(touch.listener.wait_for_changes(3));
  REQUIRE(touch.device.wait(listens));
  touch.exchange(numbered(2, report_size));
  touch.link->send(as_packet(numbered(3)));
  REQUIRE(touch.device.wait_for_packets(1));
  CHECK(touch.listener.changes() == Faults{DeviceFault::none, DeviceFault::unplugged, DeviceFault::none});
  CHECK(touch.link->description() == "2988:0304 on bus 2, port 1.4, serial 540-00001");
  CHECK(touch.link->counts().opened == 2);
  CHECK_FALSE(listens(stranger.host()));
}

TEST_CASE("hidapi opens no HID that is being unplugged, though the system still lists it", "[hid]") {
  if (!through_hidraw) return;
  const bool write_fails_first = GENERATE(false, true);
  PluggedTouch touch(hid_touch(), {60.0, 60.0, 0.005, 60.0});
  touch.open();
  if (write_fails_first) {
    touch.device.set_taking(Taking::stalls);
    touch.link->send(as_packet(numbered(1)));
    REQUIRE(touch.listener.wait_for_none_after(1));
  }
  touch.device.let_go();
  REQUIRE(touch.listener.wait_for(DeviceFault::unplugged));
  CHECK(touch.device.host().described == 1);
  touch.device.unplug(UnplugOrder::gone_first);
  touch.device.plug_in(1, "3");
  REQUIRE(touch.device.wait([](const HostActions& host) { return host.identified > 2; }));
  CHECK(touch.device.host().described == 0);
}

TEST_CASE("a report that a HID refuses is a link error, and the device is reopened", "[hid]") {
  PluggedTouch touch(hid_touch());
  touch.open();
  touch.device.set_taking(Taking::stalls);
  touch.link->send(as_packet(numbered(1)));
  REQUIRE(touch.listener.wait_for(DeviceFault::link_error));
  touch.device.set_taking(Taking::at_once);
  REQUIRE(touch.listener.wait_for_changes(3));
  REQUIRE(touch.device.wait(listens));
  touch.exchange(numbered(2, report_size));
  CHECK(touch.listener.changes() == Faults{DeviceFault::none, DeviceFault::link_error, DeviceFault::none});
  CHECK(touch.link->counts().failed >= 1);
}

TEST_CASE("after a failed report from a HID reports resume, whether or not hidapi reports the error", "[hid]") {
  PluggedTouch touch(hid_touch());
  touch.open();
  touch.exchange(numbered(1, report_size));
  touch.device.fail_next(EPROTO);
  if (through_hidraw) {
    REQUIRE(touch.listener.wait_for_changes(3));
    CHECK(touch.listener.changes() == Faults{DeviceFault::none, DeviceFault::link_error, DeviceFault::none});
  }
  REQUIRE(touch.device.wait(listens));
  touch.exchange(numbered(2, report_size));
}

TEST_CASE("a silent HID is reported as timed out until it answers", "[hid]") {
  PluggedTouch touch(hid_touch(), {0.02, 0.02, 0.005});
  touch.link->open(touch.listener);
  REQUIRE(touch.listener.wait_for_changes(4));  // repeated while it persists
  const Faults silent = touch.listener.changes();
  CHECK(Faults(silent.begin(), silent.begin() + 4) ==
        Faults{DeviceFault::none, DeviceFault::timed_out, DeviceFault::timed_out, DeviceFault::timed_out});
  touch.exchange(numbered(1, report_size));
  REQUIRE(touch.listener.wait_for_none_after(silent.size()));
}
