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

/// A program that handles one of these is about to end, or to stand still; others it may handle for ends of its own.
constexpr std::array stopping_if_handled = {SIGINT,  SIGTERM, SIGHUP, SIGQUIT, SIGTSTP,
                                            SIGSEGV, SIGBUS,  SIGFPE, SIGILL,  SIGABRT};

/// Those that nobody can handle, and those that a program takes no notice of by default. All others end or suspend it,
/// those of real-time applications and of future systems included.
constexpr std::array left_alone = {
    SIGKILL, SIGSTOP, SIGCHLD, SIGCONT, SIGURG, SIGWINCH,
#if defined(__APPLE__) || defined(__FreeBSD__) || defined(__NetBSD__) || defined(__OpenBSD__)
    SIGINFO, SIGIO,
#endif
};

/// Dispositions before ours, by the number of the signal.
std::array<struct sigaction, NSIG> before;

template <std::size_t count>
bool contains(const std::array<int, count>& list, int signal) noexcept {
  return std::find(list.begin(), list.end(), signal) != list.end();
}

bool is_handled_by(const struct sigaction& action, void (*handler)(int)) noexcept {
  return (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == handler;
}

bool suspends(int signal) noexcept { return signal == SIGTSTP || signal == SIGTTIN || signal == SIGTTOU; }

extern "C" void calligraphy_at_ending_signal(int signal, siginfo_t* info, void* context);

void install(int signal, const struct sigaction& old) noexcept {
  struct sigaction ours = old;
  ours.sa_sigaction = calligraphy_at_ending_signal;
  ours.sa_flags = (old.sa_flags | SA_SIGINFO | SA_ONSTACK) & ~static_cast<int>(SA_RESETHAND);
  sigaction(signal, &ours, nullptr);
}

void restore_default(int signal) noexcept {
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
}

/// An instruction that cannot be executed, as opposed to a signal that some process has sent.
bool is_own_fault(int signal, const siginfo_t& info) noexcept {
  return (signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL) && info.si_code > 0;
}

void do_as_before(const struct sigaction& action, int signal, siginfo_t* info, void* context) noexcept {
  const bool by_default = is_handled_by(action, SIG_DFL);
  if (by_default || (action.sa_flags & SA_RESETHAND) != 0) restore_default(signal);
  if (by_default && suspends(signal)) {
    raise(signal);
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, signal);
    pthread_sigmask(SIG_UNBLOCK, &blocked, nullptr);  // the program is suspended here, and goes on from here
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
  for (int signal = 1; signal < NSIG; ++signal) {
    if (contains(left_alone, signal)) continue;
    struct sigaction& old = before[static_cast<std::size_t>(signal)];
    if (sigaction(signal, nullptr, &old) != 0) continue;  // the C library's own
    if (is_handled_by(old, SIG_IGN)) continue;            // as nohup requires
    if (is_handled_by(old, SIG_DFL) || contains(stopping_if_handled, signal)) install(signal, old);
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
  off.ss_size = size;  // which macOS requires
  sigaltstack(&off, nullptr);
}

#else

namespace {

constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGSEGV, SIGFPE, SIGILL, SIGABRT};

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
