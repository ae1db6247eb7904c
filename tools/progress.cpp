#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <fmt/format.h>

namespace calligraphy::tools {
namespace {

/// As long as the longest text, and shorter than any message, which overwrites it.
constexpr int width = 25;

std::string time_left(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.0f} s left", std::ceil(seconds));
  const long minutes = std::lround(std::floor(seconds / 60.0));
  if (minutes < 60) return fmt::format("{} min {:.0f} s left", minutes, seconds - 60.0 * static_cast<double>(minutes));
  return fmt::format("{} h {} min left", minutes / 60, minutes % 60);
}

/// The cursor returns to the beginning of the line, so that what is printed next replaces it.
void draw(const std::string& text) {
  fmt::print(stderr, "{:<{}}\r", text, width);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress() : on_terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (on_terminal_) draw("");
}

void Progress::show(double share) {
  constexpr std::chrono::milliseconds interval{100};
  constexpr double long_enough = 1.0;  // before the time left is known [s]
  share_ = std::clamp(share, share_, 1.0);
  const Clock::time_point now = Clock::now();
  if (!on_terminal_ || now < next_) return;
  next_ = now + interval;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const bool known = elapsed > long_enough && share_ > 0.0;
  draw(fmt::format("{:3.0f} %", std::floor(100.0 * share_)) + (known ? ", " + time_left(elapsed / share_ - elapsed) : ""));
}

}  // namespace calligraphy::tools
