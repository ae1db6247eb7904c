// Operating-system services for a program that ends: signals, and what may be done while one is handled.
#pragma once

#include <cstddef>

namespace calligraphy {

/// From here on calls `action` first at every signal that ends or stops a program by default, then does what the signal
/// did before. A signal that is ignored stays ignored. One that is handled stays as it is, unless it means that the
/// program ends or has crashed: SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT.
/// Call it once.
void call_at_ending_signals(void (*action)() noexcept) noexcept;

/// Number of this process, which a forked child has not inherited; 0 where processes are not forked. Async-signal-safe.
long this_process() noexcept;

/// Waits for about a millisecond. Async-signal-safe.
void pause_in_signal_handler() noexcept;

/// A stack for the signal handlers of the thread that constructs and destroys it: they run even when the thread's own
/// stack has overflowed. A thread that has one already keeps it.
class SignalStack {
 public:
  SignalStack() noexcept;
  ~SignalStack();
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  static constexpr std::size_t size = 1 << 15;  // [bytes]

  alignas(16) std::byte memory_[size];
  bool used_ = false;
};

}  // namespace calligraphy
