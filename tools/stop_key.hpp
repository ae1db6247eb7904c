// Space and Esc as a force-off key, and what else is pressed.
#pragma once

#include <optional>
#include <string>
#include <string>

#include <termios.h>

#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/judge/language.hpp>

namespace calligraphy::tools {

/// While it lives, the terminal on standard input passes keys on as they are pressed and does not show them. The
/// destructor restores it, as does an emergency stop, with which every other way out begins. Without a terminal, or in
/// the background, it does nothing.
class StopKey {
 public:
  StopKey();
  ~StopKey();
  StopKey(const StopKey&) = delete;
  StopKey& operator=(const StopKey&) = delete;

  bool available() const noexcept { return entry_.has_value(); }

  /// Takes the force from every device if space or Esc was pressed since the last call, and returns the other keys that
  /// were. To be called some 50 times a second.
  std::string look();
  /// Whether it was ever pressed.
  bool pressed() const noexcept { return pressed_; }

 private:
  static void restore(void* self) noexcept;

  termios before_ = {};
  std::optional<EmergencyStopEntry> entry_;  ///< while keys are read
  bool pressed_ = false;
};

/// What a person presses to stop: "space, Esc or Ctrl-C", or "Ctrl-C" where no keys are read.
std::string stop_keys(const StopKey& key, const Language& language = {});

}  // namespace calligraphy::tools
