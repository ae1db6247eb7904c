#include "stop_key.hpp"

#include <poll.h>
#include <unistd.h>

namespace calligraphy::tools {
namespace {

constexpr char escape = 0x1B;

}  // namespace

StopKey::StopKey() {
  // A program in the background would be stopped if it changed the terminal.
  if (tcgetattr(STDIN_FILENO, &before_) != 0 || tcgetpgrp(STDIN_FILENO) != getpgrp()) return;
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  keys.c_cc[VMIN] = 1;
  keys.c_cc[VTIME] = 0;
  entry_.emplace(this, restore);
  if (tcsetattr(STDIN_FILENO, TCSANOW, &keys) != 0) entry_.reset();
}

StopKey::~StopKey() {
  if (entry_) restore(this);
}

std::string StopKey::look() {
  std::string others;
  if (!entry_) return others;
  pollfd terminal{STDIN_FILENO, POLLIN, 0};
  char key = 0;
  while (poll(&terminal, 1, 0) == 1 && (terminal.revents & POLLIN) != 0 && read(STDIN_FILENO, &key, 1) == 1) {
    if (key != ' ' && key != escape) {
      others += key;
      continue;
    }
    emergency_stop();
    pressed_ = true;
  }
  return others;
}

std::string stop_keys(const StopKey& key, const Language& language) {
  return key.available() ? language.text("write.stop_keys") : "Ctrl-C";
}

/// Async-signal-safe: all three are. In the background the terminal is another program's.
void StopKey::restore(void* self) noexcept {
  if (tcgetpgrp(STDIN_FILENO) != getpgrp()) return;
  tcsetattr(STDIN_FILENO, TCSANOW, &static_cast<const StopKey*>(self)->before_);
}

}  // namespace calligraphy::tools
