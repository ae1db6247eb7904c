#include <atomic>
#include <cstdint>
#include <thread>

#include <calligraphy/devices/device_profiles.hpp>

#include "../../catch.hpp"
#include "held_phantom.hpp"

using namespace calligraphy_test;

TEST_CASE("reports, faults, reads, writes and statistics may come from different threads concurrently",
          "[phantom][threads]") {
  const WireProfile& profile = wire_profile("simulated");
  const PhantomOptions options = simulated_options();
  std::atomic<double> now = 0.0;
  EmulatedArm arm(profile, options.model, device_profile(options.model), {0.1, 3.0, 300.0});
  PhantomDevice device(std::make_unique<MemoryLink>(arm.wire), options, [&] { return now.load(); });
  LinkListener& listener = *arm.wire->listener;
  constexpr std::uint32_t reports = 20'000;
  std::atomic<bool> done = false;
  arm.tip.set_intention({arm.tip.true_position(), {0.0, 0.003, 0.002}});
  std::jthread link([&] {
    for (std::uint32_t i = 0; i < reports; ++i) {
      now = now + 1e-3;
      arm.docked = i < 50;
      arm.tip.advance(1e-3);
      ++arm.sequence;
      listener.received(arm.report());
      if (i % 1000 == 999) {
        listener.changed(DeviceFault::timed_out);
        listener.changed(DeviceFault::none);
      }
      if (i % 16 == 0) std::this_thread::yield();
    }
    done = true;
  });
  std::jthread display([&] {
    while (!done) {
      if (device.statistics().reports > reports) return;
      std::this_thread::yield();
    }
  });
  bool finite = true;
  while (!done) {
    const DeviceState state = device.read();
    finite = finite && state.position.allFinite() && state.velocity.allFinite();
    device.write({0.3, 0.0, 0.0});
  }
  link.join();
  display.join();
  CHECK(finite);
  CHECK(device.statistics().reports == reports);
  CHECK(device.statistics().used_reports == reports);
  CHECK(device.statistics().faults[static_cast<std::size_t>(DeviceFault::timed_out)] == reports / 1000);
  device.read();
  CHECK((device.read().position - arm.tip.true_position()).norm() < 2e-4);
}
