// Your own backend: a complete device class. This one drives a toy, a knob on a spring.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/devices/servo_loop.hpp>

namespace {

/// Stands in for a vendor's library: a knob of 50 g on a spring of 100 N/m, in real time. Replace it with your own
/// calls.
struct Knob {
  bool plugged_in() const { return true; }
  double position() {  // [mm], as many libraries have it
    for (int i = 0; i < 10; ++i) {
      speed_ += 1e-4 * (force_ - 100.0 * place_ - 2.0 * speed_) / 0.05;
      place_ += 1e-4 * speed_;
    }
    return 1e3 * place_;
  }
  void push(double newtons) { force_ = newtons; }

  double place_ = 0.0, speed_ = 0.0;
  std::atomic<double> force_ = 0.0;
};

class KnobDevice final : public calligraphy::HapticDevice {
 public:
  KnobDevice() {
    if (!knob_.plugged_in()) throw calligraphy::DeviceError("no knob found: plug it in and start again");
    capabilities_.model = "Knob";
    capabilities_.sensed = capabilities_.driven = {.x = true, .y = false, .z = false};
    capabilities_.workspace = {0.1, 0.0, 0.0};  // [m]
    capabilities_.peak_force = 2.0;             // [N]
    capabilities_.usable_stiffness = 300.0;     // [N/m]
  }
  ~KnobDevice() override { close(); }
  const calligraphy::Capabilities& capabilities() const noexcept override { return capabilities_; }
  // Called once a millisecond. Must not allocate, lock, throw or log: errors are reported as a status.
  calligraphy::DeviceState read() noexcept override {
    state_.time += 1e-3;
    state_.position.x() = 1e-3 * knob_.position();
    state_.status = open_ ? calligraphy::DeviceStatus::ok : calligraphy::DeviceStatus::disconnected;
    return state_;
  }
  void write(const Eigen::Vector3d& force) noexcept override {
    if (open_) knob_.push(force.allFinite() ? force.x() : 0.0);
  }
  void close() noexcept override {
    knob_.push(0.0);
    open_ = false;
  }
  // Called in a signal handler: nothing but an atomic variable or a write() of prepared bytes.
  void cut_force() noexcept override { knob_.push(0.0); }

 private:
  Knob knob_;
  calligraphy::Capabilities capabilities_;
  calligraphy::DeviceState state_;
  bool open_ = true;
  calligraphy::EmergencyStopEntry entry_{*this};  // last, so that it is removed first
};

}  // namespace

int main() {
  using namespace calligraphy;
  install_emergency_stop();  // no force is left behind when this program ends, however it ends
  KnobDevice device;
  std::atomic<double> place = 0.0;
  // This spring pulls the knob to 20 mm, the knob's own spring pulls it to zero.
  ServoLoop loop(device, [&](const DeviceState& state) -> Eigen::Vector3d {
    place = state.position.x();
    return {100.0 * (0.02 - state.position.x()), 0.0, 0.0};
  });
  loop.start([](const std::vector<std::string>& warnings) {  // before the force
    for (const std::string& warning : warnings) std::printf("%s\n", warning.c_str());
  });
  while (loop.statistics().ticks < 1500) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  loop.stop();  // ramps the force down to zero
  const ServoStatistics done = loop.statistics();
  std::printf("%.1f mm at the end, p99 of the work %.1f us\n", 1e3 * place, 1e6 * done.work.p99);
  return 0;
}
