// Progress on a terminal.
#pragma once

#include <chrono>

namespace calligraphy::tools {

/// One line on standard error, " 43 %, 2 min 10 s left", only if that is a terminal; the destructor removes it.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the fraction of the work done, in [0, 1]; it never falls.
  void show(double share);

 private:
  using Clock = std::chrono::steady_clock;

  const bool on_terminal_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point next_ = begin_;
  double share_ = 0.0;
};

}  // namespace calligraphy::tools
