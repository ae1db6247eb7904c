// Wakes a waiting thread from a thread that must not block.
#pragma once

namespace calligraphy::phantom {

class WakeUp {
 public:
  /// @throws DeviceError when the system cannot provide a descriptor
  WakeUp();
  ~WakeUp();
  WakeUp(const WakeUp&) = delete;
  WakeUp& operator=(const WakeUp&) = delete;

  /// Neither blocks nor allocates; several calls before a wait count as one.
  void ring() noexcept;

  /// Waits until it is rung or the time [s] has elapsed.
  void wait(double seconds) noexcept;

  /// For your own poll(): readable once it was rung.
  int descriptor() const noexcept { return descriptor_; }
  void clear() noexcept;

 private:
  int descriptor_;
};

}  // namespace calligraphy::phantom
