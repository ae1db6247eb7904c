// A clock with its own thread and absolute deadlines, real-time where the system permits it.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/devices/servo_clock.hpp>

namespace calligraphy {

/// Rate and privileges of the thread of a servo loop.
struct ServoThreadOptions {
  int priority = 80;        ///< real-time priority (SCHED_FIFO), 1 to 99; 0: a normal thread
  bool lock_memory = true;  ///< lock the memory of the whole process into RAM from the start
  int core = -1;            ///< processor core that the thread is bound to; -1: any
};

/// A deadline of a servo thread.
struct NextDeadline {
  double time = 0.0;          ///< when the next tick is due [s]
  std::uint64_t skipped = 0;  ///< earlier deadlines that passed without a tick
};

/// The next deadline after `now` on the grid defined by `deadline`, that of the last tick, and `period` [s].
NextDeadline next_deadline(double deadline, double period, double now) noexcept;

/// Calls the tick at deadlines that do not drift. There is no catching up after a late tick: the next one runs at the
/// next deadline of the grid. If the system refuses real-time priority, locked memory or the core, the thread runs
/// without it and warnings() reports it.
class ServoThread final : public ServoClock {
 public:
  /// A clock that does not run yet. @throws ValueError naming the value when an option is out of range
  explicit ServoThread(double rate, const ServoThreadOptions& options = {});
  /// Calls stop().
  ~ServoThread() override;

  /// `now` is the time of the system's monotonic clock when the tick is called; the clock keeps running while the
  /// machine is suspended. An exception from the tick terminates the program.
  void start(std::function<void(double now)> tick) override;
  void stop() noexcept override;
  bool running() const noexcept override { return thread_.joinable(); }

  /// What the system refused at the last start, with the reason and a remedy.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  void run(const std::function<void(double now)>& tick) noexcept;

  double rate_;  ///< [Hz]
  ServoThreadOptions options_;
  std::vector<std::string> warnings_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

/// Gives the calling thread a real-time priority from 1 to 99; 0 changes nothing. For a backend's own threads that
/// carry samples or forces; choose a priority below the servo loop's. Returns what the system refused, with a remedy,
/// for HapticDevice::warnings(). @throws ValueError naming the priority when it is out of range
std::vector<std::string> set_real_time_priority(int priority);

}  // namespace calligraphy
