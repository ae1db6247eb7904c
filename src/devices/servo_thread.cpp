#include <calligraphy/devices/servo_thread.hpp>

#include <algorithm>
#include <cmath>
#include <future>
#include <sstream>
#include <system_error>
#include <utility>

#include <calligraphy/base/error.hpp>

#include "real_time_thread.hpp"

namespace calligraphy {
namespace {

ServoThreadOptions checked(const ServoThreadOptions& options) {
  std::ostringstream message;
  message << "servo thread: ";
  if (!(options.rate >= 1.0 && options.rate <= 1e5)) {
    message << "rate is " << options.rate << ", must be from 1 to 100000 Hz";
  } else if (options.priority < 0 || options.priority > 99) {
    message << "priority is " << options.priority << ", must be from 1 to 99, or 0 for an ordinary thread";
  } else if (options.core < -1 || options.core > 1023) {
    message << "core is " << options.core << ", must be from 0 to 1023, or -1 for any";
  } else {
    return options;
  }
  throw ValueError(message.str());
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

ServoThread::ServoThread(const ServoThreadOptions& options) : options_(checked(options)) {}

ServoThread::~ServoThread() { stop(); }

void ServoThread::start(std::function<void(double now)> tick) {
  if (running()) throw ValueError("the servo thread runs already: stop it before it is started again");
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
  const double period = 1.0 / options_.rate;
  double deadline = real_time::now();
  while (!stopping_.load(std::memory_order_relaxed)) {
    tick(real_time::now());
    deadline = next_deadline(deadline, period, real_time::now()).time;
    real_time::sleep_until(deadline);
  }
}

}  // namespace calligraphy
