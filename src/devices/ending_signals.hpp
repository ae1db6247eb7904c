// Operating-system services for a program that ends: signals, and functions that are safe in their handlers.
#pragma once

#include <cstddef>

namespace calligraphy {

/// From now on, every signal that ends or stops a program by default first calls `action`, then has its previous
/// effect. An ignored signal stays ignored. A handled one is left alone, unless it means that the program ends or has
/// crashed: SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT. Call it once.
void call_at_ending_signals(void (*action)() noexcept) noexcept;

/// Id of this process, different in a forked child; 0 where processes cannot fork. Async-signal-safe.
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
