// Operating-system services for a servo thread: clock, sleep until a deadline, real-time scheduling.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/devices/servo_thread.hpp>

namespace calligraphy::real_time {

/// Sleeps until `deadline` of monotonic_seconds() [s]; returns immediately if it has passed.
void sleep_until(double deadline) noexcept;

/// Applies the options to the calling thread as far as the system permits. Returns what it refused, with a remedy.
std::vector<std::string> make_real_time(const ServoThreadOptions& options);

}  // namespace calligraphy::real_time
