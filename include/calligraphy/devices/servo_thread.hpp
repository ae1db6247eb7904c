// A clock of this library: a thread of its own with absolute deadlines, in real time where that is permitted.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/devices/servo_clock.hpp>

namespace calligraphy {

struct ServoThreadOptions {
  double rate = 1000.0;     ///< [Hz]
  int priority = 80;        ///< real-time priority, 1 to 99; 0: an ordinary thread
  bool lock_memory = true;  ///< keep the memory of the whole process from being swapped out, from then on
  int core = -1;            ///< the only processor core that the thread runs on; -1: any
};

/// The next deadline after `now` on the grid of `deadline` and `period`, and how many were skipped to get there.
struct NextDeadline {
  double time = 0.0;  ///< [s]
  std::uint64_t skipped = 0;
};
NextDeadline next_deadline(double deadline, double period, double now) noexcept;

/// Calls the tick at deadlines that do not drift. A late tick is not made up for: the next one comes at the next
/// deadline of the grid. What the system does not permit (real-time priority, locked memory, the core) is left out and
/// told by warnings().
class ServoThread final : public ServoClock {
 public:
  /// @throws ValueError naming the value when an option is out of its domain
  explicit ServoThread(const ServoThreadOptions& options = {});
  ~ServoThread() override;

  /// `now` is the system's monotonic clock when the tick is called. A tick that throws ends the program.
  void start(std::function<void(double now)> tick) override;
  void stop() noexcept override;
  bool running() const noexcept override { return thread_.joinable(); }

  /// What was not permitted, why, and how to permit it: of the last start.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  void run(const std::function<void(double now)>& tick) noexcept;

  ServoThreadOptions options_;
  std::vector<std::string> warnings_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

/// Gives the calling thread, one of a backend's own that carries samples or forces, a real-time priority of 1 to 99,
/// below the servo loop's; 0 changes nothing. Returns what the system does not permit, with what to do:
/// HapticDevice::warnings(). @throws ValueError naming the priority when it is another number
std::vector<std::string> set_real_time_priority(int priority);

}  // namespace calligraphy
