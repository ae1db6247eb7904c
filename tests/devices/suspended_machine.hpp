// A machine that has been suspended, as far as this program can tell.
#pragma once

namespace calligraphy_test {

/// During its lifetime CLOCK_BOOTTIME has gone on by that much while every other clock stood still [s]. Linux only.
class SuspendedMachine {
 public:
  explicit SuspendedMachine(long seconds);
  ~SuspendedMachine();
  SuspendedMachine(const SuspendedMachine&) = delete;
  SuspendedMachine& operator=(const SuspendedMachine&) = delete;
};

}  // namespace calligraphy_test
