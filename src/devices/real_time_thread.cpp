#include "real_time_thread.hpp"

#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <cerrno>
#include <ctime>
#endif

namespace calligraphy::real_time {

#if defined(__linux__)

namespace {

constexpr double nanosecond = 1e-9;  // [s]

std::string reason(int error) { return std::strerror(error); }

void raise_priority(int priority, std::vector<std::string>& warnings) {
  sched_param parameters = {};
  parameters.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (error == 0) return;
  warnings.push_back("real-time priority is not permitted (" + reason(error) +
                     "): other programs may delay the servo loop. Add the line \"@realtime - rtprio 99\" to a file in "
                     "/etc/security/limits.d, join the group realtime and log in again");
}

void lock_memory(std::vector<std::string>& warnings) {
  const std::string remedy =
      ": memory that is swapped out may delay the servo loop. Add the line \"@realtime - memlock unlimited\" to a file "
      "in /etc/security/limits.d, join the group realtime and log in again";
  // With a finite limit, locking future pages would make later allocations of the program fail.
  rlimit limit = {};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) {
    warnings.push_back("memory is not locked (the limit is " + std::to_string(limit.rlim_cur / 1024) + " kB)" + remedy);
  } else if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    warnings.push_back("memory is not locked (" + reason(errno) + ")" + remedy);
  }
}

void pin(int core, std::vector<std::string>& warnings) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<unsigned>(core), &cores);
  const int error = pthread_setaffinity_np(pthread_self(), sizeof cores, &cores);
  if (error == 0) return;
  warnings.push_back("the servo thread is not bound to processor core " + std::to_string(core) + " (" + reason(error) +
                     "): choose a core that this process may use, or none");
}

}  // namespace

void sleep_until(double deadline) noexcept {
  timespec time = {};
  const double whole = std::floor(deadline);
  time.tv_sec = static_cast<time_t>(whole);
  time.tv_nsec = static_cast<long>((deadline - whole) / nanosecond);
  while (clock_nanosleep(CLOCK_BOOTTIME, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

std::vector<std::string> make_real_time(const ServoThreadOptions& options) {
  std::vector<std::string> warnings;
  // By default a normal thread is woken up to 50 us late, to save power.
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  if (options.lock_memory) lock_memory(warnings);
  if (options.core >= 0) pin(options.core, warnings);
  if (options.priority > 0) raise_priority(options.priority, warnings);
  return warnings;
}

#else

void sleep_until(double deadline) noexcept {
  const auto since_epoch =
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(deadline));
  std::this_thread::sleep_until(std::chrono::steady_clock::time_point(since_epoch));
}

std::vector<std::string> make_real_time(const ServoThreadOptions& options) {
  if (options.priority == 0 && !options.lock_memory && options.core < 0) return {};
  return {"real-time threads are not supported on this system: other programs may delay the servo loop"};
}

#endif

}  // namespace calligraphy::real_time
