#include "interrupt.hpp"

#include <array>
#include <csignal>
#include <cstddef>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/emergency_stop.hpp>

namespace calligraphy::tools {
namespace {

constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGHUP};
constexpr int last_straw = 3;

volatile std::sig_atomic_t signalled = 0;    ///< how often
volatile std::sig_atomic_t last_signal = 0;  ///< outlives the Interrupt

/// Dispositions before; for one Interrupt at a time.
std::array<struct sigaction, signals.size()> before;

void restore(std::size_t i) noexcept { sigaction(signals[i], &before[i], nullptr); }

extern "C" void remember(int signal) {
  emergency_stop();  // the person wants no more of it, whatever the program still has to write
  const int count = signalled + 1;
  signalled = count;
  last_signal = signal;
  if (count + 1 < last_straw) return;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (signals[i] == signal) restore(i);
  }
}

}  // namespace

Interrupt::Interrupt() {
  signalled = 0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    struct sigaction ours = {};
    ours.sa_handler = remember;
    ours.sa_flags = SA_RESTART;
    sigaction(signals[i], &ours, &before[i]);
    const bool ignored = (before[i].sa_flags & SA_SIGINFO) == 0 && before[i].sa_handler == SIG_IGN;
    if (ignored) restore(i);  // as nohup requires
  }
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < signals.size(); ++i) restore(i);
}

bool Interrupt::asked() const noexcept { return signalled != 0; }

void Interrupt::check() const {
  if (asked()) throw Error("interrupted");
}

void end_if_interrupted() noexcept {
  if (last_signal == 0) return;
  std::signal(last_signal, SIG_DFL);
  std::raise(last_signal);
}

}  // namespace calligraphy::tools
