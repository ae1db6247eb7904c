#include <calligraphy/devices/servo.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/detail/flush_denormals.hpp>
#include <calligraphy/devices/emergency_stop.hpp>

#include "base/bit_cast.hpp"
#include "base/enum_name.hpp"
#include "base/monotonic_clock.hpp"
#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr std::uint64_t owner_bits = 3;  // below the change count
constexpr int fault_shift = 8;           // in the packed status

std::uint64_t with_fault(std::uint64_t status, DeviceFault fault) noexcept {
  return (status & ~(std::uint64_t{0xff} << fault_shift)) | (static_cast<std::uint64_t>(fault) << fault_shift);
}

ServoOptions checked(ServoOptions options, const HapticDevice& device, const ForceLaw& law) {
  const bool is_given = options.rate != 0.0;
  if (!is_given) options.rate = device.capabilities().update_rate;
  if (law.rate > 0.0 && law.rate != options.rate) {
    throw ValueError("servo loop: rate = " + number_text(options.rate) + " Hz" + (is_given ? "" : ", the device's") +
                     ", but the force law is made for " + number_text(law.rate) + " Hz");
  }
  require_within("servo loop: rate", options.rate, "Hz", 1.0, 1e5);
  require(options.timeout >= 2.0 / options.rate && options.timeout <= 1.0, "servo loop: timeout", options.timeout, "s",
          "from two periods at " + number_text(options.rate) + " Hz to 1");
  if (options.work_clock == nullptr) options.work_clock = monotonic_seconds;
  options.timeout += 1e-3 / options.rate;  // tolerates rounding in sums of ticks
  return options;
}

/// For counters with a single writing thread.
void increment(std::atomic<std::uint64_t>& count, std::uint64_t by = 1) noexcept {
  count.store(count.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

/// The fault to report for a device that names none.
DeviceFault unnamed_fault(DeviceStatus status) noexcept {
  switch (status) {
    case DeviceStatus::disconnected:
      return DeviceFault::unplugged;
    case DeviceStatus::needs_calibration:
      return DeviceFault::uncalibrated;
    case DeviceStatus::stale:
      return DeviceFault::silent;
    default:
      return DeviceFault::device_error;
  }
}

/// The servo whose force law this thread is executing.
thread_local const Servo* servo_in_law = nullptr;

}  // namespace

const char* to_string(ServoPhase phase) noexcept {
  static constexpr const char* names[] = {"zero", "rising", "running", "falling"};
  return name_of<ServoPhase::falling>(phase, names, "unknown");
}

Servo::Servo(HapticDevice& device, ForceLaw law, const ServoOptions& options)
    : device_(device),
      law_(std::move(law)),
      options_(checked(options, device, law_)),
      guard_(options.ramp_down, options.ramp_up),
      velocity_(device.capabilities().velocity_cutoff) {
  const double peak = device.capabilities().peak_force;
  if (peak > 0.0) peak_force_ = peak;  // 0 means unknown
  if (!law_) throw ValueError("servo loop: the force law is empty");
}

void Servo::step(double now) noexcept {
  // Decaying filters in the force law end in denormal numbers, whichever thread calls it.
  const detail::FlushDenormals flush;
  std::uint64_t owner = owner_.load(std::memory_order_acquire);
  if (!take(owner)) {
    idle_ticks_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  const double period = 1.0 / options_.rate;
  const double begun = options_.work_clock();
  const double elapsed = elapsed_since_last_tick(now);
  // The watchdog has covered the time before: the rest of its ramp continues by one period.
  const bool watched = std::exchange(watchdog_ramped_, false);
  const double unguarded = watched ? std::min(elapsed, period) : elapsed;
  since_law_call_ += elapsed;
  DeviceState sample = device_.read();
  device_status_ = sample.status;
  const bool released = released_.load(std::memory_order_relaxed);
  DeviceFault fault = detect_fault(sample, elapsed, watched);
  if (emergency_stopped()) fault = DeviceFault::emergency_stop;
  complete(sample, fault, elapsed);

  double settling = since_law_call_;
  if (fault == DeviceFault::none && !released && sample.status != DeviceStatus::stale) {
    since_law_call_ = settling_ = 0.0;
    watchdog_wrote_ = false;
    hand_over(owner, Owner::law);
    Eigen::Vector3d force;
    const double law_begun = options_.work_clock();
    const bool succeeded = call_law(sample, force);
    const double law_time = options_.work_clock() - law_begun;
    if (!hand_over(owner, Owner::tick)) {  // the watchdog has taken over the device
      idle_ticks_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    settling = whole_nanoseconds(law_time);
    if (!succeeded) {
      fault = DeviceFault::bad_force;
    } else if (law_time > options_.timeout) {
      fault = DeviceFault::slow_force_law;
    } else {
      guard_.pass(force, std::min(elapsed, period));  // a late tick ramps up by one period only
    }
  } else if (fault == DeviceFault::none && released) {
    guard_.fall(guard_.fault(), unguarded, period);
  } else if (fault == DeviceFault::none) {
    guard_.hold(unguarded);
  }
  if (fault != DeviceFault::none) guard_.fall(fault, unguarded, period);
  if (fault != DeviceFault::none && fault != last_fault_) count_fault(fault);
  last_fault_ = fault;

  if (write_force()) {
    settling_ = settling;
    watchdog_wrote_ = false;
  }
  publish();
  increment(ticks_);
  work_.add(options_.work_clock() - begun);
  hand_over(owner, Owner::nobody);
}

/// Also counts missed and stalled ticks.
double Servo::elapsed_since_last_tick(double now) noexcept {
  const double period = 1.0 / options_.rate;
  if (!std::isfinite(now)) {
    increment(stalled_);
    return period;
  }
  const double elapsed = now - std::exchange(last_time_, now);
  if (!std::exchange(has_time_, true)) return period;
  if (!(elapsed > 0.0)) {
    increment(stalled_);
    return period;
  }
  periods_.add(elapsed);
  const double periods = std::min(std::round(elapsed * options_.rate), 1e15);
  if (periods > 1.0) increment(missed_, static_cast<std::uint64_t>(periods) - 1);
  return elapsed;
}

DeviceFault Servo::detect_fault(const DeviceState& sample, double elapsed, bool watched) noexcept {
  // While the force is zero a gap is harmless, and the fault that caused the ramp-down stays reported. The same holds
  // while the watchdog's ramp-down is unfinished.
  const bool gap = elapsed > options_.timeout && guard_.phase() != ServoPhase::zero && !watched;
  if (sample.status == DeviceStatus::stale) {
    increment(stale_);
    stale_for_ += elapsed;
  } else {
    stale_for_ = 0.0;
  }
  const DeviceFault named = sample.fault != DeviceFault::none ? sample.fault : unnamed_fault(sample.status);
  switch (sample.status) {
    case DeviceStatus::ok:
    case DeviceStatus::warm_motors:
      // A velocity of NaN is valid: the device does not measure it, and it is estimated. Infinity is not.
      if (!sample.position.allFinite() || sample.velocity.array().isInf().any()) return DeviceFault::corrupted_frame;
      break;
    case DeviceStatus::stale:
      if (stale_for_ > options_.timeout) return named;
      break;
    default:
      return named;
  }
  return gap ? DeviceFault::late_clock : DeviceFault::none;
}

/// Fills in what the device does not report.
void Servo::complete(DeviceState& sample, DeviceFault fault, double elapsed) noexcept {
  if (!sample.force.allFinite()) sample.force = guard_.force();
  sample.force_settling = watchdog_wrote_ ? since_law_call_ - steady_for_.load(std::memory_order_relaxed) : settling_;
  since_estimate_ += elapsed;
  if (fault != DeviceFault::none || elapsed > options_.timeout) velocity_.restart();
  const bool fresh = fault == DeviceFault::none && sample.status != DeviceStatus::stale;
  if (!fresh || sample.velocity.allFinite()) return;
  sample.velocity = velocity_.update(sample.position, std::exchange(since_estimate_, 0.0));
  sample.velocity_estimated = true;
}

bool Servo::call_law(const DeviceState& sample, Eigen::Vector3d& force) noexcept {
  const Servo* const outer = std::exchange(servo_in_law, this);  // a force law may step another servo
  bool succeeded = true;
  try {
    force = law_(sample);
  } catch (...) {
    succeeded = false;
  }
  servo_in_law = outer;
  if (!succeeded) return false;
  const double norm = force.norm();
  if (!std::isfinite(norm)) return false;
  if (norm > peak_force_) force *= peak_force_ / norm;
  return true;
}

bool Servo::in_law() const noexcept { return servo_in_law == this; }

void Servo::supervise(double now) noexcept {
  const double period = 1.0 / options_.rate;
  double elapsed = 0.0;
  if (std::isfinite(now)) {
    if (std::exchange(watch_has_time_, true) && now > watch_time_) elapsed = now - watch_time_;
    watch_time_ = now;
  }
  steady_for_.store(steady_for_.load(std::memory_order_relaxed) + elapsed, std::memory_order_relaxed);
  std::uint64_t owner = owner_.load(std::memory_order_acquire);
  if (owner_of(owner) == Owner::ramp) {
    if (hand_over(owner, Owner::watchdog)) continue_ramp_down(owner, elapsed);
    return;
  }
  if (owner != watched_owner_) {
    watched_owner_ = owner;
    unchanged_for_ = 0.0;
    return;
  }
  unchanged_for_ += elapsed;
  if (unchanged_for_ <= options_.timeout || owner == handled_owner_) return;

  handled_owner_ = owner;
  const Owner who = owner_of(owner);
  if (who == Owner::tick) {
    // Inside read() or write(): nothing else may touch the device.
    count_fault(DeviceFault::timed_out);
    std::uint64_t packed = status_.load(std::memory_order_relaxed);
    status_.compare_exchange_strong(packed, with_fault(packed, DeviceFault::timed_out), std::memory_order_relaxed);
    return;
  }
  if (!hand_over(owner, Owner::watchdog)) return;  // the tick has just continued
  if (released_.load(std::memory_order_relaxed) && guard_.phase() == ServoPhase::zero) {
    give_back(owner);  // a stopping loop may stop its clock first
    return;
  }
  reason_ = who == Owner::law ? DeviceFault::slow_force_law : DeviceFault::late_clock;
  watchdog_takeovers_.fetch_add(1, std::memory_order_relaxed);
  count_fault(reason_);
  continue_ramp_down(owner, std::min(elapsed, period));
}

/// The watchdog's tick while it owns the device: the same ramp-down as the servo's.
void Servo::continue_ramp_down(std::uint64_t owner, double elapsed) noexcept {
  guard_.fall(reason_, elapsed, 1.0 / options_.rate);
  watchdog_ramped_ = true;
  if (write_force()) {
    watchdog_wrote_ = true;
    steady_for_.store(0.0, std::memory_order_relaxed);
  }
  publish();
  if (guard_.phase() == ServoPhase::zero) {
    give_back(owner);
  } else {
    hand_over(owner, Owner::ramp);
  }
}

/// The only place that writes a force; returns whether it differs from the last one. Checks the emergency stop again
/// afterwards, because it may have happened in between.
bool Servo::write_force() noexcept {
  bool stopped = false;
  do {
    stopped = emergency_stopped();
    if (stopped) guard_.cut(DeviceFault::emergency_stop);
    device_.write(guard_.force());
    halted_.store(stopped, std::memory_order_release);
  } while (!stopped && emergency_stopped());
  return std::exchange(written_, guard_.force()) != guard_.force();
}

void Servo::give_back(std::uint64_t owner) noexcept {
  hand_over(owner, Owner::nobody);
  watched_owner_ = handled_owner_ = owner;  // no further takeover until a tick arrives
}

void Servo::reset() noexcept {
  guard_.reset();
  device_.write(Eigen::Vector3d::Zero());
  publish();
  owner_.store(0, std::memory_order_release);
  released_.store(false, std::memory_order_relaxed);
  halted_.store(false, std::memory_order_relaxed);
  last_fault_ = reason_ = DeviceFault::none;
  has_time_ = watch_has_time_ = false;
  written_.setZero();
  watchdog_ramped_ = watchdog_wrote_ = false;
  stale_for_ = unchanged_for_ = since_law_call_ = settling_ = 0.0;
  velocity_.restart();
  watched_owner_ = handled_owner_ = 0;
}

/// Takes the device for a tick: from nobody, or from a watchdog that left its ramp-down alone since the last tick.
bool Servo::take(std::uint64_t& owner) noexcept {
  const Owner who = owner_of(owner);
  const bool left = who == Owner::ramp && seen_ramp_.exchange(owner, std::memory_order_relaxed) == owner;
  return (who == Owner::nobody || left) && hand_over(owner, Owner::tick);
}

/// Changes the owner unless the word has changed since the caller read it. On success `owner` is the new word.
bool Servo::hand_over(std::uint64_t& owner, Owner to) noexcept {
  const std::uint64_t next = (((owner >> owner_bits) + 1) << owner_bits) | static_cast<std::uint64_t>(to);
  std::uint64_t expected = owner;
  if (!owner_.compare_exchange_strong(expected, next, std::memory_order_acq_rel, std::memory_order_acquire))
    return false;
  owner = next;
  return true;
}

void Servo::count_fault(DeviceFault fault) noexcept {
  faults_[static_cast<std::size_t>(fault)].fetch_add(1, std::memory_order_relaxed);
}

/// Packs phase, fault and device status (a byte each) and the gain (a float) into one word, for consistency.
void Servo::publish() noexcept {
  const auto gain = bit_cast<std::uint32_t>(static_cast<float>(guard_.gain()));
  const std::uint64_t word = (std::uint64_t{gain} << 32) | (static_cast<std::uint64_t>(device_status_) << 16) |
                             (static_cast<std::uint64_t>(guard_.fault()) << fault_shift) |
                             static_cast<std::uint64_t>(guard_.phase());
  status_.store(word, std::memory_order_relaxed);
}

ServoStatus Servo::status() const noexcept {
  const std::uint64_t word = status_.load(std::memory_order_relaxed);
  ServoStatus status;
  status.phase = static_cast<ServoPhase>(word & 0xff);
  status.fault = static_cast<DeviceFault>((word >> fault_shift) & 0xff);
  status.device = static_cast<DeviceStatus>((word >> 16) & 0xff);
  status.gain = bit_cast<float>(static_cast<std::uint32_t>(word >> 32));
  return status;
}

ServoStatistics Servo::statistics() const noexcept {
  ServoStatistics result;
  result.period = periods_.summary();
  result.work = work_.summary();
  result.ticks = ticks_.load(std::memory_order_relaxed);
  result.missed_deadlines = missed_.load(std::memory_order_relaxed);
  result.stale_samples = stale_.load(std::memory_order_relaxed);
  result.stalled_clock = stalled_.load(std::memory_order_relaxed);
  result.watchdog_takeovers = watchdog_takeovers_.load(std::memory_order_relaxed);
  result.idle_ticks = idle_ticks_.load(std::memory_order_relaxed);
  for (std::size_t i = 0; i < faults_.size(); ++i) result.faults[i] = faults_[i].load(std::memory_order_relaxed);
  return result;
}

}  // namespace calligraphy
