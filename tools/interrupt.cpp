#include "interrupt.hpp"

#include <csignal>

#include <calligraphy/base/error.hpp>

namespace calligraphy::tools {
namespace {

constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGHUP};
constexpr int last_straw = 3;

volatile std::sig_atomic_t signalled = 0;

extern "C" void remember(int signal) {
  const int count = signalled + 1;
  signalled = count;
  if (count + 1 >= last_straw) std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
  signalled = 0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    before_[i] = std::signal(signals[i], remember);
    if (before_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);  // as nohup requires
  }
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], before_[i]);
}

bool Interrupt::asked() const noexcept { return signalled != 0; }

void Interrupt::check() const {
  if (asked()) throw Error("interrupted");
}

}  // namespace calligraphy::tools
