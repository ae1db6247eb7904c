// A progress bar on a terminal.
#pragma once

#include <memory>

#include <boost/timer/progress_display.hpp>

namespace calligraphy::tools {

/// Draws on standard error, and only when that is a terminal.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Share of the work that is done, in [0, 1]; never goes back.
  void show(double share);

 private:
  std::unique_ptr<boost::timer::progress_display> display_;
};

}  // namespace calligraphy::tools
