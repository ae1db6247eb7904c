// Ctrl-C as a flag that a loop polls, so that devices are released and empty directories removed before the exit.
#pragma once

namespace calligraphy::tools {

/// During its lifetime SIGINT, SIGTERM and SIGHUP take the force from every device and set a flag; the third one
/// terminates the program, because people press Ctrl-C twice. A signal that was ignored stays ignored. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool asked() const noexcept;
  /// For work that leaves nothing behind when aborted. @throws Error if asked()
  void check() const;
};

}  // namespace calligraphy::tools
