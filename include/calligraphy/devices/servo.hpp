// One tick of a servo loop, and the watchdog over it; whoever calls them is the clock.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>

#include <calligraphy/devices/detail/duration_histogram.hpp>
#include <calligraphy/devices/detail/force_guard.hpp>
#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/servo_statistics.hpp>

namespace calligraphy {

/// From a sample to the force in device axes [N]. Called with fresh samples alone, each once: never with one that is
/// stale, uncalibrated, faulty or not finite. It may neither allocate, lock, log nor throw; a servo lives with all of
/// it, but then the force falls.
using ForceLaw = std::function<Eigen::Vector3d(const DeviceState&)>;

struct ServoOptions {
  double rate = 1000.0;      ///< [Hz]
  double timeout = 4e-3;     ///< without a fresh sample, a tick or an answer of the force law, before the force falls:
                             ///< real devices pause for 2.4 ms now and then [s]
  double ramp_down = 10e-3;  ///< of the force, from what it was to zero [s]
  double ramp_up = 0.2;      ///< of the share of the force, from 0 to 1, when the loop begins and after a fault [s]
  double (*work_clock)() noexcept = nullptr;  ///< measures the force law [s]; null: the system's monotonic clock
};

/// Where the force of a servo loop stands.
enum class ServoPhase : std::uint8_t {
  zero,     ///< no force: nothing has run yet, or a fault lasts
  rising,   ///< the share of the wanted force that is sent grows from 0 to 1
  running,  ///< the wanted force is sent
  falling   ///< the last force goes down in a straight line, whatever is wanted
};

/// "zero", "rising", "running", "falling".
const char* to_string(ServoPhase phase) noexcept;

/// Where a servo loop stands.
struct ServoStatus {
  ServoPhase phase = ServoPhase::zero;
  DeviceFault fault = DeviceFault::none;   ///< why the force fell, until it has risen again
  DeviceStatus device = DeviceStatus::ok;  ///< of the last sample
  double gain = 0.0;  ///< share of the wanted force that is sent, or of the held one that is left [1]
};

/// Reads the device, asks the force law, guards the force, writes it, counts.
///
/// A force beyond the device's peak is shortened to it, its direction kept.
///
/// The force falls to zero when the device is disconnected, uncalibrated or at fault, when its samples stay stale for
/// longer than `timeout` or are not finite, when the force law throws, gives a force that is not finite or takes
/// longer than `timeout`, and when no tick comes for that long. The last two need supervise(), called by another
/// thread: while the force law runs, or between ticks, it takes the device over, lets the force fall, and gives the
/// device back. A tick that returns from a slow force law then finds the device taken and writes nothing.
///
/// So the force is zero at the latest `timeout` + `ramp_down` + two ticks after whatever went wrong: 16 ms. Only a
/// device whose own read() or write() hangs is beyond reach: nobody else may touch it then, the status says
/// `timed_out`, and what remains is the watchdog of the device itself.
///
/// step() and supervise() are wait-free towards each other and neither allocate, lock, log nor throw.
class Servo {
 public:
  /// The device must outlive the servo. @throws ValueError naming the value when an option is out of its domain or the
  /// force law is empty
  Servo(HapticDevice& device, ForceLaw law, const ServoOptions& options = {});

  /// One tick at the time `now` [s] of a clock that should not run back. One thread at a time; a second one that calls
  /// meanwhile does nothing.
  void step(double now) noexcept;

  /// The watchdog, to be called about once a tick from another thread, by a clock [s] that does not depend on step()'s.
  void supervise(double now) noexcept;

  /// From the next tick on the force falls to zero and stays there.
  void release() noexcept { released_.store(true, std::memory_order_relaxed); }

  /// Whether the calling thread is within the force law of this servo.
  bool in_law() const noexcept;

  /// Zero at once, and as new but for the statistics. Not while step() or supervise() runs.
  void reset() noexcept;

  /// Any thread, at any time.
  ServoStatus status() const noexcept;
  ServoStatistics statistics() const noexcept;

 private:
  /// Who may touch the device and the guard. The upper bits count the changes, so that a state which has come back is
  /// not taken for one that has lasted.
  enum class Owner : std::uint64_t { nobody, tick, law, watchdog };

  static Owner owner_of(std::uint64_t word) noexcept { return static_cast<Owner>(word & 3u); }
  bool hand_over(std::uint64_t& owner, Owner to) noexcept;
  double elapsed_since_last_tick(double now) noexcept;
  DeviceFault judge(const DeviceState& sample, double elapsed) noexcept;
  bool ask(const DeviceState& sample, Eigen::Vector3d& force) noexcept;
  void let_fall(std::uint64_t owner, double elapsed) noexcept;
  void give_back(std::uint64_t owner) noexcept;
  void count_fault(DeviceFault fault) noexcept;
  void publish() noexcept;

  HapticDevice& device_;
  ForceLaw law_;
  ServoOptions options_;
  double peak_force_ = std::numeric_limits<double>::infinity();  ///< of the device [N]

  std::atomic<std::uint64_t> owner_ = 0;
  std::atomic<bool> released_ = false;
  std::atomic<bool> begun_ = false;        ///< a tick has come
  std::atomic<std::uint64_t> status_ = 0;  ///< packed

  // Of the owner of the device.
  ForceGuard guard_;
  DeviceStatus device_status_ = DeviceStatus::ok;
  DeviceFault last_fault_ = DeviceFault::none;  ///< of the tick before

  // Of the thread that calls step().
  bool has_time_ = false;
  double last_time_ = 0.0;  ///< [s]
  double stale_for_ = 0.0;  ///< [s]

  // Of the thread that calls supervise().
  bool watch_has_time_ = false;
  double watch_time_ = 0.0;          ///< [s]
  std::uint64_t watched_owner_ = 0;  ///< as last seen
  std::uint64_t dealt_with_ = 0;     ///< seen for too long, and nothing more is to be done about it; 0: no tick yet
  double unchanged_for_ = 0.0;       ///< [s]
  DeviceFault reason_ = DeviceFault::none;

  DurationHistogram periods_;
  DurationHistogram work_;
  std::atomic<std::uint64_t> ticks_ = 0;
  std::atomic<std::uint64_t> missed_ = 0;
  std::atomic<std::uint64_t> stale_ = 0;
  std::atomic<std::uint64_t> standing_ = 0;
  std::atomic<std::uint64_t> watchdog_takeovers_ = 0;
  std::atomic<std::uint64_t> idle_ticks_ = 0;
  std::array<std::atomic<std::uint64_t>, device_fault_count> faults_ = {};
};

}  // namespace calligraphy
