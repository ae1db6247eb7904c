#include "ending_signals.hpp"

#include <algorithm>
#include <array>
#include <csignal>

// Emscripten has no devices and only some of the functions.
#if (defined(__unix__) || defined(__APPLE__)) && !defined(__EMSCRIPTEN__)
#define CALLIGRAPHY_POSIX_SIGNALS
#endif

#if defined(CALLIGRAPHY_POSIX_SIGNALS)
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#else
#include <chrono>
#include <thread>
#endif

namespace calligraphy {
namespace {

void (*to_call)() noexcept = nullptr;

}  // namespace

#if defined(CALLIGRAPHY_POSIX_SIGNALS)

namespace {

/// Whether a program continues at this signal by default. Every other signal, under whatever name, ends or stops it.
bool is_harmless(int signal) noexcept {
#if defined(SIGINFO) && !defined(SIGPWR)  // where both exist they are one, which ends a program
  if (signal == SIGINFO) return true;
#endif
  return signal == SIGCHLD || signal == SIGCONT || signal == SIGURG || signal == SIGWINCH;
}

/// Whether this signal means that the program is to end or has crashed, even if it handles the signal. Other handled
/// signals (SIGUSR1, a timer, a profiler's SIGPROF) are its own business, and it continues.
bool ends_if_handled(int signal) noexcept {
  constexpr std::array signals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
  return std::find(signals.begin(), signals.end(), signal) != signals.end();
}

bool stops_program(int signal) noexcept { return signal == SIGTSTP || signal == SIGTTIN || signal == SIGTTOU; }

bool is(const struct sigaction& action, void (*handler)(int)) noexcept {
  return (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == handler;
}

/// Dispositions before ours, by signal number.
std::array<struct sigaction, NSIG> before;

extern "C" void calligraphy_at_ending_signal(int signal, siginfo_t* info, void* context);

void install(int signal, const struct sigaction& old) noexcept {
  struct sigaction ours = old;
  ours.sa_sigaction = calligraphy_at_ending_signal;
  ours.sa_flags = (old.sa_flags | SA_SIGINFO | SA_ONSTACK) & ~static_cast<int>(SA_RESETHAND);
  if (is(old, SIG_DFL)) {
    ours.sa_flags |= SA_RESTART;        // a program that was merely suspended had no handler either
    sigaddset(&ours.sa_mask, SIGTTOU);  // restoring the terminal from the background must not be stopped midway
  }
  sigaction(signal, &ours, nullptr);
}

void restore_default(int signal) noexcept {
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
}

/// Whether an instruction that cannot be executed raised the signal, as opposed to a signal sent by a process, and to
/// SIGTRAP and SIGSYS, whose instruction is complete.
bool is_own_fault(int signal, const siginfo_t& info) noexcept {
  return (signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL) && info.si_code > 0;
}

void do_as_before(const struct sigaction& action, int signal, siginfo_t* info, void* context) noexcept {
  const bool by_default = is(action, SIG_DFL);
  if (by_default || (action.sa_flags & SA_RESETHAND) != 0) restore_default(signal);
  if (by_default && stops_program(signal)) {
    raise(signal);
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, signal);
    pthread_sigmask(SIG_UNBLOCK, &blocked, nullptr);  // the program is suspended here, and later continues from here
    install(signal, action);
  } else if (by_default) {
    // The instruction is executed again on return, so that a core dump shows where and why it failed; any other signal
    // is sent again, and arrives on return.
    if (!is_own_fault(signal, *info)) raise(signal);
  } else if ((action.sa_flags & SA_SIGINFO) != 0) {
    action.sa_sigaction(signal, info, context);
  } else if (action.sa_handler != SIG_IGN) {
    action.sa_handler(signal);
  }
}

extern "C" void calligraphy_at_ending_signal(int signal, siginfo_t* info, void* context) {
  const int error = errno;
  to_call();
  do_as_before(before[static_cast<std::size_t>(signal)], signal, info, context);
  errno = error;
}

}  // namespace

void call_at_ending_signals(void (*action)() noexcept) noexcept {
  static const SignalStack stack;
  to_call = action;
  for (int signal = 1; signal < NSIG; ++signal) {  // the system refuses SIGKILL, SIGSTOP and those its threads need
    struct sigaction& old = before[static_cast<std::size_t>(signal)];
    if (is_harmless(signal) || sigaction(signal, nullptr, &old) != 0) continue;
    if (is(old, SIG_IGN)) continue;  // as nohup requires
    if (is(old, SIG_DFL) || ends_if_handled(signal)) install(signal, old);
  }
}

long this_process() noexcept { return getpid(); }

void pause_in_signal_handler() noexcept { poll(nullptr, 0, 1); }

SignalStack::SignalStack() noexcept {
  stack_t present = {};
  if (sigaltstack(nullptr, &present) != 0 || (present.ss_flags & SS_DISABLE) == 0) return;
  stack_t ours = {};
  ours.ss_sp = memory_;
  ours.ss_size = size;
  used_ = sigaltstack(&ours, nullptr) == 0;
}

SignalStack::~SignalStack() {
  if (!used_) return;
  stack_t present = {};
  if (sigaltstack(nullptr, &present) != 0 || present.ss_sp != memory_) return;
  stack_t off = {};
  off.ss_flags = SS_DISABLE;
  off.ss_size = size;  // required by macOS
  sigaltstack(&off, nullptr);
}

#else

namespace {

constexpr std::array ending_signals = {SIGINT,  SIGTERM, SIGSEGV, SIGFPE, SIGILL, SIGABRT,
#if defined(SIGBREAK)  // Ctrl-Break on Windows
                                       SIGBREAK
#endif
};

std::array<void (*)(int), ending_signals.size()> before;

extern "C" void calligraphy_at_ending_signal(int signal) {
  to_call();
  for (std::size_t i = 0; i < ending_signals.size(); ++i) {
    if (ending_signals[i] != signal) continue;
    std::signal(signal, before[i]);
    std::raise(signal);
  }
}

}  // namespace

void call_at_ending_signals(void (*action)() noexcept) noexcept {
  to_call = action;
  for (std::size_t i = 0; i < ending_signals.size(); ++i) {
    before[i] = std::signal(ending_signals[i], calligraphy_at_ending_signal);
    if (before[i] == SIG_IGN) std::signal(ending_signals[i], SIG_IGN);
  }
}

long this_process() noexcept { return 0; }

void pause_in_signal_handler() noexcept { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

SignalStack::SignalStack() noexcept = default;
SignalStack::~SignalStack() = default;

#endif

}  // namespace calligraphy
