// What a servo thread needs of the operating system: a sleep to a deadline, and the rights of real time.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/devices/servo_thread.hpp>

namespace calligraphy::real_time {

/// Returns at once when the deadline has passed, by monotonic_seconds() [s].
void sleep_until(double deadline) noexcept;

/// Gives the calling thread, as far as the system permits, what the options ask for. Returns what it does not permit,
/// with what to do.
std::vector<std::string> make_real_time(const ServoThreadOptions& options);

}  // namespace calligraphy::real_time
