// The link over libusb, through libusb itself, to an emulated serial device.
#include <cerrno>
#include <vector>

#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

TEST_CASE("a serial device is claimed from the system's driver, set up as a line, and returned", "[usb]") {
  const bool swapped = GENERATE(false, true);
  PluggedTouch touch(swapped ? swapped_touch() : serial_touch());
  CHECK(touch.device.host().with_driver == std::set<int>{0, 1});
  touch.open();
  REQUIRE(touch.device.wait([](const HostActions& host) { return host.flying == 4; }));
  const HostActions open = touch.device.host();
  CHECK(open.claimed == std::set<int>{0, 1});
  CHECK(open.with_driver.empty());
  CHECK(open.line_coding == Octets{0x00, 0xc2, 0x01, 0x00, 0, 0, 8});  // 115200 baud = 0x1c200
  CHECK((open.control_line & 1) == 1);
  CHECK(touch.listener.changes() == Faults{DeviceFault::none});
  CHECK(touch.link->description() ==
        (swapped ? "0301:2988 on bus 1, port 2, serial 540-00001" : "2988:0302 on bus 1, port 2, serial 540-00001"));
  touch.link.reset();
  const HostActions closed = touch.device.host();
  CHECK(closed.claimed.empty());
  CHECK(closed.with_driver == std::set<int>{0, 1});
  CHECK(closed.control_line == 0);
}

TEST_CASE("every packet is delivered unchanged and in order, including an empty one", "[usb]") {
  PluggedTouch touch;
  touch.open();
  std::vector<Octets> sent;
  for (int i = 0; i < 300; ++i) {
    const std::size_t size = i % 7 == 3 ? 0 : 1 + static_cast<std::size_t>(i * 5 % 64);
    sent.push_back(size == 0 ? Octets() : numbered(static_cast<std::uint8_t>(i), size));
    touch.exchange(sent.back());
  }
  CHECK(touch.listener.packets() == sent);
  CHECK(touch.link->counts().received == 300);
  CHECK(touch.listener.changes() == Faults{DeviceFault::none});
}

TEST_CASE("a packet reaches the device unchanged, and one that is too long is rejected", "[usb]") {
  PluggedTouch touch;
  std::vector<Octets> taken;
  touch.device.on_packet([&](std::span<const std::byte> packet) {
    taken.emplace_back();
    for (const std::byte byte : packet) taken.back().push_back(std::to_integer<std::uint8_t>(byte));
  });
  touch.open();
  for (std::uint8_t i = 0; i < 50; ++i) {
    REQUIRE(touch.link->send(as_packet(numbered(i, 16))));
    REQUIRE(touch.device.wait_for_packets(i + 1u));
  }
  REQUIRE(taken.size() == 50);
  for (std::uint8_t i = 0; i < 50; ++i) CHECK(taken[i] == numbered(i, 16));
  CHECK_FALSE(touch.link->send(as_packet(Octets(4096))));
}

TEST_CASE("while the device is busy, the newest packet replaces pending ones", "[usb]") {
  PluggedTouch touch;
  std::vector<std::uint8_t> taken;
  touch.device.on_packet(
      [&](std::span<const std::byte> packet) { taken.push_back(std::to_integer<std::uint8_t>(packet[0])); });
  touch.open();
  touch.device.set_taking(Taking::never);
  touch.link->send(as_packet(numbered(1)));
  REQUIRE(touch.device.wait([](const HostActions& host) { return host.held == 1; }));
  for (std::uint8_t i = 2; i <= 9; ++i) touch.link->send(as_packet(numbered(i)));
  touch.device.set_taking(Taking::at_once);
  REQUIRE(touch.device.wait_for_packets(2));
  CHECK(taken == std::vector<std::uint8_t>{1, 9});
  CHECK(touch.link->counts().replaced == 7);
}

TEST_CASE("a command blocks until it is sent, also from within changed()", "[usb]") {
  PluggedTouch touch;
  std::vector<std::uint8_t> taken;
  touch.device.on_packet(
      [&](std::span<const std::byte> packet) { taken.push_back(std::to_integer<std::uint8_t>(packet[0])); });
  touch.listener.on_change = [&](DeviceFault fault) {
    if (fault == DeviceFault::none) touch.link->command(as_packet(numbered(7)));
  };
  touch.open();
  CHECK(taken == std::vector<std::uint8_t>{7});
  touch.link->command(as_packet(numbered(8)));
  CHECK(taken == std::vector<std::uint8_t>{7, 8});
}

TEST_CASE("a stalled endpoint is reported, cleared and used again", "[usb]") {
  PluggedTouch touch;
  touch.open();
  touch.exchange(numbered(1));
  SECTION("from the device") {
    touch.device.fail_next(EPIPE);
    REQUIRE(touch.listener.wait_for(DeviceFault::stalled));
  }
  SECTION("to the device") {
    touch.device.set_taking(Taking::stalls);
    touch.link->send(as_packet(numbered(1)));
    REQUIRE(touch.listener.wait_for(DeviceFault::stalled));
    touch.device.set_taking(Taking::at_once);
    touch.link->send(as_packet(numbered(2)));
    REQUIRE(touch.device.wait_for_packets(1));
  }
  REQUIRE(touch.device.wait([](const HostActions& host) { return host.cleared_halts >= 1 && host.flying == 4; }));
  touch.exchange(numbered(2));
  REQUIRE(touch.listener.wait_for_changes(3));
  CHECK(touch.listener.changes() == Faults{DeviceFault::none, DeviceFault::stalled, DeviceFault::none});
  CHECK(touch.listener.packets() == std::vector<Octets>{numbered(1), numbered(2)});
  CHECK(touch.link->counts().failed >= 1);
  CHECK(touch.link->counts().opened == 1);
}

TEST_CASE("a failed transfer from the device is reported by name until a packet arrives", "[usb]") {
  struct Case {
    int error;
    DeviceFault fault;
  };
  const Case fails = GENERATE(Case{EPROTO, DeviceFault::link_error}, Case{EILSEQ, DeviceFault::link_error},
                              Case{EOVERFLOW, DeviceFault::overlong_frame});
  CAPTURE(fails.error);
  PluggedTouch touch;
  touch.open();
  touch.exchange(numbered(1));
  touch.device.fail_next(fails.error);
  REQUIRE(touch.listener.wait_for(fails.fault));
  touch.exchange(numbered(2));
  CHECK(touch.listener.changes() == Faults{DeviceFault::none, fails.fault, DeviceFault::none});
  CHECK(touch.listener.packets() == std::vector<Octets>{numbered(1), numbered(2)});
  CHECK(touch.link->counts().failed == 1);
}

TEST_CASE("a packet longer than the endpoint allows is an overlong frame", "[usb]") {
  PluggedTouch touch;
  touch.open();
  touch.device.push(Octets(65));
  REQUIRE(touch.listener.wait_for(DeviceFault::overlong_frame));
  touch.exchange(numbered(1));
  CHECK(touch.listener.packets() == std::vector<Octets>{numbered(1)});
}

TEST_CASE("a device that is silent or accepts nothing is reported as timed out until it answers", "[usb]") {
  PluggedTouch touch(serial_touch(), {0.02, 0.02, 0.005});
  touch.link->open(touch.listener);
  SECTION("it sends nothing") {
    REQUIRE(touch.listener.wait_for_changes(4));  // repeated while it persists
    const Faults silent = touch.listener.changes();
    CHECK(Faults(silent.begin(), silent.begin() + 4) ==
          Faults{DeviceFault::none, DeviceFault::timed_out, DeviceFault::timed_out, DeviceFault::timed_out});
    touch.exchange(numbered(1));
    REQUIRE(touch.listener.wait_for_none_after(silent.size()));
  }
  SECTION("it takes nothing") {
    touch.device.set_taking(Taking::never);
    CHECK_THROWS_WITH(touch.link->command(as_packet(numbered(1))),
                      Catch::Contains("serial 540-00001") && Catch::Contains("in time"));
    touch.device.set_taking(Taking::at_once);
    CHECK_NOTHROW(touch.link->command(as_packet(numbered(2))));
  }
}

TEST_CASE("an unplugged device is reported once, in whichever order the system reports it", "[usb]") {
  const UnplugOrder order = GENERATE(UnplugOrder::error_first, UnplugOrder::gone_first);
  const bool sending = GENERATE(false, true);
  PluggedTouch touch;
  touch.open();
  touch.exchange(numbered(1));
  if (sending) {
    touch.device.set_taking(Taking::never);
    touch.link->send(as_packet(numbered(1)));
    REQUIRE(touch.device.wait([](const HostActions& host) { return host.held == 1; }));
    touch.link->send(as_packet(numbered(2)));
  }
  touch.device.unplug(order);
  REQUIRE(touch.listener.wait_for_changes(2));
  CHECK_THROWS_WITH(touch.link->command(as_packet(numbered(2))), Catch::Contains("not plugged in"));
  CHECK(touch.listener.changes() == Faults{DeviceFault::none, DeviceFault::unplugged});
}

TEST_CASE("a device is found again at any port by its serial number, and reported as none", "[usb]") {
  const UnplugOrder order = GENERATE(UnplugOrder::error_first, UnplugOrder::gone_first);
  PluggedTouch touch;
  EmulatedDevice stranger(touch.bed, serial_touch("540-99999"));
  touch.open();
  touch.exchange(numbered(1));
  touch.device.unplug(order);
  REQUIRE(touch.listener.wait_for_changes(2));
  stranger.plug_in(1, "2");  // another one at its port is not mistaken for it
  touch.device.plug_in(2, "1.4");
  REQUIRE(touch.listener.wait_for_changes(3));
  REQUIRE(touch.device.wait(listens));
  touch.exchange(numbered(2));
  CHECK(touch.listener.changes() == Faults{DeviceFault::none, DeviceFault::unplugged, DeviceFault::none});
  CHECK(touch.link->description() == "2988:0302 on bus 2, port 1.4, serial 540-00001");
  CHECK(touch.link->counts().opened == 2);
  CHECK(stranger.host().claimed.empty());
}
