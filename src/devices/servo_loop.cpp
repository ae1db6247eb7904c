#include <calligraphy/devices/servo_loop.hpp>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <calligraphy/base/error.hpp>

#include "base/require.hpp"
#include "ending_signals.hpp"

namespace calligraphy {
namespace {

ServoThreadOptions for_servo(ServoThreadOptions options) {
  options.lock_memory = false;  // the watchdog locks it for the whole process, whichever clock the servo has
  return options;
}

/// One priority above the servo, so that a force law that never returns cannot block it.
ServoThreadOptions for_watchdog(ServoThreadOptions options) {
  if (options.priority > 0 && options.priority < 99) ++options.priority;
  options.core = -1;
  return options;
}

/// Waits until the next tick, or the watchdog if that tick does not come, has written zero. Any force that the loop was
/// about to write has been written by then. Async-signal-safe.
void wait_for_zero(void* servo) noexcept {
  constexpr int max_wait = 100;  // [ms]
  for (int i = 0; i < max_wait && !static_cast<const Servo*>(servo)->halted(); ++i) pause_in_signal_handler();
  pause_in_signal_handler();  // a vendor's frame passes the force on after the tick has returned
}

}  // namespace

ServoLoop::ServoLoop(HapticDevice& device, ForceLaw law, const ServoLoopOptions& options)
    : device_(device),
      servo_(device, std::move(law), options.servo),
      thread_(servo_.rate(), for_servo(options.thread)),
      watchdog_(servo_.rate(), for_watchdog(options.thread)) {
  const double own = device.capabilities().update_rate;
  if (device.clock() == nullptr || servo_.rate() == own) return;
  throw ValueError("servo loop: rate = " + number_text(servo_.rate()) +
                   " Hz, but the device has a clock of its own, at " + number_text(own) + " Hz");
}

ServoLoop::~ServoLoop() { stop(); }

std::vector<std::string> ServoLoop::start(
    const std::function<void(const std::vector<std::string>& warnings)>& tell) {
  if (running_) throw ValueError("the servo loop is already running: stop it before starting it again");
  if (emergency_stopped()) {
    throw DeviceError("the servo loop cannot be started after an emergency stop: call clear_emergency_stop() first");
  }
  servo_.reset();
  watchdog_.start([this](double now) { servo_.supervise(now); });
  clock_ = device_.clock();
  const bool own = clock_ == nullptr;
  if (own) clock_ = &thread_;
  running_ = true;  // before the first tick, whose force law may query it
  warned_ = tell == nullptr;
  std::vector<std::string> warnings;
  const auto add = [&warnings](const std::vector<std::string>& more) {  // without duplicates
    for (const std::string& warning : more) {
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
    }
  };
  try {
    entry_.emplace(&servo_, wait_for_zero);
    add(watchdog_.warnings());
    if (own) {
      thread_.start([this](double now) {
        if (warned_) servo_.step(now);
      });
      add(thread_.warnings());
    }
    add(device_.warnings());
    if (tell) tell(warnings);
    if (!own) clock_->start([this](double now) { servo_.step(now); });
  } catch (...) {
    running_ = false;
    clock_->stop();
    watchdog_.stop();
    entry_.reset();
    throw;
  }
  warned_ = true;
  return warnings;
}

void ServoLoop::stop() noexcept {
  if (servo_.in_law()) {
    // This thread cannot wait for itself. The release also takes effect if start() has not returned yet.
    servo_.release();
    return;
  }
  if (!running_) return;
  servo_.release();
  // With a stalled clock no tick would ramp the force down: the watchdog does, and the wait is bounded.
  constexpr int max_wait = 500;  // [ms]
  for (int i = 0; i < max_wait && servo_.status().phase != ServoPhase::zero; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  clock_->stop();
  watchdog_.stop();
  entry_.reset();
  servo_.reset();
  running_ = false;
}

}  // namespace calligraphy
