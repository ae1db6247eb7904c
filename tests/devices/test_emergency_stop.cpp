// Children end in every way that a program can; the last force that each wrote remains in shared memory.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/devices/servo_loop.hpp>

#include "../catch.hpp"
#include "../sanitized.hpp"
#include "../still_clock.hpp"
#include "watched_device.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

/// What outlives a child.
struct Remains {
  std::atomic<double> force = 0.0;  ///< last written [N]
  std::atomic<int> cuts = 0;
  std::atomic<int> handled = 0;  ///< calls of the handler that was there before
  std::atomic<const void*> address = nullptr;
};

struct SharedRemains {
  SharedRemains() : memory(mmap(nullptr, sizeof(Remains), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    REQUIRE(memory != MAP_FAILED);
    remains = new (memory) Remains;
  }
  ~SharedRemains() { munmap(memory, sizeof(Remains)); }

  void* memory;
  Remains* remains = nullptr;
};

class SharedDevice : public HapticDevice {
 public:
  explicit SharedDevice(Remains& remains) : remains_(remains) { capabilities_.peak_force = 10.0; }
  const Capabilities& capabilities() const noexcept override { return capabilities_; }
  DeviceState read() noexcept override {
    DeviceState state;
    state.velocity.setZero();
    return state;
  }
  void write(const Eigen::Vector3d& force) noexcept override { remains_.force = force.x(); }
  void close() noexcept override { remains_.force = 0.0; }

 protected:
  Remains& remains_;
  Capabilities capabilities_;
};

/// As docs/own-backend.md has it.
class StoppableDevice final : public SharedDevice {
 public:
  using SharedDevice::SharedDevice;
  void cut_force() noexcept override {
    remains_.force = 0.0;
    ++remains_.cuts;
  }

 private:
  EmergencyStopEntry entry_{*this};
};

/// The child has none of the handlers of this program, nor its stack for them, and is alone in its group: what suspends
/// a program needs somebody outside the group who could continue it.
void forget_handlers() {
  setpgid(0, 0);
  const struct sigaction by_default = {};  // std::signal() would restart system calls, which a new program does not
  for (int signal = 1; signal <= SIGRTMAX; ++signal) sigaction(signal, &by_default, nullptr);
  std::set_terminate(std::abort);
  stack_t none = {};
  none.ss_flags = SS_DISABLE;
  sigaltstack(&none, nullptr);
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  alarm(60);  // a child that hangs is no success
}

/// The status of a child, which `ends` in the way under test.
int status_of_child(const std::function<void()>& ends) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    forget_handlers();
    ends();
    std::_Exit(99);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, WUNTRACED) == child);
  if (WIFSTOPPED(status)) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  return status;
}

bool exited(int status, int code) { return WIFEXITED(status) && WEXITSTATUS(status) == code; }
bool killed(int status, int signal) { return WIFSIGNALED(status) && WTERMSIG(status) == signal; }
bool stopped(int status, int signal) { return WIFSTOPPED(status) && WSTOPSIG(status) == signal; }

/// What each signal does by default, as the system itself has it; without SIGKILL and SIGSTOP, at which nothing can
/// run, and without those that its threads keep for themselves.
struct Signals {
  std::vector<int> end, suspend;
};

const Signals& signals() {
  static const Signals all = [] {
    Signals found;
    for (int signal = 1; signal <= SIGRTMAX; ++signal) {
      if (signal == SIGKILL || signal == SIGSTOP) continue;
      const int status = status_of_child([signal] {
        struct sigaction present = {};
        if (sigaction(signal, nullptr, &present) == 0) raise(signal);
      });
      if (killed(status, signal)) found.end.push_back(signal);
      if (stopped(status, signal)) found.suspend.push_back(signal);
    }
    return found;
  }();
  return all;
}

ServoLoopOptions quickly(double timeout = 0.5) {  // by default a busy machine is no fault
  ServoLoopOptions options;
  options.servo.ramp_up = 0.0;
  options.servo.timeout = timeout;
  options.thread.priority = 0;
  options.thread.lock_memory = false;
  return options;
}

std::atomic<bool> law_fails = false;

/// Never destroyed: a program that ends in the middle closes nothing.
template <class Value, class... Arguments>
Value& immortal(Arguments&&... arguments) {
  alignas(Value) static std::byte memory[sizeof(Value)];
  return *new (memory) Value(std::forward<Arguments>(arguments)...);
}

/// Writes 3 N in real time until the program ends.
template <class Device>
void press(Remains& remains, const std::function<void()>& fault = nullptr, double timeout = 0.5) {
  ServoLoop& loop = immortal<ServoLoop>(
      immortal<Device>(remains),
      [fault](const DeviceState&) -> Eigen::Vector3d {
        if (law_fails && fault) fault();
        return {3.0, 0.0, 0.0};
      },
      quickly(timeout));
  loop.start();
  while (remains.force != 3.0) std::this_thread::yield();
}

void read_nothing() {
  const volatile int* volatile nowhere = nullptr;
  static_cast<void>(*nowhere);
}

// Not a tail call, and nothing that a compiler may call endless.
int overflow_stack(int depth) {
  volatile char frame[1024];
  frame[0] = static_cast<char>(depth);
  return depth > 1'000'000'000 ? 0 : overflow_stack(depth + 1) + frame[0];
}

struct Ending {
  const char* name;
  std::function<void()> end;
  int exit_code;  ///< -1: a signal
  int signal;
};

std::vector<Ending> endings() {
  std::vector<Ending> all = {
      {"exit()", [] { std::exit(0); }, 0, 0},
      {"quick_exit()", [] { std::quick_exit(3); }, 3, 0},
      {"an exception that nobody catches", [] { std::thread([] { throw std::runtime_error("lost"); }).join(); }, -1,
       SIGABRT},
      {"abort()", [] { std::abort(); }, -1, SIGABRT},
      {"an access to no memory", [] { read_nothing(); }, -1, SIGSEGV},
      {"an endless recursion", [] { overflow_stack(0); }, -1, SIGSEGV},
  };
#if defined(__x86_64__) || defined(__i386__)
  all.push_back({"a breakpoint, after which the program would go on", [] { __asm__("int3"); }, -1, SIGTRAP});
#endif
  for (const int signal : signals().end)
    all.push_back({"a signal", [signal] { kill(getpid(), signal), pause(); }, -1, signal});
  return all;
}

struct Permitted {
  ~Permitted() { clear_emergency_stop(); }
};

}  // namespace

TEST_CASE("no force is left behind, however a program ends, and it ends as it would have ended", "[emergency]") {
  for (const Ending& ending : endings()) {
    CAPTURE(ending.name, ending.signal);
    const SharedRemains shared;
    const int status = status_of_child([&] {
      install_emergency_stop();
      press<SharedDevice>(*shared.remains);
      ending.end();
    });
    CHECK(shared.remains->force == 0.0);
    CHECK((ending.exit_code >= 0 ? exited(status, ending.exit_code) : killed(status, ending.signal)));
  }
}

TEST_CASE("a device with an entry is stopped without a servo loop", "[emergency]") {
  for (const Ending& ending : endings()) {
    CAPTURE(ending.name, ending.signal);
    const SharedRemains shared;
    status_of_child([&] {
      install_emergency_stop();
      immortal<StoppableDevice>(*shared.remains).write({3.0, 0.0, 0.0});
      ending.end();
    });
    CHECK(shared.remains->force == 0.0);
    CHECK(shared.remains->cuts > 0);
  }
}

TEST_CASE("the signals that end or suspend a program are those that POSIX lists, and the real-time ones",
          "[emergency]") {
  for (const int signal :
       {SIGABRT, SIGALRM, SIGBUS,  SIGFPE,  SIGHUP,  SIGILL,  SIGINT,    SIGPIPE, SIGPOLL, SIGPROF,  SIGQUIT,
        SIGSEGV, SIGSYS,  SIGTERM, SIGTRAP, SIGUSR1, SIGUSR2, SIGVTALRM, SIGXCPU, SIGXFSZ, SIGRTMIN, SIGRTMAX}) {
    CAPTURE(signal);
    CHECK(std::count(signals().end.begin(), signals().end.end(), signal) == 1);
  }
  CHECK(signals().suspend == std::vector{SIGTSTP, SIGTTIN, SIGTTOU});
}

TEST_CASE("a signal that arrives in the servo's own thread leaves no force behind", "[emergency]") {
  for (const int signal : signals().end) {
    CAPTURE(signal);
    const SharedRemains shared;
    const int status = status_of_child([&] {
      install_emergency_stop();
      press<SharedDevice>(
          *shared.remains, [signal] { raise(signal); }, 4e-3);  // it is the watchdog that writes zero
      law_fails = true;
      pause();
    });
    CHECK(killed(status, signal));
    CHECK(shared.remains->force == 0.0);
  }
}

TEST_CASE("a force law that crashes in the servo's own thread leaves no force behind", "[emergency]") {
  const bool overflows = GENERATE(false, true), has_entry = GENERATE(false, true);
  const auto crash = [overflows] { overflows ? void(overflow_stack(0)) : read_nothing(); };
  const SharedRemains shared;
  const int status = status_of_child([&] {
    install_emergency_stop();
    if (has_entry) {
      press<StoppableDevice>(*shared.remains, crash);
    } else {
      press<SharedDevice>(*shared.remains, crash, 4e-3);  // it is the watchdog that writes zero
    }
    law_fails = true;
    pause();
  });
  CHECK(killed(status, SIGSEGV));
  CHECK(shared.remains->force == 0.0);
}

TEST_CASE("without the emergency stop, and where nothing of it can run, the last force stays",
          "[emergency]") {
  const SharedRemains shared;
  CHECK(exited(status_of_child([&] { press<SharedDevice>(*shared.remains), std::_Exit(0); }), 0));
  CHECK(shared.remains->force == 3.0);
  const auto overflow_in_thread = [](bool has_stack_for_signals) {
    std::thread([=] {
      static std::array<std::byte, 1 << 15> memory;
      stack_t stack = {};
      stack.ss_sp = memory.data();
      stack.ss_size = memory.size();
      if (has_stack_for_signals) sigaltstack(&stack, nullptr);
      overflow_stack(0);
    }).join();
  };
  struct Unseen {
    const char* name;
    std::function<void()> end;
    double force;
  };
  for (const Unseen& unseen :
       {Unseen{"SIGKILL", [] { raise(SIGKILL); }, 3.0}, Unseen{"_exit()", [] { _exit(0); }, 3.0},
        Unseen{"execve()", [] { execl("/bin/true", "true", nullptr); }, 3.0},
        Unseen{"a stack overflow of a thread", [&] { overflow_in_thread(false); }, 3.0},
        Unseen{"a stack overflow of a thread that has called sigaltstack()", [&] { overflow_in_thread(true); }, 0.0}}) {
    CAPTURE(unseen.name);
    // Under sanitizers every thread has a stack for its signals.
    if (calligraphy_test::sanitized && std::string_view(unseen.name) == "a stack overflow of a thread") continue;
    const int status = status_of_child([&] {
      install_emergency_stop();
      press<SharedDevice>(*shared.remains);
      unseen.end();
    });
    CHECK_FALSE(exited(status, 99));
    CHECK(shared.remains->force == unseen.force);
  }
}

TEST_CASE("handlers installed before are called after the stop, with what they would have been told", "[emergency]") {
  static Remains* remains = nullptr;
  const SharedRemains shared;
  remains = shared.remains;
  const int status = status_of_child([] {
    struct sigaction earlier = {};
    earlier.sa_flags = SA_SIGINFO;
    earlier.sa_sigaction = [](int, siginfo_t* info, void*) {
      remains->handled += remains->force == 0.0 ? 1 : 100;
      remains->address = info->si_addr;
      std::_Exit(42);
    };
    sigaction(SIGSEGV, &earlier, nullptr);
    std::signal(SIGINT, [](int) { remains->handled += 10; });
    install_emergency_stop();
    press<StoppableDevice>(*remains);
    raise(SIGINT);  // which the program survives
    const volatile char* volatile nowhere = reinterpret_cast<const char*>(0x1230);
    static_cast<void>(*nowhere);
  });
  CHECK(exited(status, 42));
  CHECK(remains->handled == 11);
  CHECK(remains->address == reinterpret_cast<const void*>(0x1230));
}

TEST_CASE("a signal that is ignored stays ignored, and stops nothing", "[emergency]") {
  const SharedRemains shared;
  const int status = status_of_child([&] {
    for (const std::vector<int>& some : {signals().end, signals().suspend}) {
      for (const int signal : some) std::signal(signal, SIG_IGN);
    }
    install_emergency_stop();
    press<SharedDevice>(*shared.remains);
    for (const std::vector<int>& some : {signals().end, signals().suspend}) {
      for (const int signal : some) raise(signal);
    }
    std::_Exit(emergency_stopped() ? 1 : 0);
  });
  CHECK(exited(status, 0));
  CHECK(shared.remains->force == 3.0);
}

TEST_CASE("signals that a program handles for its own purposes stop nothing", "[emergency]") {
  static Remains* remains = nullptr;
  const SharedRemains shared;
  remains = shared.remains;
  const int status = status_of_child([] {
    const std::array own = {SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGPIPE, SIGIO, SIGTRAP, SIGRTMIN, SIGTTOU};
    for (const int signal : own) std::signal(signal, [](int) { ++remains->handled; });
    install_emergency_stop();
    press<SharedDevice>(*remains);
    for (const int signal : own) raise(signal);
    std::_Exit(emergency_stopped() || remains->handled != static_cast<int>(own.size()) ? 1 : 0);
  });
  CHECK(exited(status, 0));
  CHECK(shared.remains->force == 3.0);
}

TEST_CASE("a program that is suspended has no force while it stands still, each time", "[emergency]") {
  for (const int signal : signals().suspend) {
    CAPTURE(signal);
    const SharedRemains shared;
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      forget_handlers();
      install_emergency_stop();
      press<SharedDevice>(*shared.remains);
      raise(signal);
      clear_emergency_stop();
      while (shared.remains->force != 3.0) std::this_thread::yield();
      raise(signal);
      std::_Exit(7);
    }
    int status = 0;
    for (int i = 0; i < 2; ++i) {
      REQUIRE(waitpid(child, &status, WUNTRACED) == child);
      REQUIRE(stopped(status, signal));
      CHECK(shared.remains->force == 0.0);
      kill(child, SIGCONT);
    }
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(exited(status, 7));
  }
}

TEST_CASE("a read that is suspended goes on when the program does", "[emergency]") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    forget_handlers();
    install_emergency_stop();
    std::thread([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      kill(getpid(), SIGTTIN);
    }).detach();
    char letter = 0;
    std::_Exit(read(ends[0], &letter, 1) == 1 ? letter : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, WUNTRACED) == child);
  CHECK(stopped(status, SIGTTIN));
  kill(child, SIGCONT);
  CHECK(write(ends[1], "\7", 1) == 1);
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(exited(status, 7));
  close(ends[0]);
  close(ends[1]);
}

TEST_CASE("an entry that restores the terminal from the background does not suspend a program that ends",
          "[emergency]") {
  const SharedRemains shared;
  const int status = status_of_child([&] {
    // The leader of a session of its own, whose terminal is that of its group; the program is in the background.
    const pid_t leader = fork();
    if (leader == 0) {
      setsid();
      const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
      if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) std::_Exit(2);
      static int tty = -1;
      tty = open(ptsname(terminal), O_RDWR);
      if (tty < 0 || tcgetpgrp(tty) != getpgrp()) std::_Exit(3);
      const int ending = status_of_child([&] {
        install_emergency_stop();
        const EmergencyStopEntry entry(&shared.remains->handled, [](void* handled) noexcept {
          termios modes = {};
          if (tcgetattr(tty, &modes) == 0 && tcsetattr(tty, TCSANOW, &modes) == 0)
            ++*static_cast<std::atomic<int>*>(handled);
        });
        press<StoppableDevice>(*shared.remains);
        raise(SIGTERM);
      });
      std::_Exit(killed(ending, SIGTERM) ? 0 : 4);
    }
    int ended = 0;
    waitpid(leader, &ended, 0);
    std::_Exit(WIFEXITED(ended) ? WEXITSTATUS(ended) : 5);
  });
  CHECK(exited(status, 0));
  CHECK(shared.remains->handled == 1);
  CHECK(shared.remains->force == 0.0);
}

TEST_CASE("terminate handlers installed before are called after the stop", "[emergency]") {
  const SharedRemains shared;
  const int status = status_of_child([&] {
    std::set_terminate([] { std::_Exit(43); });
    install_emergency_stop();
    press<SharedDevice>(*shared.remains);
    std::terminate();
  });
  CHECK(exited(status, 43));
  CHECK(shared.remains->force == 0.0);
}

TEST_CASE("installing it again changes nothing", "[emergency]") {
  const SharedRemains shared;
  const int status = status_of_child([&] {
    install_emergency_stop();
    install_emergency_stop();
    press<SharedDevice>(*shared.remains);
    raise(SIGTERM);
  });
  CHECK(killed(status, SIGTERM));
  CHECK(shared.remains->force == 0.0);
}

TEST_CASE("after an emergency stop a servo writes zero until it is cleared, then ramps up from zero", "[emergency]") {
  const Permitted at_the_end;
  WatchedDevice device;
  device.state.velocity.setZero();
  int asked = 0;
  Servo servo(
      device, [&](const DeviceState&) -> Eigen::Vector3d { return ++asked, Eigen::Vector3d(3.0, 0.0, 0.0); },
      calligraphy_test::untimed());
  double now = 0.0;
  const auto step = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) servo.step(now += 1e-3);
  };
  step(300);
  REQUIRE(device.last() == 3.0);
  emergency_stop();
  CHECK(emergency_stopped());
  device.forces.clear();
  asked = 0;
  step(100);
  REQUIRE(device.forces.size() == 100);
  for (const Eigen::Vector3d& force : device.forces) REQUIRE(force.isZero(0.0));
  CHECK(asked == 0);
  CHECK(servo.halted());
  CHECK(servo.status().phase == ServoPhase::zero);
  CHECK(servo.status().fault == DeviceFault::emergency_stop);
  CHECK(servo.statistics().faults[static_cast<std::size_t>(DeviceFault::emergency_stop)] == 1);
  clear_emergency_stop();
  device.forces.clear();
  step(300);
  double last = 0.0;
  for (const Eigen::Vector3d& force : device.forces) {
    CHECK(force.x() - last <= 3.0 * 1e-3 / 0.2 + 1e-12);
    last = force.x();
  }
  CHECK(last == 3.0);
  CHECK_FALSE(servo.halted());
  CHECK(servo.status().fault == DeviceFault::none);
}

TEST_CASE("an emergency stop between the decision on a force and its writing is followed by zero", "[emergency]") {
  const Permitted at_the_end;
  WatchedDevice device;
  device.state.velocity.setZero();
  ServoOptions options;
  options.ramp_up = 0.0;
  Servo servo(
      device, [](const DeviceState&) { return Eigen::Vector3d(3.0, 0.0, 0.0); }, calligraphy_test::untimed(options));
  servo.step(0.001);
  device.while_writing = [] { emergency_stop(); };
  servo.step(0.002);
  CHECK(device.last() == 0.0);
  CHECK(servo.halted());
}

TEST_CASE("the watchdog's ramp-down is cut as well", "[emergency]") {
  const Permitted at_the_end;
  WatchedDevice device;
  device.state.velocity.setZero();
  ServoOptions options;
  options.ramp_up = 0.0;
  Servo servo(
      device, [](const DeviceState&) { return Eigen::Vector3d(3.0, 0.0, 0.0); }, calligraphy_test::untimed(options));
  servo.step(0.001);
  for (int i = 0; i < 7; ++i) servo.supervise(0.001 * i);
  REQUIRE((device.last() > 0.0 && device.last() < 3.0));
  emergency_stop();
  servo.supervise(0.007);
  CHECK(device.last() == 0.0);
}

TEST_CASE("a servo loop cannot be started after an emergency stop that was not cleared", "[emergency]") {
  const Permitted at_the_end;
  WatchedDevice device;
  ServoLoop loop(
      device, [](const DeviceState&) { return Eigen::Vector3d(3.0, 0.0, 0.0); }, quickly());
  emergency_stop();
  CHECK_THROWS_WITH(loop.start(), Catch::Contains("clear_emergency_stop"));
  CHECK_FALSE(loop.running());
  clear_emergency_stop();
  loop.start();
  loop.stop();
}

TEST_CASE("a forked child that ends takes no force from the devices of its parent", "[emergency]") {
  const SharedRemains shared;
  StoppableDevice device(*shared.remains);
  device.write({3.0, 0.0, 0.0});
  CHECK(killed(status_of_child([] { install_emergency_stop(), raise(SIGTERM); }), SIGTERM));
  CHECK(shared.remains->force == 3.0);
}

TEST_CASE("what is removed or destroyed is stopped no more, and its place is free again", "[emergency]") {
  const Permitted at_the_end;
  int stops = 0;
  const auto count = [](void* object) noexcept { ++*static_cast<int*>(object); };
  {
    const EmergencyStopEntry destroyed(&stops, count);
    EmergencyStopEntry removed(&stops, count);
    emergency_stop();
    CHECK(stops == 2);
    removed.remove();
    removed.remove();
    emergency_stop();
    CHECK(stops == 3);
  }
  emergency_stop();
  CHECK(stops == 3);
  for (std::size_t i = 0; i < 2 * EmergencyStopEntry::max_entries; ++i) const EmergencyStopEntry entry(&stops, count);
  std::vector<std::unique_ptr<EmergencyStopEntry>> entries;
  for (std::size_t i = 0; i < EmergencyStopEntry::max_entries; ++i) {
    entries.push_back(std::make_unique<EmergencyStopEntry>(&stops, count));
  }
  CHECK_THROWS_AS(EmergencyStopEntry(&stops, count), DeviceError);
  stops = 0;
  emergency_stop();
  CHECK(stops == static_cast<int>(EmergencyStopEntry::max_entries));
}

TEST_CASE("an entry is not removed while it is being stopped in another thread", "[emergency]") {
  const Permitted at_the_end;
  struct Object {
    std::atomic<bool> entered = false, left = false;
  } object;
  EmergencyStopEntry entry(&object, [](void* self) noexcept {
    auto& object = *static_cast<Object*>(self);
    object.entered = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    object.left = true;
  });
  std::thread stopping([] { emergency_stop(); });
  while (!object.entered) std::this_thread::yield();
  entry.remove();
  CHECK(object.left);
  stopping.join();
}
