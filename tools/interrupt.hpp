// Ctrl-C as a flag that a loop polls, so that devices are released and empty directories removed before the exit.
#pragma once

#include <array>

namespace calligraphy::tools {

/// During its lifetime SIGINT, SIGTERM and SIGHUP only set a flag; the third one terminates the program, because people
/// press Ctrl-C twice. A signal that was ignored stays ignored.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool asked() const noexcept;
  /// For work that leaves nothing behind when aborted. @throws Error if asked()
  void check() const;

 private:
  std::array<void (*)(int), 3> before_;
};

}  // namespace calligraphy::tools
