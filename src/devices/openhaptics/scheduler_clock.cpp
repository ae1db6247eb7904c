#include "scheduler_clock.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include <calligraphy/base/error.hpp>

namespace calligraphy::hdapi {
namespace {

constexpr unsigned short priority = 0x7FFF;  // mid-range, relative to a program's other callbacks

/// The clock whose tick this thread is executing.
thread_local const SchedulerClock* current_tick = nullptr;

void wait_a_little() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

}  // namespace

SchedulerClock::SchedulerClock(std::shared_ptr<Runtime> runtime, Handle device, double (*time)() noexcept)
    : runtime_(std::move(runtime)), device_(device), time_(time) {}

SchedulerClock::~SchedulerClock() { stop(); }

void SchedulerClock::start(std::function<void(double now)> tick) {
  if (running_) throw ValueError("the device's clock is already running: stop it before starting it again");
  if (!tick) throw ValueError("the tick of the device's clock is empty");
  tick_ = std::move(tick);
  stopping_ = finished_ = output_on_ = false;
  if (!runtime_->scheduler_runs()) runtime_->take_errors();  // discards errors from before
  callback_ = runtime_->functions().hdScheduleAsynchronous(&SchedulerClock::call, this, priority);
  try {
    runtime_->use_scheduler();
  } catch (...) {
    runtime_->functions().hdUnschedule(callback_);
    throw;
  }
  running_ = true;
}

void SchedulerClock::stop() noexcept {
  if (!running_) return;
  stopping_ = true;
  // The callback finishes with a zero-force frame. If the scheduler no longer calls it, the wait is short.
  constexpr int max_wait = 100;  // [ms]
  for (int i = 0; i < max_wait && !finished_; ++i) wait_a_little();
  while (inside_) wait_a_little();
  if (!finished_) {
    cut_force();
    runtime_->functions().hdUnschedule(callback_);
  }
  runtime_->leave_scheduler();
  running_ = false;
}

bool SchedulerClock::within_tick() const noexcept { return current_tick == this; }

void SchedulerClock::cut_force() noexcept {
  if (!output_on_.exchange(false)) return;
  // It is not documented whether the current device is per thread, so it is set before each use.
  runtime_->functions().hdMakeCurrentDevice(device_);
  runtime_->functions().hdDisable(force_output);
}

void SchedulerClock::set_force(const double (&force)[3]) noexcept {
  const Functions& hd = runtime_->functions();
  hd.hdMakeCurrentDevice(device_);
  hd.hdSetDoublev(current_force, force);
  if (!output_on_.exchange(true)) hd.hdEnable(force_output);
}

CallbackCode SchedulerClock::call(void* clock) noexcept { return static_cast<SchedulerClock*>(clock)->frame(); }

CallbackCode SchedulerClock::frame() noexcept {
  // stop() accesses these two in the opposite order: either it sees the frame, or the frame sees the stop.
  inside_ = true;
  const bool last = stopping_;
  const Functions& hd = runtime_->functions();
  hd.hdMakeCurrentDevice(device_);
  hd.hdBeginFrame(device_);
  if (last) {
    constexpr double none[3] = {0.0, 0.0, 0.0};
    hd.hdSetDoublev(current_force, none);
  } else {
    current_tick = this;
    tick_(time_());
    current_tick = nullptr;
  }
  hd.hdMakeCurrentDevice(device_);
  hd.hdEndFrame(device_);
  if (last) {
    cut_force();
    finished_ = true;
  }
  inside_ = false;
  return last ? callback_done : callback_continue;
}

}  // namespace calligraphy::hdapi
