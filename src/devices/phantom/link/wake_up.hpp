// Wakes a thread that waits, from one that must not.
#pragma once

namespace calligraphy::phantom {

class WakeUp {
 public:
  /// @throws DeviceError when the system has no descriptor left
  WakeUp();
  ~WakeUp();
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;

  /// Neither blocks nor allocates; several calls before a wait count as one.
  void ring() noexcept;

  /// Until it is rung or the time is over [s].
  void wait(double seconds) noexcept;

  /// For a poll of one's own: readable once it was rung.
  int descriptor() const noexcept { return descriptor_; }
  /// Forgets that it was rung.
  void clear() noexcept;

 private:
  int descriptor_;
};

}  // namespace calligraphy::phantom
