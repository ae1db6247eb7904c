// The threads between a device and the servo loop run at the requested priority, as far as the system permits.
#include <pthread.h>
#include <sched.h>

#include <sys/stat.h>

#include <filesystem>
#include <thread>

#include "as_nobody.hpp"
#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

constexpr int priority = 37;  // used by no other thread

phantom::LinkOptions urgent(int asked) {
  phantom::LinkOptions options = patient;
  options.priority = asked;
  return options;
}

/// Real-time threads of this program with that priority.
int threads_at(int wanted) {
  int count = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const pid_t thread = std::stoi(task.path().filename().string());
    sched_param parameters = {};
    const bool there = sched_getparam(thread, &parameters) == 0;
    if (there && sched_getscheduler(thread) == SCHED_FIFO && parameters.sched_priority == wanted) ++count;
  }
  return count;
}

/// Whether this process may have real-time threads at all.
bool permitted() {
  bool may = false;
  std::thread([&may] {
    sched_param parameters = {};
    parameters.sched_priority = priority;
    may = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
  }).join();
  return may;
}

UsbIdentity touch_of_this_program() {
  return CALLIGRAPHY_TEST_HIDRAW && GENERATE(true, false) ? serial_touch() : hid_touch();
}

/// One report each way, so that every thread of the link has run.
void exchange_both_ways(PluggedTouch& touch) {
  touch.exchange(numbered(1, report_size));
  touch.link->send(as_packet(numbered(2, 16)));
  REQUIRE(touch.device.wait_for_packets(1));
}

}  // namespace

TEST_CASE("every thread of a link has the requested priority where permitted", "[threads]") {
  if (!permitted()) return;  // covered by the next test
  const UsbIdentity identity = touch_of_this_program();
  PluggedTouch touch(identity, urgent(priority));
  touch.open();
  exchange_both_ways(touch);
  CHECK(touch.link->warnings().empty());
  // One thread serves a serial device; one reads and one writes a HID, and hidapi-libusb adds its own.
  CHECK(threads_at(priority) == (identity.link == LinkKind::usb ? 1 : CALLIGRAPHY_TEST_HIDRAW ? 2 : 3));
}

TEST_CASE("a link whose priority is refused reports it once and works", "[threads]") {
  PluggedTouch touch(touch_of_this_program(), urgent(priority));
  for (const std::string& file : touch.device.node_files()) REQUIRE(chmod(file.c_str(), 0666) == 0);
  const AsNobody nobody;
  if (permitted()) return;  // permitted here
  touch.open();
  exchange_both_ways(touch);
  REQUIRE(touch.link->warnings().size() == 1);
  CHECK_THAT(touch.link->warnings().front(),
             Catch::Contains("real-time priority is not permitted") && Catch::Contains("limits.d"));
  CHECK(threads_at(priority) == 0);
}

TEST_CASE("a link without a priority has normal threads and no warnings", "[threads]") {
  PluggedTouch touch(touch_of_this_program(), urgent(0));
  touch.open();
  exchange_both_ways(touch);
  CHECK(touch.link->warnings().empty());
  for (int each = 1; each < 100; ++each) CHECK(threads_at(each) == 0);
}
