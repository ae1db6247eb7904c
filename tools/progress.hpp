// A progress bar on a terminal.
#pragma once

#include <memory>

#include <boost/timer/progress_display.hpp>

namespace calligraphy::tools {

/// Draws on standard error, only if that is a terminal.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the fraction of the work done, in [0, 1]; the bar never moves backwards.
  void show(double share);

 private:
  std::unique_ptr<boost::timer::progress_display> display_;
};

}  // namespace calligraphy::tools
