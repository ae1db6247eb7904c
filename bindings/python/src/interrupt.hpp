// Ctrl-C while C++ works without the GIL.
#pragma once

#include <chrono>
#include <functional>

namespace calligraphy::python {

/// Lets Python see its signals now and then: Ctrl-C then raises KeyboardInterrupt from within the call. Python handles
/// signals in its main thread alone; in any other one nothing happens.
class Interrupt {
 public:
  /// Costs a look at the clock; the GIL, which is not held, every 50 ms. @throws error_already_set of the handler
  void check();

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval;
  static constexpr std::chrono::milliseconds interval{50};
};

/// A progress function that also looks for Ctrl-C; `progress` may be empty.
std::function<void(double)> interruptible(std::function<void(double)> progress);

}  // namespace calligraphy::python
