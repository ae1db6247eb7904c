// Emergency stop: zero force on every open device when the program ends, however it ends.
#pragma once

#include <cstddef>

namespace calligraphy {

class HapticDevice;

/// Calls emergency_stop() when the program ends: at exit() and quick_exit(), at std::terminate() (an uncaught
/// exception), and at every signal whose default action ends or stops it: Ctrl-C, Ctrl-Z and crashes, but also SIGPIPE,
/// SIGALRM, SIGUSR1 or a real-time signal. The signal then ends or stops the program as before: exit codes and core
/// dumps stay as they were. A signal that is ignored stays ignored. An earlier handler for SIGINT, SIGTERM, SIGHUP,
/// SIGQUIT, SIGTSTP, SIGSEGV, SIGBUS, SIGFPE, SIGILL or SIGABRT is called after the stop; with a handler for any other
/// signal the program goes on, and so does the force.
///
/// Call it once, at the start of main() and after the program has installed its own handlers; further calls do nothing.
/// A handler that is installed later replaces it and should call emergency_stop() itself. A handler installed with
/// SA_RESETHAND is called once, as requested: the second such signal ends the program by its default action, with the
/// force on. Nothing can run at SIGKILL, SIGSTOP, _exit(), execve(), a power failure, or a stack overflow in a thread
/// of your own that has not called sigaltstack(): then only the device's own watchdog remains
/// (HapticDevice::warnings()).
void install_emergency_stop();

/// Sets the force to zero at once, without a ramp, on every device that has an entry (all built-in backends; one line
/// for your own) and every device behind a Servo, and keeps it there. A device without either, which a program writes
/// to directly, keeps its force. Returns once the devices have received it: after a few milliseconds, plus at most
/// 0.1 s for each device or loop whose own thread does not answer. Async-signal-safe; callable from any thread.
void emergency_stop() noexcept;

/// Whether emergency_stop() was called and the force has not been permitted again.
bool emergency_stopped() noexcept;

/// Permits forces again; a running servo loop ramps up from zero. Not for use in a signal handler.
void clear_emergency_stop() noexcept;

/// Registers an object to be stopped by emergency_stop(), for as long as the entry lives. Constructing and removing it
/// is thread-safe, but not allowed in a signal handler.
class EmergencyStopEntry {
 public:
  /// Sets the force of an object to zero.
  using Stop = void (*)(void* object) noexcept;

  /// Maximum number of entries at a time, in the whole program.
  static constexpr std::size_t max_entries = 256;

  /// Will call HapticDevice::cut_force(). Make it the last member of the device's class, so that it is removed first.
  /// @throws DeviceError when there are `max_entries` already
  explicit EmergencyStopEntry(HapticDevice& device);
  /// `stop` must be async-signal-safe and return within 0.1 s. @throws as above
  EmergencyStopEntry(void* object, Stop stop);
  /// Calls remove().
  ~EmergencyStopEntry() { remove(); }
  EmergencyStopEntry(const EmergencyStopEntry&) = delete;
  EmergencyStopEntry& operator=(const EmergencyStopEntry&) = delete;

  /// Ends the registration, after waiting for an emergency stop that is under way in another thread.
  void remove() noexcept;

 private:
  static constexpr std::size_t none = max_entries;

  std::size_t slot_ = none;
};

}  // namespace calligraphy
