// The emergency stop over the bus: the device's last packet is the stop packet, whichever thread is the one that
// crashed.
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

#include <calligraphy/devices/emergency_stop.hpp>

#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

UsbIdentity touch_to_stop() { return CALLIGRAPHY_TEST_HIDRAW && GENERATE(true, false) ? serial_touch() : hid_touch(); }

/// A link in use, its stop packet full of zeros.
struct StoppedTouch {
  explicit StoppedTouch(const UsbIdentity& identity)
      : touch(identity),
        entry(touch.link.get(), [](void* link) noexcept { static_cast<phantom::Link*>(link)->cut_force(); }) {
    touch.device.on_packet([this](std::span<const std::byte> packet) {
      const std::lock_guard<std::mutex> alone(mutex);
      taken.emplace_back();
      for (const std::byte byte : packet) taken.back().push_back(std::to_integer<std::uint8_t>(byte));
    });
    touch.listener.to_stop = stop;
  }
  ~StoppedTouch() {
    clear_emergency_stop();
    entry.remove();
  }

  void open() {
    touch.open();
    touch.link->send(as_packet(force));
    REQUIRE(touch.device.wait_for_packets(1));
    REQUIRE(last_taken() == force);
  }
  Octets last_taken() {
    const std::lock_guard<std::mutex> alone(mutex);
    return taken.empty() ? Octets() : taken.back();
  }

  const Octets force = numbered(7, 16), stop = Octets(16, 0);
  std::mutex mutex;
  std::vector<Octets> taken;
  PluggedTouch touch;
  EmergencyStopEntry entry;
};

}  // namespace

TEST_CASE(
    "when an emergency stop returns, the device has taken the stop packet, and takes no force until it is cleared",
    "[emergency]") {
  StoppedTouch stopped(touch_to_stop());
  stopped.open();
  emergency_stop();
  CHECK(stopped.last_taken() == stopped.stop);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const std::uint64_t before = stopped.touch.device.packets_taken();
    stopped.touch.link->send(as_packet(stopped.force));
    REQUIRE(stopped.touch.device.wait_for_packets(before + 1));
    REQUIRE(stopped.last_taken() == stopped.stop);
  }
  clear_emergency_stop();
  const std::uint64_t before = stopped.touch.device.packets_taken();
  stopped.touch.link->send(as_packet(stopped.force));
  REQUIRE(stopped.touch.device.wait_for_packets(before + 1));
  CHECK(stopped.last_taken() == stopped.force);
}

TEST_CASE("a force that waits to be sent is replaced by the stop packet", "[emergency]") {
  StoppedTouch stopped(touch_to_stop());
  stopped.open();
  for (int i = 0; i < 50; ++i) {
    stopped.touch.link->send(as_packet(stopped.force));
    emergency_stop();
    REQUIRE(stopped.last_taken() == stopped.stop);
    clear_emergency_stop();
  }
}

TEST_CASE("an unplugged device does not hold up an emergency stop", "[emergency]") {
  StoppedTouch stopped(touch_to_stop());
  stopped.open();
  stopped.touch.device.unplug(UnplugOrder::gone_first);
  REQUIRE(stopped.touch.listener.wait_for(DeviceFault::unplugged));
  emergency_stop();  // returns
  SUCCEED();
}

#if CALLIGRAPHY_TEST_HIDRAW

namespace {

std::set<pid_t> threads() {
  std::set<pid_t> all;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    all.insert(std::stoi(task.path().filename().string()));
  }
  return all;
}

}  // namespace

TEST_CASE("a link whose own thread crashes is stopped by that thread, directly through the device's node: serial",
          "[emergency]") {
  StoppedTouch stopped(serial_touch());
  stopped.touch.listener.on_packet = [] { emergency_stop(); };  // as a handler of SIGSEGV would
  stopped.open();
  stopped.touch.exchange(numbered(1));
  CHECK(stopped.last_taken() == stopped.stop);
}

TEST_CASE("a link whose own thread crashes is stopped by that thread, directly through the device's node: HID",
          "[emergency]") {
  StoppedTouch stopped(hid_touch());
  const std::set<pid_t> before = threads();
  stopped.open();
  static std::atomic<bool> handled = false, taken = false;
  static StoppedTouch* touch = nullptr;
  touch = &stopped;
  struct sigaction handler = {}, earlier = {};
  handler.sa_handler = [](int) {
    emergency_stop();
    taken = touch->last_taken() == touch->stop;  // of this thread's waiting, which a handler may do here
    handled = true;
  };
  sigaction(SIGUSR1, &handler, &earlier);
  // The thread that writes was started last.
  pid_t writer = 0;
  for (const pid_t thread : threads()) {
    if (before.count(thread) == 0) writer = std::max(writer, thread);
  }
  REQUIRE(writer != 0);
  REQUIRE(syscall(SYS_tgkill, getpid(), writer, SIGUSR1) == 0);
  for (int i = 0; i < 10'000 && !handled; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(handled);
  CHECK(taken);
  sigaction(SIGUSR1, &earlier, nullptr);
}

#endif
