// One tick of a servo loop and its watchdog, independent of what clocks them.
#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include <calligraphy/base/detail/returned.hpp>
#include <calligraphy/devices/detail/duration_histogram.hpp>
#include <calligraphy/devices/detail/force_guard.hpp>
#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/servo_statistics.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>

namespace calligraphy {

/// A type that computes forces like a HapticRenderer.
template <class Type>
concept ForceRenderer = requires(Type& renderer, const DeviceState& sample) {
  Eigen::Vector3d(renderer.update(sample).force);
  double(renderer.options().servo_rate);
};

/// Maps a sample to the force in device axes [N]. Called once per fresh sample, never for a stale, uncalibrated, faulty
/// or non-finite one: position, velocity and force of the sample are numbers, whatever the device measures. It must
/// neither allocate, lock, log nor throw. A servo survives a force law that violates this, but ramps the force down
/// when it throws or takes too long.
class ForceLaw {
 public:
  ForceLaw() = default;
  /// A function of the sample, for any rate. It must return Eigen::Vector3d, or a reference to one that outlives the
  /// call, and nothing that merely converts to it: an Eigen expression may refer to temporaries of the function.
  template <class Law>
  requires(!ForceRenderer<Law> && !std::derived_from<std::remove_cvref_t<Law>, ForceLaw>) ForceLaw(Law&& law) {
    using Force = detail::Returned<std::decay_t<Law>&, const DeviceState&>;
    constexpr bool is_force = std::is_same_v<Force, Eigen::Vector3d>;
    constexpr bool converts = std::is_convertible_v<Force, Eigen::Vector3d>;  // as Eigen's expressions do
    static_assert(converts,
                  "a force law is a function Eigen::Vector3d(const DeviceState&), or a renderer that is not const");
    static_assert(is_force || !converts,
                  "a force law returns Eigen::Vector3d: write -> Eigen::Vector3d after the lambda's parameters, since "
                  "an Eigen expression refers to temporaries that are gone");
    if constexpr (is_force) function_ = std::forward<Law>(law);
  }
  /// A HapticRenderer, or a type with its update() and options(). It must outlive the servo and run at the same rate.
  template <ForceRenderer Renderer>
  ForceLaw(Renderer&& renderer)
      : rate(renderer.options().servo_rate),
        function_([&renderer](const DeviceState& sample) { return Eigen::Vector3d(renderer.update(sample).force); }) {
    static_assert(std::is_lvalue_reference_v<Renderer>,
                  "a renderer must outlive the servo: pass a variable, neither a temporary nor std::move() of one");
  }

  /// The force at a sample [N, device].
  Eigen::Vector3d operator()(const DeviceState& sample) const { return function_(sample); }
  /// The function, if it is of this type; otherwise null.
  template <class Type>
  const Type* target() const noexcept {
    return function_.target<Type>();
  }
  /// Whether there is a function or a renderer.
  explicit operator bool() const noexcept { return static_cast<bool>(function_); }

  double rate = 0.0;         ///< rate at which it must be called; 0: any [Hz]
  std::string name = "own";  ///< name in recordings, ideally with parameters: "wall: 300 N/m"

 private:
  std::function<Eigen::Vector3d(const DeviceState&)> function_;
};

/// Rate and safety limits of a servo loop.
struct ServoOptions {
  /// Ticks per second; 0: the device's (Capabilities::update_rate). A force law made for another rate is refused [Hz].
  double rate = 0.0;
  double timeout = 4e-3;     ///< time without a fresh sample, a tick or a result of the force law before the force
                             ///< ramps down; real devices pause for up to 2.4 ms [s]
  double ramp_down = 10e-3;  ///< linear ramp from the last force to zero [s]
  double ramp_up = 0.2;      ///< ramp of the gain on the desired force from 0 to 1, at the start and after a fault [s]
  double (*work_clock)() noexcept = nullptr;  ///< times force law and tick [s]; null: the system's monotonic clock
};

/// Phase of the force output.
enum class ServoPhase : std::uint8_t {
  zero,     ///< no force: before the first tick, or while a fault persists
  rising,   ///< ramp-up: the gain on the desired force increases from 0 to 1
  running,  ///< the desired force is output
  falling   ///< ramp-down: the last force decreases linearly, whatever force is desired
};

/// "zero", "rising", "running", "falling".
const char* to_string(ServoPhase phase) noexcept;

/// Current state of a servo loop.
struct ServoStatus {
  ServoPhase phase = ServoPhase::zero;     ///< current phase of the force output
  DeviceFault fault = DeviceFault::none;   ///< cause of the ramp-down, until the force has ramped up again
  DeviceStatus device = DeviceStatus::ok;  ///< status of the last sample
  double gain = 0.0;                       ///< factor on the desired force, or on the held one during a ramp-down [1]
};

/// Reads the device, calls the force law, guards and writes the force, and keeps statistics.
///
/// A force above the device's peak is limited to it, its direction preserved. What the device does not report is filled
/// in before the force law is called: a velocity of NaN by a VelocityEstimator, which restarts after a fault or a gap
/// longer than `timeout`, and a force of NaN by the last one written by the servo or its watchdog. The settling time of
/// that force is filled in too: the force before it may have done work unseen.
///
/// The force ramps down to zero when the device is disconnected, uncalibrated or at fault; when its samples are not
/// finite or stay stale for longer than `timeout`; when the force law throws, returns a force that is not finite or
/// takes longer than `timeout`; and when no tick arrives for that long. A force law that does not return and missing
/// ticks are handled by supervise(), called from another thread: while the force law runs, or between ticks, it takes
/// over the device, ramps the force down and releases the device again. A tick that returns from a slow force law then
/// finds the device taken and writes nothing. If the watchdog does not continue its ramp for a whole tick, the ticks
/// continue it, so no force is left on, whichever thread is late.
///
/// After any fault the force is therefore zero within `timeout` + `ramp_down` + two ticks, 16 ms by default. The only
/// exception is a device whose own read() or write() hangs, because nothing else may touch it then: the status is
/// `timed_out`, and only the device's own watchdog remains.
///
/// After emergency_stop() it writes zero, without a ramp, until clear_emergency_stop(); then it ramps up again.
///
/// step() and supervise() are wait-free with respect to each other and neither allocate, lock, log nor throw.
class Servo {
 public:
  /// The device must outlive the servo. @throws ValueError naming the value when an option or the device's velocity
  /// cut-off is out of range, the force law is empty, or the force law is made for another rate
  Servo(HapticDevice& device, ForceLaw law, const ServoOptions& options = {});

  /// Runs one tick at time `now` [s] of a clock that should not run backwards. Call from one thread at a time; a
  /// concurrent second call does nothing.
  void step(double now) noexcept;

  /// The watchdog. Call about once per tick from another thread, with a clock [s] independent of that of step().
  void supervise(double now) noexcept;

  /// From the next tick on, ramps the force down to zero and keeps it there.
  void release() noexcept { released_.store(true, std::memory_order_relaxed); }

  /// Whether the calling thread is inside this servo's force law.
  bool in_law() const noexcept;

  /// Sets the force to zero immediately and resets everything but the statistics. Do not call while step() or
  /// supervise() runs.
  void reset() noexcept;

  /// Whether the last force written is the zero of an emergency stop. Thread-safe, async-signal-safe.
  bool halted() const noexcept { return halted_.load(std::memory_order_acquire); }

  /// State after the last tick, or the last ramp step of the watchdog. Thread-safe.
  ServoStatus status() const noexcept;
  /// Statistics since construction; reset() keeps them. Thread-safe.
  ServoStatistics statistics() const noexcept;
  /// Effective number of ticks per second [Hz].
  double rate() const noexcept { return options_.rate; }

 private:
  /// Owner of the device and the guard. The upper bits of the word count changes, so that a state left and re-entered
  /// is not mistaken for one that persisted. `ramp` is nobody while the watchdog's ramp-down is unfinished.
  enum class Owner : std::uint64_t { nobody, tick, law, watchdog, ramp };

  static Owner owner_of(std::uint64_t word) noexcept { return static_cast<Owner>(word & 7u); }
  bool hand_over(std::uint64_t& owner, Owner to) noexcept;
  bool take(std::uint64_t& owner) noexcept;
  double elapsed_since_last_tick(double now) noexcept;
  DeviceFault detect_fault(const DeviceState& sample, double elapsed, bool watched) noexcept;
  void complete(DeviceState& sample, DeviceFault fault, double elapsed) noexcept;
  bool call_law(const DeviceState& sample, Eigen::Vector3d& force) noexcept;
  void continue_ramp_down(std::uint64_t owner, double elapsed) noexcept;
  void give_back(std::uint64_t owner) noexcept;
  bool write_force() noexcept;
  void count_fault(DeviceFault fault) noexcept;
  void publish() noexcept;

  HapticDevice& device_;
  ForceLaw law_;
  ServoOptions options_;
  double peak_force_ = std::numeric_limits<double>::infinity();  ///< the device's [N]

  std::atomic<std::uint64_t> owner_ = 0;
  std::atomic<bool> released_ = false;
  std::atomic<bool> halted_ = false;
  std::atomic<std::uint64_t> status_ = 0;  ///< packed

  // Used only by the owner of the device.
  detail::ForceGuard guard_;
  DeviceStatus device_status_ = DeviceStatus::ok;
  DeviceFault last_fault_ = DeviceFault::none;  ///< of the previous tick
  Eigen::Vector3d written_ = Eigen::Vector3d::Zero();
  bool watchdog_ramped_ = false;  ///< the watchdog has ramped down since the last tick
  bool watchdog_wrote_ = false;   ///< the watchdog made the last change of the force
  double since_law_call_ = 0.0;   ///< time from the last call of the force law to the last tick [s]
  double settling_ = 0.0;         ///< part of that time until a tick last changed the force [s]

  std::atomic<std::uint64_t> seen_ramp_ = 0;  ///< owner word of the watchdog's ramp at the last tick

  // Used only by the thread that calls step().
  bool has_time_ = false;
  double last_time_ = 0.0;  ///< [s]
  double stale_for_ = 0.0;  ///< [s]
  VelocityEstimator velocity_;
  double since_estimate_ = 0.0;  ///< [s]

  // Used only by the thread that calls supervise().
  bool watch_has_time_ = false;
  double watch_time_ = 0.0;          ///< [s]
  std::uint64_t watched_owner_ = 0;  ///< as last seen
  std::uint64_t handled_owner_ = 0;  ///< word that persisted too long and was handled; 0: no tick yet
  double unchanged_for_ = 0.0;       ///< [s]
  DeviceFault reason_ = DeviceFault::none;
  std::atomic<double> steady_for_ = 0.0;  ///< time since it last changed the force [s]

  detail::DurationHistogram periods_;
  detail::DurationHistogram work_;
  std::atomic<std::uint64_t> ticks_ = 0;
  std::atomic<std::uint64_t> missed_ = 0;
  std::atomic<std::uint64_t> stale_ = 0;
  std::atomic<std::uint64_t> stalled_ = 0;
  std::atomic<std::uint64_t> watchdog_takeovers_ = 0;
  std::atomic<std::uint64_t> idle_ticks_ = 0;
  std::array<std::atomic<std::uint64_t>, device_fault_count> faults_ = {};
};

}  // namespace calligraphy
