// The list of connected devices of an emulated bus, and which of several is opened.
#include <sys/stat.h>

#include <cerrno>
#include <sstream>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/phantom/packet_capture.hpp>

#include "as_nobody.hpp"
#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;
using calligraphy::phantom::Link;
using calligraphy::phantom::make_link;

namespace {

UsbIdentity any_touch(const std::string& serial = "540-00001") {
  return GENERATE(true, false) ? serial_touch(serial) : hid_touch(serial);
}

}  // namespace

TEST_CASE("every Phantom on the bus is listed by bus and port, other devices are not", "[list]") {
  FreshBed bed;
  EmulatedDevice hid(bed, hid_touch("H1")), usb(bed, serial_touch("U1")), swapped(bed, swapped_touch("S1"));
  EmulatedDevice mouse(bed, {0x046d, 0xc077, LinkKind::hid, "M1"});
  CHECK(plugged_devices().empty());
  hid.plug_in(2, "1.4");
  usb.plug_in(1, "2");
  swapped.plug_in(2, "3");
  mouse.plug_in(1, "1");
  const std::vector<PluggedDevice> devices = plugged_devices();
  REQUIRE(devices.size() == 3);
  CHECK(describe_device(devices[0]) == "2988:0302 on bus 1, port 2, serial U1");
  CHECK(describe_device(devices[1]) == "2988:0304 on bus 2, port 1.4, serial H1");
  CHECK(describe_device(devices[2]) == "0301:2988 on bus 2, port 3, serial S1");
  CHECK(devices[0].link == LinkKind::usb);
  CHECK(devices[1].link == LinkKind::hid);
  CHECK(devices[2].link == LinkKind::usb);
  CHECK(devices[0].nodes == std::vector<std::string>{"/dev/bus/usb/001/002"});
  CHECK(devices[1].nodes == std::vector<std::string>{"/dev/bus/usb/002/003", "/dev/hidraw0"});
  for (const PluggedDevice& device : devices) {
    CHECK(device.may_open);
    CHECK(device.advice.empty());
    CHECK_THAT(device.model, Catch::StartsWith("Touch"));
  }
}

TEST_CASE("a device that may not be opened is listed, and the message names the udev rule", "[list]") {
  FreshBed bed;
  EmulatedDevice touch(bed, any_touch());
  touch.plug_in(1, "2");
  for (const std::string& file : touch.node_files()) REQUIRE(chmod(file.c_str(), 0600) == 0);
  {
    const AsNobody nobody;
    const std::vector<PluggedDevice> devices = plugged_devices();
    REQUIRE(devices.size() == 1);
    CHECK_FALSE(devices[0].may_open);
    CHECK(devices[0].serial == "540-00001");
    CHECK_THAT(devices[0].advice, Catch::Contains("60-calligraphy.rules") && Catch::Contains("udevadm"));
    CHECK_THROWS_WITH(make_link(""), Catch::Contains("2988:030") && Catch::Contains("60-calligraphy.rules"));
    RecordingListener listener;
    const std::unique_ptr<Link> link = make_link(devices[0]);
    CHECK_THROWS_WITH(link->open(listener), Catch::Contains("60-calligraphy.rules"));
    CHECK(listener.changes().empty());
  }
  RecordingListener listener;
  const std::unique_ptr<Link> link = make_link("", patient);
  CHECK_NOTHROW(link->open(listener));
}

TEST_CASE("two identical devices are opened by their serial numbers at the same time", "[list]") {
  FreshBed bed;
  EmulatedDevice first(bed, any_touch("A1")),
      second(bed, {first.identity().vendor, first.identity().product, first.identity().link, "B2"});
  first.plug_in(1, "1");
  second.plug_in(1, "2");
  CHECK_THROWS_WITH(make_link(""), Catch::Contains("serial A1") && Catch::Contains("serial B2"));
  CHECK_THROWS_WITH(make_link("C3"), Catch::Contains("C3") && Catch::Contains("serial B2"));
  RecordingListener of_first, of_second;
  const std::unique_ptr<Link> to_second = make_link("B2", patient), to_first = make_link("A1", patient);
  to_second->open(of_second);
  to_first->open(of_first);
  CHECK(to_first->serial() == "A1");
  REQUIRE(first.wait(listens));
  REQUIRE(second.wait(listens));
  first.push(numbered(1, report_size));
  second.push(numbered(2, report_size));
  REQUIRE(of_first.wait_for_packets(1));
  REQUIRE(of_second.wait_for_packets(1));
  CHECK(of_first.packets().front() == numbered(1, report_size));
  CHECK(of_second.packets().front() == numbered(2, report_size));
  to_first->command(as_packet(numbered(3)));
  CHECK(first.packets_taken() == 1);
  CHECK(second.packets_taken() == 0);
}

TEST_CASE("without a connected device the message says so", "[list]") {
  FreshBed bed;
  CHECK_THROWS_WITH(make_link(""), Catch::Contains("no Phantom is plugged in"));
  CHECK_THROWS_WITH(make_link("A1"), Catch::Contains("A1"));
}

TEST_CASE("descriptors are dumped as text and bytes without opening the device", "[list]") {
  FreshBed bed;
  EmulatedDevice usb(bed, serial_touch("U1")), hid(bed, hid_touch("H1"));
  usb.plug_in(1, "2");
  hid.plug_in(1, "3");
  for (const EmulatedDevice* device : {&usb, &hid}) {
    for (const std::string& file : device->node_files()) REQUIRE(chmod(file.c_str(), 0600) == 0);
  }
  const AsNobody nobody;
  const std::vector<PluggedDevice> devices = plugged_devices();
  REQUIRE(devices.size() == 2);
  const std::string serial = dump_descriptors(devices[0]);
  CHECK_THAT(serial, Catch::Contains("device 2988:0302, USB 2.00") && Catch::Contains("88 29 02 03") &&
                         Catch::Contains("67 bytes in total") && Catch::Contains("interface 1, setting 0, class 0a") &&
                         Catch::Contains("endpoint 1 to the host, bulk, packets of 64 bytes") &&
                         Catch::Contains("endpoint 2 to the device, bulk, packets of 64 bytes"));
  const std::string reports = dump_descriptors(devices[1]);
  CHECK_THAT(reports, Catch::Contains("HID 1.11, report descriptor of 27 bytes") &&
                          Catch::Contains("usage page 65280") && Catch::Contains("logical maximum 255") &&
                          Catch::Contains("report count 44") && Catch::Contains("input (data, variable, absolute)") &&
                          Catch::Contains("end collection"));
}

TEST_CASE("a capture has all transfers with their times, and its text can be read back", "[list]") {
  FreshBed bed;
  EmulatedDevice touch(bed, serial_touch("U1"));
  touch.plug_in(1, "2");
  const PluggedDevice device = plugged_devices().front();
  CHECK_THROWS_AS(capture_packets(device, {0, 1.0}), ValueError);
  CHECK_THROWS_AS(capture_packets(device, {1, -1.0}), ValueError);
  for (std::uint8_t i = 0; i < 3; ++i) touch.push(numbered(i, 2));
  touch.push({});
  const PacketCapture got = capture_packets(device, {4, 10.0});
  REQUIRE(got.transfers.size() == 4);
  std::ostringstream text;
  write_packet_capture(text, got);
  std::istringstream lines(text.str());
  std::string line;
  std::getline(lines, line);
  CHECK(line == "# calligraphy capture 1");
  std::vector<std::string> bytes;
  double last = 0.0;
  while (std::getline(lines, line)) {
    if (line.front() == '#') continue;
    std::size_t end = 0;
    const double time = std::stod(line, &end);
    CHECK(time >= last);
    last = time;
    bytes.push_back(line.substr(end));
  }
  CHECK(bytes == std::vector<std::string>{" 00 5a", " 01 5a", " 02 5a", " -"});
}
