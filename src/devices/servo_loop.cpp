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
  options.lock_memory = false;  // the watchdog does it for the whole process, whatever the servo's clock is
  return options;
}

/// Above the servo, so that a force law which never returns cannot keep it from running.
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
  if (running_) throw ValueError("the servo loop runs already: stop it before it is started again");
  servo_.reset();
  watchdog_.start([this](double now) { servo_.supervise(now); });
  clock_ = device_.clock();
  const bool own = clock_ == nullptr;
  if (own) clock_ = &thread_;
  running_ = true;  // before the first tick, whose law may ask
  try {
    clock_->start([this](double now) { servo_.step(now); });
  } catch (...) {
    running_ = false;
    watchdog_.stop();
    throw;
  }
  std::vector<std::string> warnings = watchdog_.warnings();
  const auto add = [&warnings](const std::vector<std::string>& more) {  // each but once, whoever says it
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
    // This thread cannot wait for itself. Whether start() has returned does not matter: the release is kept.
    servo_.release();
    return;
  }
  if (!running_) return;
  servo_.release();
  // A clock that stands still would never let the force fall: the watchdog does, and the wait is bounded.
  constexpr int longest_wait = 500;  // [ms]
  for (int i = 0; i < longest_wait && servo_.status().phase != ServoPhase::zero; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  clock_->stop();
  watchdog_.stop();
  servo_.reset();
  running_ = false;
}

}  // namespace calligraphy
