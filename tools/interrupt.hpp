// Ctrl-C as a flag that a loop polls, so that devices are released, results written and empty directories removed before
// the program ends as a shell expects: by the signal.
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

/// Ends the program by the signal that an Interrupt has received, if any: a shell's loop ends with it, and the exit code
/// says why.
void end_if_interrupted() noexcept;

}  // namespace calligraphy::tools
