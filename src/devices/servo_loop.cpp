#include <calligraphy/devices/servo_loop.hpp>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

ServoThreadOptions for_servo(ServoThreadOptions options, double rate) {
  options.rate = rate;
  options.lock_memory = false;  // the watchdog locks it for the whole process, whichever clock the servo has
  return options;
}

/// One priority above the servo, so that a force law that never returns cannot block it.
ServoThreadOptions for_watchdog(ServoThreadOptions options, double rate) {
  options.rate = rate;
  if (options.priority > 0 && options.priority < 99) ++options.priority;
  options.core = -1;
  return options;
}

}  // namespace

ServoLoop::ServoLoop(HapticDevice& device, ForceLaw law, const ServoLoopOptions& options)
    : device_(device),
      servo_(device, std::move(law), options.servo),
      thread_(for_servo(options.thread, options.servo.rate)),
      watchdog_(for_watchdog(options.thread, options.servo.rate)) {}

ServoLoop::~ServoLoop() { stop(); }

std::vector<std::string> ServoLoop::start() {
  if (running_) throw ValueError("the servo loop is already running: stop it before starting it again");
  servo_.reset();
  watchdog_.start([this](double now) { servo_.supervise(now); });
  clock_ = device_.clock();
  const bool own = clock_ == nullptr;
  if (own) clock_ = &thread_;
  running_ = true;  // before the first tick, whose force law may query it
  try {
    clock_->start([this](double now) { servo_.step(now); });
  } catch (...) {
    running_ = false;
    watchdog_.stop();
    throw;
  }
  std::vector<std::string> warnings = watchdog_.warnings();
  const auto add = [&warnings](const std::vector<std::string>& more) {  // without duplicates
    for (const std::string& warning : more) {
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
    }
  };
  if (own) add(thread_.warnings());
  add(device_.warnings());
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
  servo_.reset();
  running_ = false;
}

}  // namespace calligraphy
