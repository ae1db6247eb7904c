// Replaces two functions of the C library in this program by their system calls, but for the time suspended.
#include "suspended_machine.hpp"

#if defined(__linux__)

#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>

namespace {

std::atomic<long> suspended = 0;  // [s]

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long result = syscall(SYS_clock_gettime, clock, time);
  if (result == 0 && clock == CLOCK_BOOTTIME) time->tv_sec += suspended;
  return static_cast<int>(result);
}

extern "C" int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  timespec until = *time;
  if (clock == CLOCK_BOOTTIME && (flags & TIMER_ABSTIME) != 0) until.tv_sec -= suspended;
  return syscall(SYS_clock_nanosleep, clock, flags, &until, left) == 0 ? 0 : errno;
}

namespace calligraphy_test {

SuspendedMachine::SuspendedMachine(long seconds) { suspended += seconds; }
SuspendedMachine::~SuspendedMachine() { suspended = 0; }

}  // namespace calligraphy_test

#endif
