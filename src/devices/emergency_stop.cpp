// emergency_stop() uses only what is async-signal-safe: lock-free atomics and the registered functions.
#include <calligraphy/devices/emergency_stop.hpp>

#include <array>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/haptic_device.hpp>

#include "ending_signals.hpp"

namespace calligraphy {
namespace {

struct Slot {
  std::atomic<bool> taken = false;
  std::atomic<EmergencyStopEntry::Stop> stop = nullptr;
  void* object = nullptr;  ///< constant while `stop` is not null, like `process`
  long process = 0;        ///< process that opened the device: a forked child that ends must not cut its parent's force
};

// Initialised before any constructor and never destroyed: a signal may arrive at any time.
constinit std::array<Slot, EmergencyStopEntry::max_entries> slots;
constinit std::atomic<bool> stopped = false;
constinit std::atomic<int> under_way = 0;  ///< calls of emergency_stop()

static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<EmergencyStopEntry::Stop>::is_always_lock_free);

std::terminate_handler terminated_before = nullptr;

extern "C" void calligraphy_emergency_stop() { emergency_stop(); }

[[noreturn]] void stop_and_terminate() {
  emergency_stop();
  if (terminated_before != nullptr) terminated_before();
  std::abort();
}

}  // namespace

void emergency_stop() noexcept {
  stopped.store(true);
  // remove() accesses these in the opposite order: either it waits for this call, or this call sees the entry gone.
  under_way.fetch_add(1);
  const long process = this_process();
  for (Slot& slot : slots) {
    const EmergencyStopEntry::Stop stop = slot.stop.load();
    if (stop != nullptr && slot.process == process) stop(slot.object);
  }
  under_way.fetch_sub(1);
}

bool emergency_stopped() noexcept { return stopped.load(); }

void clear_emergency_stop() noexcept { stopped.store(false); }

void install_emergency_stop() {
  static const bool installed = [] {
    std::atexit(calligraphy_emergency_stop);
#if !defined(__APPLE__) && !defined(__EMSCRIPTEN__)  // which have no quick_exit()
    std::at_quick_exit(calligraphy_emergency_stop);
#endif
    terminated_before = std::set_terminate(stop_and_terminate);
    call_at_ending_signals(emergency_stop);
    return true;
  }();
  static_cast<void>(installed);
}

EmergencyStopEntry::EmergencyStopEntry(HapticDevice& device)
    : EmergencyStopEntry(&device, [](void* entered) noexcept { static_cast<HapticDevice*>(entered)->cut_force(); }) {}

EmergencyStopEntry::EmergencyStopEntry(void* object, Stop stop) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].taken.exchange(true)) continue;
    slots[i].object = object;
    slots[i].process = this_process();
    slots[i].stop.store(stop);
    slot_ = i;
    return;
  }
  throw DeviceError("emergency stop: " + std::to_string(max_entries) +
                    " devices and servo loops are open: close some before opening another");
}

void EmergencyStopEntry::remove() noexcept {
  if (slot_ == none) return;
  Slot& slot = slots[slot_];
  slot_ = none;
  slot.stop.store(nullptr);
  while (under_way.load() > 0) std::this_thread::yield();
  slot.taken.store(false);
}

}  // namespace calligraphy
