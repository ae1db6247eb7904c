#include <calligraphy/devices/servo_thread.hpp>

#include <algorithm>
#include <cmath>
#include <future>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>

#include "base/monotonic_clock.hpp"
#include "base/require.hpp"
#include "ending_signals.hpp"
#include "real_time_thread.hpp"

namespace calligraphy {
namespace {

ServoThreadOptions checked(const ServoThreadOptions& options) {
  require(options.priority >= 0 && options.priority <= 99, "servo thread: priority", options.priority, "",
          "from 1 to 99, or 0 for a normal thread");
  require(options.core >= -1 && options.core <= 1023, "servo thread: core", options.core, "",
          "from 0 to 1023, or -1 for any");
  return options;
}

}  // namespace

NextDeadline next_deadline(double deadline, double period, double now) noexcept {
  const double next = deadline + period;
  if (now < next) return {next, 0};
  const double skipped = std::floor((now - next) / period) + 1.0;
  return {next + skipped * period, static_cast<std::uint64_t>(skipped)};
}

std::vector<std::string> set_real_time_priority(int priority) {
  ServoThreadOptions options;
  options.priority = priority;
  options.lock_memory = false;
  return real_time::make_real_time(checked(options));
}

ServoThread::ServoThread(double rate, const ServoThreadOptions& options) : rate_(rate), options_(checked(options)) {
  require_within("servo thread: rate", rate, "Hz", 1.0, 1e5);
}

ServoThread::~ServoThread() { stop(); }

void ServoThread::start(std::function<void(double now)> tick) {
  if (running()) throw ValueError("the servo thread is already running: stop it before starting it again");
  if (!tick) throw ValueError("servo thread: the tick is empty");
  stopping_.store(false, std::memory_order_relaxed);
  std::promise<std::vector<std::string>> ready;
  std::future<std::vector<std::string>> warnings = ready.get_future();
  try {
    thread_ = std::thread([this, tick = std::move(tick), ready = std::move(ready)]() mutable {
      try {
        ready.set_value(real_time::make_real_time(options_));
      } catch (...) {
        ready.set_exception(std::current_exception());
        return;
      }
      run(tick);
    });
  } catch (const std::system_error& error) {
    throw DeviceError(std::string("the servo thread cannot be started: ") + error.what());
  }
  try {
    warnings_ = warnings.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

void ServoThread::stop() noexcept {
  if (!running()) return;
  stopping_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void ServoThread::run(const std::function<void(double now)>& tick) noexcept {
  const SignalStack stack;  // endless recursion in a force law must not leave the force on
  const double period = 1.0 / rate_;
  double deadline = monotonic_seconds();
  while (!stopping_.load(std::memory_order_relaxed)) {
    tick(monotonic_seconds());
    deadline = next_deadline(deadline, period, monotonic_seconds()).time;
    real_time::sleep_until(deadline);
  }
}

}  // namespace calligraphy
