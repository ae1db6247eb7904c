#include "progress.hpp"

#include <algorithm>
#include <iostream>

#include <unistd.h>

namespace calligraphy::tools {
namespace {

constexpr unsigned long steps = 1000;

}  // namespace

Progress::Progress() {
  if (isatty(STDERR_FILENO) != 0) display_ = std::make_unique<boost::timer::progress_display>(steps, std::cerr);
}

Progress::~Progress() {
  if (display_ && display_->count() < steps) std::cerr << std::endl;  // later output starts on a new line
}

void Progress::show(double share) {
  if (!display_) return;
  const auto reached = static_cast<unsigned long>(std::clamp(share, 0.0, 1.0) * steps);
  if (reached > display_->count()) *display_ += reached - display_->count();
}

}  // namespace calligraphy::tools
