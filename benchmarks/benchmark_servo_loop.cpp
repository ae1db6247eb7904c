// Timing of the servo thread on this machine: percentiles of period and work time.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/pointer_device.hpp>
#include <calligraphy/devices/servo_loop.hpp>

namespace {

/// A wall at the paper: a minimal force law.
Eigen::Vector3d wall(const calligraphy::DeviceState& state) {
  const double penetration = -state.position.z();
  return {0.0, 0.0, penetration > 0.0 ? 400.0 * penetration : 0.0};
}

void print(const char* name, const calligraphy::DurationSummary& summary) {
  std::printf("%-8s %9.1f %9.1f %9.1f %9.1f\n", name, 1e6 * summary.p50, 1e6 * summary.p99, 1e6 * summary.p99_9,
              1e6 * summary.worst);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace calligraphy;
  double seconds = 10.0;
  ServoLoopOptions options;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    const bool has_value = i + 1 < argc;
    if (name == "--seconds" && has_value) {
      seconds = std::atof(argv[i + 1]);
    } else if (name == "--rate" && has_value) {
      options.servo.rate = std::atof(argv[i + 1]);
    } else if (name == "--priority" && has_value) {
      options.thread.priority = std::atoi(argv[i + 1]);
    } else if (name == "--core" && has_value) {
      options.thread.core = std::atoi(argv[i + 1]);
    } else {
      std::printf("usage: benchmark_servo_loop [--seconds N] [--rate HZ] [--priority 0..99] [--core N]\n");
      return 2;
    }
  }
  PointerOptions pointer;
  if (options.servo.rate > 0.0) pointer.rate = options.servo.rate;
  PointerDevice device(device_profile("omni"), {}, pointer);
  device.move(0.0, 0.0, 0.5);
  ServoLoop loop(device, wall, options);
  for (const std::string& warning : loop.start()) std::printf("%s\n", warning.c_str());
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  loop.stop();

  const ServoStatistics done = loop.statistics();
  std::printf("%-8s %9s %9s %9s %9s  [us]\n", "", "p50", "p99", "p99.9", "worst");
  print("period", done.period);
  print("work", done.work);
  std::printf("%llu ticks, %llu missed deadlines, %llu watchdog interventions\n",
              static_cast<unsigned long long>(done.ticks), static_cast<unsigned long long>(done.missed_deadlines),
              static_cast<unsigned long long>(done.watchdog_takeovers));
  return 0;
}
