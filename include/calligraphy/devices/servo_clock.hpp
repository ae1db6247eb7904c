// Interface of the clock that calls the servo loop once per tick.
#pragma once

#include <functional>

namespace calligraphy {

/// Calls a function once per tick until it is stopped: ServoThread, or a vendor's scheduler.
class ServoClock {
 public:
  virtual ~ServoClock() = default;

  /// Starts calling `tick` with the time [s] of a clock that never runs backwards, one call at a time, from one thread.
  /// @throws DeviceError when the clock cannot be started, ValueError when it is already running
  virtual void start(std::function<void(double now)> tick) = 0;

  /// After it returns, no tick is running or will run. Do not call it from within a tick.
  virtual void stop() noexcept = 0;

  /// Whether it has been started and not stopped since.
  virtual bool running() const noexcept = 0;
};

}  // namespace calligraphy
