// Devices and renderers that a loop uses in a thread of its own.
#pragma once

#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

namespace calligraphy::python {

/// While it lives the device, and the renderer if there is one, belong to a loop. Whoever else asks is refused by
/// idle(), where C++ would race. The GIL is held by whoever makes, ends or asks.
class AtWork {
 public:
  /// @throws Error when one of them is at work already
  explicit AtWork(const HapticDevice& device, const HapticRenderer* renderer = nullptr);
  ~AtWork();
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

 private:
  const HapticDevice& device_;
  const HapticRenderer* renderer_;
};

/// Within a force law, which runs in the loop's own thread, everything may be used.
class InLaw {
 public:
  explicit InLaw(const void* law) noexcept;
  ~InLaw();
  InLaw(const InLaw&) = delete;
  InLaw& operator=(const InLaw&) = delete;

  static bool here() noexcept;
  /// Within this one, also where it has called another.
  static bool here(const void* law) noexcept;

 private:
  const void* law_;
  const InLaw* outer_;
};

/// @throws Error when a loop uses it and this is not its force law
void refuse_at_work(const HapticDevice& device);
void refuse_at_work(const HapticRenderer& renderer);

/// The same device or renderer. @throws Error as above
template <class Thing>
Thing& idle(Thing& thing) {
  refuse_at_work(thing);
  return thing;
}

}  // namespace calligraphy::python
