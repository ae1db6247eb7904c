// Ctrl-C as a question that a loop asks, so that a device is let go, and an empty directory removed, before the end.
#pragma once

#include <array>

namespace calligraphy::tools {

/// While it lives, SIGINT, SIGTERM and SIGHUP are remembered; only the third one ends the program as it would have
/// before: people press Ctrl-C twice. One that was ignored stays so.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool asked() const noexcept;
  /// For work that leaves nothing behind. @throws Error when asked()
  void check() const;

 private:
  std::array<void (*)(int), 3> before_;
};

}  // namespace calligraphy::tools
