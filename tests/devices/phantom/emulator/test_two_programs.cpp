// One device and two users: hidraw would deliver its reports to both, and accept forces from both.
#include <filesystem>
#include <system_error>

#include <calligraphy/base/error.hpp>

#include "other_program.hpp"
#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;
using calligraphy::phantom::Link;
using calligraphy::phantom::make_link;

namespace {

const auto in_use =
    Catch::Matches("2988:0304 on bus 1, port 2, serial 540-00001: it is in use .*: close the other program.*");

/// Nodes of devices that this program has open, by the links or otherwise.
int open_nodes() {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    const std::string file = std::filesystem::read_symlink(entry.path(), gone).string();
    const bool of_device =
        file.find("/dev/hidraw") != std::string::npos || file.find("/dev/bus/usb/") != std::string::npos;
    if (of_device) ++count;
  }
  return count;
}

/// Whether the device can be opened, otherwise the error message.
std::string opened_for_a_moment() {
  RecordingListener listener;
  const std::unique_ptr<Link> link = make_link("", patient);
  try {
    link->open(listener);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "open";
}

}  // namespace

TEST_CASE("other program: has the device until it is told to end", "[.]") {
  RecordingListener listener;
  const std::unique_ptr<Link> link = make_link("", patient);
  link->open(listener);
  say("open");
  wait_for_the_end();
}

TEST_CASE("other program: tries to open the device", "[.]") { say(opened_for_a_moment()); }

TEST_CASE("a HID that this program has open cannot be opened again until it is closed", "[hid]") {
  PluggedTouch touch(hid_touch());
  touch.open();
  RecordingListener second;
  const std::unique_ptr<Link> link = make_link("", patient);
  CHECK_THROWS_WITH(link->open(second), in_use);
  CHECK(second.changes().empty());
  touch.exchange(numbered(1, report_size));  // the first user is not affected
  touch.link->command(as_packet(numbered(2, 16)));
  CHECK(touch.listener.changes() == Faults{DeviceFault::none});
  touch.link.reset();
  CHECK_NOTHROW(link->open(second));
  CHECK(second.changes() == Faults{DeviceFault::none});
}

TEST_CASE("a HID that this program has open cannot be opened by another program", "[hid]") {
  PluggedTouch touch(hid_touch());
  touch.open();
  CHECK_THAT(OtherProgram("other program: tries to open the device").heard(), in_use);
  touch.exchange(numbered(1, report_size));
  touch.link.reset();
  CHECK(OtherProgram("other program: tries to open the device").heard() == "open");
}

TEST_CASE("a HID that another program has open is free again when that program ends or is killed", "[hid]") {
  PluggedTouch touch(hid_touch());
  OtherProgram other("other program: has the device until it is told to end");
  REQUIRE(other.heard() == "open");
  CHECK_THROWS_WITH(touch.link->open(touch.listener), in_use);
  const bool killed = GENERATE(true, false);
  killed ? other.kill() : other.end();
  touch.open();
  touch.exchange(numbered(1, report_size));
}

TEST_CASE("a reconnected HID goes to the first program that opens it, and is free when that one loses it", "[hid]") {
  PluggedTouch touch(hid_touch());
  const int before = open_nodes();  // the test bed's own
  touch.open();
  CHECK(open_nodes() > before);
  touch.device.unplug(UnplugOrder::gone_first);
  REQUIRE(touch.listener.wait_for(DeviceFault::unplugged));
  CHECK(open_nodes() <= before);  // no lock is left on a device that is gone
  touch.device.plug_in(2, "1.4");
  REQUIRE(touch.listener.wait_for_changes(3));
  CHECK_THAT(opened_for_a_moment(), Catch::Contains("on bus 2, port 1.4") && Catch::Contains("in use"));
  touch.link.reset();
  CHECK(opened_for_a_moment() == "open");
}

TEST_CASE("two identical HIDs are locked independently", "[hid]") {
  FreshBed bed;
  EmulatedDevice first(bed, hid_touch("A1")), second(bed, hid_touch("B2"));
  first.plug_in(1, "1");
  second.plug_in(1, "2");
  RecordingListener of_first, of_second, of_third;
  const std::unique_ptr<Link> to_first = make_link("A1", patient), to_second = make_link("B2", patient),
                              again = make_link("B2", patient);
  to_first->open(of_first);
  CHECK_NOTHROW(to_second->open(of_second));
  CHECK_THROWS_WITH(again->open(of_third), Catch::Contains("serial B2") && Catch::Contains("in use"));
}
